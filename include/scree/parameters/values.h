#pragma once

#include <deal.II/base/patterns.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace scree
{
/** Whether a text is a value of a type, and if not, a hint for the user (may be empty). */
struct Reading
{
  bool        ok = true;
  std::string hint;
};

/**
 * The text of a value: the shortest one that reads back to the same bits; the empty text for
 * numbers that are not finite (NaN means unset) and for points with such a coordinate.
 *
 * Instantiated, as are the next two functions, for the types of ParameterSection::entry().
 */
template <typename T>
std::string format_value(const T &value);

/** Reads `text` into `value`, which is left in an unspecified state if that fails. */
template <typename T>
Reading parse_value(const std::string &text, T &value);

/**
 * What is allowed, in words: "a number in [0, 0.5]", "2 numbers, each >= 0". `pattern` may be
 * nullptr.
 */
template <typename T>
std::string allowed_values(const dealii::Patterns::PatternBase *pattern);

/**
 * Whether `text`, which is a `T`, matches `pattern`: as a whole, or for lists, points and tensors
 * also in each of its pieces.
 */
template <typename T>
bool matches(const dealii::Patterns::PatternBase &pattern, const std::string &text);

/** `text` split at `separator` outside parentheses, as in "max(0, 1), 2"; pieces trimmed; no piece
 * if there is nothing but blanks. */
std::vector<std::string> split_list(const std::string &text, char separator = ',');
} // namespace scree
