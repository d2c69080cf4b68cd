#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scree
{
/**
 * A CSV file with a fixed header that grows by rows, which are written when they come. What a full
 * disk refuses is kept and tried again with the next row.
 */
class CsvTable
{
public:
  /** Creates the file, replacing an older one; throws UserError if it cannot be opened. */
  CsvTable(const std::string &file_name, const std::vector<std::string> &columns);

  /**
   * Goes on with a table after its first `n_rows` rows; what follows is cut off.
   * @throws UserError if it has other columns or fewer rows
   */
  CsvTable(const std::string &file_name, const std::vector<std::string> &columns,
           const std::size_t n_rows);

  CsvTable(const CsvTable &)            = delete;
  CsvTable &operator=(const CsvTable &) = delete;
  ~CsvTable();

  /** Appends a row with as many values as there are columns, as word() has them. */
  void add_row(const std::vector<double> &values);

  /** Appends rows of numbers, or of words, which are written together. */
  template <typename T>
  void add_rows(const std::vector<std::vector<T>> &rows);

  /** A number with 12 significant digits. */
  static std::string word(const double value);

  /**
   * Writes what is not written yet; returns whether nothing is left.
   * @throws UserError if the file is no longer there under its name
   */
  bool flush();

  /** Of all rows of the file. */
  std::size_t n_rows() const
  {
    return row_count;
  }

private:
  void require_in_place() const;
  void append(const std::vector<double> &values);
  void append(const std::vector<std::string> &words);

  std::string file_name;
  int         file; //!< descriptor
  std::size_t n_columns;
  std::size_t row_count = 0;
  std::string pending; //!< what is not written
};
} // namespace scree
