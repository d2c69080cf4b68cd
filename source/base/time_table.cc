#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/base/text_file.h>
#include <scree/base/time_table.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <regex>

namespace scree
{
namespace
{
constexpr std::size_t largest_time_table = 64000000; // bytes

/** The decimal number that a cell is; NaN if it is none that is finite. */
double
number_in(const std::string &cell)
{
  const bool        has_plus = cell.size() > 1 && cell[0] == '+' && cell[1] != '-';
  const char *const last     = cell.data() + cell.size();
  double            number   = 0.;
  const auto        result   = std::from_chars(cell.data() + has_plus, last, number);
  return result.ec == std::errc() && result.ptr == last && std::isfinite(number)
           ? number
           : std::numeric_limits<double>::quiet_NaN();
}

/** The call whose inner text is given, with what users write by mistake. */
TableCall
table_call(const std::string &inside, const std::string &where)
{
  const auto        comma = inside.find(',');
  const std::string file  = dealii::Utilities::trim(inside.substr(0, comma));
  require(file.empty() || (file[0] != '"' && file[0] != '\''), where,
          "the name of a table stands in quotes: " + file, "write table(load.csv)");
  if (comma == std::string::npos)
    return {0, 0, file, ""};
  const std::string checksum = dealii::Utilities::trim(inside.substr(comma + 1));
  require(checksum.size() == 8
            && checksum.find_first_not_of("0123456789abcdef") == std::string::npos,
          where, "'" + checksum + "' behind the name of a table is no checksum",
          "write table(" + file
            + "): of two columns, time and value; the program writes the checksum in "
              "parameters.prm");
  return {0, 0, file, checksum};
}
} // namespace

TimeTable::TimeTable(const std::string &text, const std::string &name)
    : name(name)
{
  bool may_have_names = true;
  for (const auto &[line, where, number] : data_lines(text, name))
    {
      const auto comma = line.find(',');
      require(comma != std::string::npos && line.find(',', comma + 1) == std::string::npos, where,
              "'" + line + "' is no pair of a time and a value", "write 0.5, 12.3");
      const double time  = number_in(dealii::Utilities::trim(line.substr(0, comma)));
      const double value = number_in(dealii::Utilities::trim(line.substr(comma + 1)));
      const bool   has_names
        = may_have_names && std::isalpha(static_cast<unsigned char>(line[0])) && std::isnan(time);
      may_have_names = false;
      if (has_names)
        continue;
      require(std::isfinite(time) && std::isfinite(value), where,
              "'" + line + "' are no two finite numbers", "write 0.5, 12.3");
      require(rows.empty() || time > rows.back().first, where,
              "the time " + short_number(time) + " is not later than the one before",
              "sort the rows by time, each time once");
      rows.emplace_back(time, value);
    }
  require(rows.size() >= 2, name, "the table has " + std::to_string(rows.size()) + " row(s)",
          "give at least two: times and values, a comma between them");
}

double
TimeTable::value(const double time) const
{
  const double first = rows.front().first, last = rows.back().first;
  const double rounding = 1e-10 * (last - first);
  require(time >= first - rounding && time <= last + rounding, name,
          "the table goes from t = " + short_number(first) + " to " + short_number(last)
            + ", but its value is needed at t = " + short_number(time),
          "let the table cover the run, from 0 to Time/End time");
  auto after           = std::upper_bound(rows.begin() + 1, rows.end() - 1, time,
                                          [](const double t, const auto &row) { return t < row.first; });
  const auto &[t0, v0] = *(after - 1);
  const auto &[t1, v1] = *after;
  return v0 + (std::clamp(time, first, last) - t0) / (t1 - t0) * (v1 - v0);
}

std::string
read_time_table_bytes(const std::string &path)
{
  return read_bytes(path, largest_time_table, path, "check the path", "a table");
}

TimeTable
read_time_table(const std::string &path)
{
  return TimeTable(checked_text(read_time_table_bytes(path), path), path);
}

std::vector<TableCall>
table_calls(const std::string &formula, const std::string &where)
{
  const std::string name = "table(";
  require(!std::regex_search(formula, std::regex("\\btable\\s+\\(")), where,
          "'" + formula + "' has a blank between table and the parenthesis",
          "write table(load.csv)");
  std::vector<TableCall> calls;
  for (std::size_t begin = formula.find(name); begin != std::string::npos;)
    {
      const auto end = formula.find(')', begin);
      require(end != std::string::npos, where, "'" + formula + "' has a table without an end",
              "write table(load.csv)");
      calls.push_back(
        table_call(formula.substr(begin + name.size(), end - begin - name.size()), where));
      calls.back().begin  = begin;
      calls.back().length = end + 1 - begin;
      begin               = formula.find(name, end);
    }
  return calls;
}
} // namespace scree
