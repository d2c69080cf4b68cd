#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/output/csv_table.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace scree
{
namespace
{
/** A line of the file. */
std::string
joined(const std::vector<std::string> &words)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : ",") + words[i];
  return text + "\n";
}

int
opened(const std::string &file_name, const int mode)
{
  require_regular_if_there(file_name);
  const int file = open(file_name.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | mode, 0666);
  require(file >= 0, file_name, std::string("cannot be written: ") + std::strerror(errno),
          "check the output directory and the disk");
  return file;
}
} // namespace

CsvTable::CsvTable(const std::string &file_name, const std::vector<std::string> &columns)
    : file_name(file_name)
    , file(opened(file_name, O_CREAT | O_TRUNC))
    , n_columns(columns.size())
    , pending(joined(columns))
{
  flush();
}

CsvTable::CsvTable(const std::string &file_name, const std::vector<std::string> &columns,
                   const std::size_t n_rows)
    : file_name(file_name)
    , file(opened(file_name, 0))
    , n_columns(columns.size())
    , row_count(n_rows)
{
  std::ifstream old(file_name);
  std::string   line;
  std::size_t   n_lines = 0, n_bytes = 0;
  while (n_lines <= n_rows && std::getline(old, line) && !old.eof())
    {
      require(n_lines > 0 || line + "\n" == joined(columns), file_name,
              "has other columns than this run", "it was changed: start the run anew");
      n_bytes += line.size() + 1;
      ++n_lines;
    }
  require(n_lines == n_rows + 1, file_name,
          "fewer than the " + std::to_string(n_rows) + " rows up to the checkpoint are left",
          "it was changed: start the run anew");
  require(ftruncate(file, n_bytes) == 0, file_name, "cannot be shortened", "check the disk");
}

CsvTable::~CsvTable()
{
  close(file);
}

void
CsvTable::add_row(const std::vector<double> &values)
{
  append(values);
  flush();
}

template <typename T>
void
CsvTable::add_rows(const std::vector<std::vector<T>> &rows)
{
  for (const auto &row : rows)
    append(row);
  flush();
}

template void CsvTable::add_rows(const std::vector<std::vector<double>> &);
template void CsvTable::add_rows(const std::vector<std::vector<std::string>> &);

void
CsvTable::append(const std::vector<double> &values)
{
  std::vector<std::string> words(values.size());
  std::transform(values.begin(), values.end(), words.begin(), word);
  append(words);
}

std::string
CsvTable::word(const double value)
{
  std::array<char, 32> digits;
  const auto           end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                           std::chars_format::general, 12)
                     .ptr;
  return {digits.data(), end};
}

void
CsvTable::append(const std::vector<std::string> &words)
{
  AssertThrow(words.size() == n_columns, dealii::ExcDimensionMismatch(words.size(), n_columns));
  pending += joined(words);
  ++row_count;
}

void
CsvTable::require_in_place() const
{
  struct stat open_one, named;
  require(fstat(file, &open_one) == 0 && stat(file_name.c_str(), &named) == 0
            && open_one.st_dev == named.st_dev && open_one.st_ino == named.st_ino,
          file_name, "was removed or replaced while the run wrote it",
          "leave the output directory alone; start the run anew");
}

bool
CsvTable::flush()
{
  require_in_place();
  std::size_t n_written = 0;
  bool        goes_on   = true;
  while (goes_on && n_written < pending.size())
    {
      const ssize_t n = write(file, pending.data() + n_written, pending.size() - n_written);
      n_written += std::max<ssize_t>(n, 0);
      goes_on = n > 0 || (n < 0 && errno == EINTR);
    }
  // Rows are there as a whole or not at all.
  std::size_t n_whole = std::string_view(pending.data(), n_written).rfind('\n') + 1;
  if (struct stat now; n_whole < n_written && fstat(file, &now) == 0
                       && ftruncate(file, now.st_size - (n_written - n_whole)) != 0)
    n_whole = n_written;
  pending.erase(0, n_whole);
  return pending.empty();
}
} // namespace scree
