#include <scree/base/log.h>
#include <scree/base/text_file.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <unistd.h>

namespace scree
{
Log::Log(const MPI_Comm communicator, const std::string &file_name, const bool goes_on)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  is_first = rank == 0;
  // mpirun gives its processes a terminal for the standard output only.
  is_terminal = is_first && isatty(STDOUT_FILENO) == 1 && isatty(STDERR_FILENO) == 1;
  if (!is_first || file_name.empty())
    return;
  require_regular_if_there(file_name);
  file.open(file_name, goes_on ? std::ios::app : std::ios::out);
}

void
Log::line(const std::string &text)
{
  if (!is_first)
    return;
  erase_bar();
  std::cout << text << std::endl;
  if (file.is_open())
    {
      file.clear(); // a full disk may have room again
      file << text << std::endl;
    }
}

void
Log::progress(const double fraction, const std::string &text)
{
  if (!is_terminal)
    return;
  erase_bar();
  constexpr int width  = 30;
  const int     filled = static_cast<int>(std::lround(fraction * width));
  std::cout << '[' << std::string(filled, '=') << std::string(width - filled, ' ') << "] "
            << std::lround(100. * fraction) << "% " << text << std::flush;
  has_bar = true;
}

void
Log::erase_bar()
{
  if (has_bar)
    std::cout << "\r\033[K";
  has_bar = false;
}

std::string
short_number(const double value)
{
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

std::string
exact_number(const double value)
{
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

std::string
listed(const std::vector<std::string> &names)
{
  constexpr std::size_t first_of_many = 8;
  const std::size_t     n_told        = names.size() <= most_told ? names.size() : first_of_many;
  std::string           text;
  for (std::size_t i = 0; i < n_told; ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  return n_told == names.size() ? text
                                : text + " and " + std::to_string(names.size() - n_told) + " more";
}

std::string
short_duration(const double seconds)
{
  const long         whole = std::lround(seconds);
  std::ostringstream text;
  if (seconds < 10.)
    text << std::round(seconds * 100.) / 100. << " s";
  else if (whole < 60)
    text << whole << " s";
  else if (whole < 3600)
    text << whole / 60 << " min " << whole % 60 << " s";
  else
    text << whole / 3600 << " h " << whole % 3600 / 60 << " min";
  return text.str();
}
} // namespace scree
