#include <scree/application/checkpoint.h>
#include <scree/base/exceptions.h>
#include <scree/state/bounded_archive.h>
#include <scree/state/checkpoint_file.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_oarchive.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/stream.hpp>
#include <ostream>

namespace scree
{
template <int dim>
std::size_t
Checkpoint<dim>::write(const std::string &directory) const
{
  return write_checkpoint_file(directory, dim, [this](std::ostream &stream) {
    boost::archive::binary_oarchive archive(stream);
    archive << *this;
  });
}

template <int dim>
Checkpoint<dim>
Checkpoint<dim>::read(const std::string &directory, const MPI_Comm communicator)
{
  CheckpointContents file;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    file = read_checkpoint_file(directory, dim);
  std::uint64_t size = file.contents.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, communicator);
  file.contents.resize(size);
  dealii::Utilities::MPI::broadcast(file.contents.data(), size, 0, communicator);

  Checkpoint result;
  try
    {
      using Contents = boost::iostreams::array_source;
      boost::iostreams::stream<Contents> bytes(Contents(file.contents.data(), size));
      BoundedArchive                     archive(bytes, size);
      archive >> result;
    }
  catch (const std::exception &error) // of the archive, or lengths that cannot be
    {
      throw UserError(directory, std::string("the checkpoint is not understood: ") + error.what(),
                      "go on with the version of scree that wrote it (see log.txt)");
    }
  result.warning = file.warning;
  return result;
}

void
require_resumable(const std::map<std::string, std::string> &before,
                  const std::map<std::string, std::string> &now)
{
  const auto may_change = [](const std::string &path) {
    const auto begins = [&path](const std::string &section) { return path.rfind(section, 0) == 0; };
    return path == "Title" || path == "Units" || begins("Time/") || begins("Solver/")
           || (begins("Output/") && !begins("Output/Probes/"));
  };
  const std::string remedy
    = "a run that is resumed may change Title, Time, Solver and Output (but its probes); for "
      "anything else start a new run";
  for (const auto &[path, value] : now)
    {
      const auto old = before.find(path);
      require(may_change(path) || (old != before.end() && old->second == value), path,
              "is now '" + value + "', but "
                + (old == before.end() ? "was not there" : "was '" + old->second + "'")
                + " when the run began",
              remedy);
    }
  for (const auto &[path, value] : before)
    require(may_change(path) || now.count(path) == 1, path,
            "was '" + value + "' when the run began and is not there now", remedy);
}

template struct Checkpoint<2>;
template struct Checkpoint<3>;
} // namespace scree
