#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace scree
{
/** A CSV file with a fixed header that grows by rows; every row is flushed at once. */
class CsvTable
{
public:
  /** Creates the file, replacing an older one; throws UserError if it cannot be written. */
  CsvTable(const std::string &file_name, const std::vector<std::string> &columns);

  /** Appends a row with as many values as there are columns, 12 significant digits. */
  void add_row(const std::vector<double> &values);

private:
  std::ofstream file;
  std::size_t   n_columns;
};
} // namespace scree
