#include <scree/base/exceptions.h>
#include <scree/output/csv_table.h>

#include <deal.II/base/exceptions.h>

#include <iomanip>

namespace scree
{
CsvTable::CsvTable(const std::string &file_name, const std::vector<std::string> &columns)
    : file(file_name)
    , n_columns(columns.size())
{
  require(file.good(), file_name, "cannot be written", "check the output directory and the disk");
  for (std::size_t i = 0; i < columns.size(); ++i)
    file << (i == 0 ? "" : ",") << columns[i];
  file << std::endl;
}

void
CsvTable::add_row(const std::vector<double> &values)
{
  AssertDimension(values.size(), n_columns);
  file << std::setprecision(12);
  for (std::size_t i = 0; i < values.size(); ++i)
    file << (i == 0 ? "" : ",") << values[i];
  file << std::endl;
}
} // namespace scree
