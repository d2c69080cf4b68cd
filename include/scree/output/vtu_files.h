#pragma once

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <fstream>
#include <string>
#include <vector>

namespace scree
{
/** Writes a file by f(stream); returns whether all of it was written. */
template <typename F>
bool
write_file(const std::string &file_name, const F &f)
{
  std::ofstream file(file_name);
  try
    {
      f(file);
    }
  catch (const dealii::ExcIO &)
    {
      return false;
    }
  file.close();
  return file.good();
}

/**
 * Writes what each process has of a dealii::DataOutInterface to DIR/NAME.vtu, on several processes
 * as pieces with a record DIR/NAME.pvtu. Returns the name to put into a PVD record; empty if a
 * process could not write, on all of them. Collective.
 */
template <typename Output>
std::string
write_vtu_files(const Output &output, const std::string &directory, const std::string &name,
                const MPI_Comm communicator)
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
  const auto         piece   = [&](const unsigned int p) {
    return name + (n_ranks == 1 ? "" : "." + std::to_string(p)) + ".vtu";
  };
  bool is_written = write_file(directory + "/" + piece(rank),
                               [&](std::ofstream &file) { output.write_vtu(file); });
  if (n_ranks > 1 && rank == 0)
    {
      std::vector<std::string> names;
      for (unsigned int p = 0; p < n_ranks; ++p)
        names.push_back(piece(p));
      is_written &= write_file(directory + "/" + name + ".pvtu",
                               [&](std::ofstream &file) { output.write_pvtu_record(file, names); });
    }
  if (dealii::Utilities::MPI::min(is_written ? 1 : 0, communicator) == 0)
    return "";
  return n_ranks == 1 ? piece(0) : name + ".pvtu";
}
} // namespace scree
