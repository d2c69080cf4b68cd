#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** A function of time by its values at given times, linear in between. */
class TimeTable
{
public:
  /**
   * @param text rows of a time and a value, separated by a comma; the first may have names, what
   *   follows # is not read
   * @param name of the file, for messages
   * @throws UserError for fewer than two rows, what is no number, times that do not increase
   */
  TimeTable(const std::string &text, const std::string &name);

  /** @throws UserError before the first time and after the last one */
  double value(const double time) const;

private:
  std::string                            name;
  std::vector<std::pair<double, double>> rows; //!< time, value
};

/** The bytes of the file of a table. @throws UserError if there is none, or it is too large */
std::string read_time_table_bytes(const std::string &path);

/** The table of a file. @throws UserError if there is none */
TimeTable read_time_table(const std::string &path);

/** table(FILE) or table(FILE, CHECKSUM) in a formula. */
struct TableCall
{
  std::size_t begin, length; //!< in the formula
  std::string file, checksum;
};

/**
 * All calls in a formula, in order.
 *
 * @throws UserError if one has no end, a blank before its parenthesis, a file in quotes, or what is
 *   no checksum; names `where`
 */
std::vector<TableCall> table_calls(const std::string &formula, const std::string &where);
} // namespace scree
