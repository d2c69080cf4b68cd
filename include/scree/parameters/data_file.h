#pragma once

#include <scree/parameters/section.h>

#include <cstddef>
#include <string>

namespace scree
{
/**
 * Declares `key` as the name of a file of `what`, as "labels", and entry Checksum, by which a run
 * that is resumed or repeated sees whether the file is still the same. Returns its bytes; nothing
 * if the name or the checksum is missing or wrong, which is recorded. `path` becomes the name.
 *
 * @param largest_size the most bytes that are read
 */
std::string read_data_file(const ParameterSection &section, const std::string &key,
                           std::string &path, const std::size_t largest_size,
                           const std::string &what, const std::string &documentation);
} // namespace scree
