#include <scree/output/run_report.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scree
{
namespace
{
/** The script of an installed program is beside it, in ../share, otherwise it is in the sources. */
std::filesystem::path
plot_script()
{
  std::error_code error;
  const auto      program   = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto      installed = program.parent_path().parent_path() / "share/scree/contrib/plot";
  return std::filesystem::exists(installed, error) ? installed : SCREE_PLOT_SCRIPT;
}
} // namespace

void
plot(const std::string &directory, const MPI_Comm communicator)
{
  const std::string script = plot_script();
  if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0
      || !std::filesystem::exists(script))
    return;
  // Without a shell: a directory may have any name.
  const std::string place     = directory[0] == '-' ? "./" + directory : directory;
  const char *const command[] = {script.c_str(), place.c_str(), nullptr};
  pid_t             process   = 0;
  int               status    = 1;
  std::cout << std::flush;
  if (posix_spawn(&process, command[0], nullptr, nullptr, const_cast<char *const *>(command),
                  environ)
      == 0)
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
      {
      }
  if (status != 0)
    std::cout << "No pictures: " << script << " failed for the directory " << directory
              << "; it needs python3-numpy, python3-matplotlib and python3-vtk9" << std::endl;
}
} // namespace scree
