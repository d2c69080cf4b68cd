#pragma once

#include <string>

namespace scree
{
/**
 * The name of a file or folder in a directory that holds results of a run or a study; empty if
 * there is none. What scree --check writes, pictures of step 0, is none.
 */
std::string result_file_in(const std::string &directory);
} // namespace scree
