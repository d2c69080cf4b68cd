#pragma once

#include <scree/base/time_table.h>
#include <scree/parameters/section.h>

#include <cstddef>
#include <functional>
#include <string>

namespace scree
{
/** The table that a formula calls, and the call as "table(PATH, CHECKSUM)". */
struct CheckedTable
{
  std::string call;
  TimeTable   table;
};

/**
 * A table in the formula of entry `key`, found as ParameterSection::found_file() does.
 *
 * @throws UserError if there is no such table, or it is another one than its checksum tells
 */
CheckedTable checked_table(const ParameterSection &section, const std::string &key,
                           const TableCall &call);

/**
 * Declares entry Checksum, by which a run that is resumed or repeated sees whether a file is still
 * the same. Returns whether it is; if not, that is recorded.
 *
 * @param path  of the file, for messages
 * @param bytes of the file; empty: it is not known
 */
bool declare_checksum(const ParameterSection &section, const std::string &path,
                      const std::string &bytes);

/**
 * Declares `key` as the name of a file of `what`, as "labels", and Checksum. Returns its bytes;
 * nothing if the name or the checksum is wrong, which is recorded. `path` becomes the name.
 *
 * @param largest_size the most bytes that are read
 * @param complete     makes what counts of the bytes and the path: a header may name another file
 */
std::string read_data_file(
  const ParameterSection &section, const std::string &key, std::string &path,
  const std::size_t largest_size, const std::string &what, const std::string &documentation,
  const std::function<std::string(const std::string &bytes, const std::string &path)> &complete
  = {});
} // namespace scree
