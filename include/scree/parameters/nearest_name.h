#pragma once

#include <string>
#include <vector>

namespace scree
{
/**
 * The candidate with the smallest Levenshtein distance (without regard to case) to `name`, if that
 * distance is at most max(2, length/3) and less than the length of `name`; else the empty string.
 */
std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates);

/** "; did you mean 'Material'?" with the nearest name, or nothing if no candidate is close. */
std::string did_you_mean(const std::string &name, const std::vector<std::string> &candidates);
} // namespace scree
