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
void
plot(const std::string &directory, const MPI_Comm communicator)
{
  const std::string script = SCREE_PLOT_SCRIPT;
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
              << std::endl;
}
} // namespace scree
