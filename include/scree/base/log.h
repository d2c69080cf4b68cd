#pragma once

#include <deal.II/base/point.h>

#include <fstream>
#include <mpi.h>
#include <string>
#include <vector>

namespace scree
{
/** Lines of text for the user: printed on the first process and kept in a file. */
class Log
{
public:
  /**
   * @param file_name the file to write, empty: none
   * @param goes_on   whether it is appended to. @throws UserError if it is a pipe or a device
   */
  Log(const MPI_Comm communicator, const std::string &file_name, const bool goes_on = false);

  /** A line. */
  void line(const std::string &text);

  /** A progress bar that stays below the lines on a terminal; nothing elsewhere. */
  void progress(const double fraction, const std::string &text);

private:
  void erase_bar();

  bool          is_first, is_terminal, has_bar = false;
  std::ofstream file;
};

/** Names that are told one by one. */
constexpr unsigned int most_told = 30;

/** "a, b, c", of more than most_told the first 8 and the number of the others. */
std::string listed(const std::vector<std::string> &names);

/** A number in few characters: 4 significant digits. */
std::string short_number(const double value);

/** A number in so many digits that it is the same when it is read again. */
std::string exact_number(const double value);

/** A place as "(0.5, 1)". */
template <int dim>
std::string
short_place(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "(" : ", ") + short_number(point[d]);
  return text + ")";
}

/** Seconds as "12 s", "3 min 20 s", "2 h 5 min". */
std::string short_duration(const double seconds);
} // namespace scree
