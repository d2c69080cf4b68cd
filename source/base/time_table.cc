#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/base/text_file.h>
#include <scree/base/time_table.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace scree
{
namespace
{
constexpr std::size_t largest_time_table = 64000000; // bytes

/** The number that a cell is; NaN if it is none that is finite. */
double
number_in(const std::string &cell)
{
  char        *end    = nullptr;
  const double number = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' && std::isfinite(number)
           ? number
           : std::numeric_limits<double>::quiet_NaN();
}
} // namespace

TimeTable::TimeTable(const std::string &text, const std::string &name)
    : name(name)
{
  std::istringstream in(text);
  std::string        line;
  bool               may_have_names = true;
  for (unsigned int n = 1; std::getline(in, line); ++n)
    {
      line = dealii::Utilities::trim(line.substr(0, line.find('#')));
      if (line.empty())
        continue;
      const std::string where = name + ":" + std::to_string(n);
      const auto        comma = line.find(',');
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
  const std::string      name = "table(";
  std::vector<TableCall> calls;
  for (std::size_t begin = formula.find(name); begin != std::string::npos;)
    {
      const auto end = formula.find(')', begin);
      require(end != std::string::npos, where, "'" + formula + "' has a table without an end",
              "write table(load.csv)");
      const std::string inside = formula.substr(begin + name.size(), end - begin - name.size());
      const auto        comma  = inside.find(',');
      const std::string file   = dealii::Utilities::trim(inside.substr(0, comma));
      const std::string checksum
        = comma == std::string::npos ? "" : dealii::Utilities::trim(inside.substr(comma + 1));
      calls.push_back({begin, end + 1 - begin, file, checksum});
      begin = formula.find(name, end);
    }
  return calls;
}
} // namespace scree
