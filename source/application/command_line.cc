#include <scree/application/command_line.h>
#include <scree/application/directory_lock.h>
#include <scree/application/refinement_study.h>
#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/base/interruption.h>
#include <scree/base/log.h>
#include <scree/base/text_file.h>
#include <scree/bodies/body_list.h>
#include <scree/output/result_files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#ifndef SCREE_REVISION
#  define SCREE_REVISION "unknown"
#endif
#ifndef SCREE_VERSION
#  define SCREE_VERSION "unknown"
#endif

namespace scree
{
namespace
{
const char *const usage =
  R"(scree - frictional contact of deformable bodies on one background grid

  scree FILE.prm [--set Section/Subsection/Key=value ...] [--output DIR]
      runs the problem; results go to DIR (default: results/FILE)
  scree --resume DIR [--set ...]
      goes on with the run in DIR after its last checkpoint, on any number of processes; may change
      Title, Time, Solver and Output (but its probes)
  scree --check FILE.prm [--set ...] [--output DIR]
      says what is wrong with the input and writes what was set up, computes nothing
  scree --list FAMILY FILE.prm [--set ...]
      prints the bodies of a family as a table, which Family = list reads
  scree --parameters [FILE.md]
      writes a description of all parameters
  scree --version
      version and libraries
  mpirun -np 2 scree FILE.prm
      the same on 2 processes
)";

/** The words of the command line. */
struct Arguments
{
  std::string              file;
  std::string              output;
  std::string              resumed; // directory
  std::string              listed;  // family
  std::vector<std::string> overrides;
  bool                     check = false, parameters = false, version = false, help = false;
};

/** @throws UserError about the words of the command line unless they are `fine` */
void
require_words(const bool fine, const std::string &what)
{
  require(fine, "command line", what, "see scree --help");
}

Arguments
parse(const int argc, char **argv)
{
  Arguments  result;
  const auto value_of_option = [&](int &i) {
    require_words(i + 1 < argc && argv[i + 1][0] != '\0', std::string(argv[i]) + " needs a value");
    return std::string(argv[++i]);
  };
  for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word == "--help" || word == "-h")
        result.help = true;
      else if (word == "--version")
        result.version = true;
      else if (word == "--check")
        result.check = true;
      else if (word == "--parameters")
        result.parameters = true;
      else if (word == "--list")
        result.listed = value_of_option(i);
      else if (word == "--set")
        result.overrides.push_back(value_of_option(i));
      else if (word == "--resume")
        result.resumed = value_of_option(i);
      else if (word == "--output")
        result.output = value_of_option(i);
      else if (word.rfind("--", 0) == 0)
        require_words(false, "unknown option '" + word + "'");
      else
        {
          require_words(result.file.empty(),
                        "two files are given, '" + result.file + "' and '" + word + "'");
          result.file = word;
        }
    }
  if (result.help)
    return result;
  require_words(!result.version || argc == 2, "--version goes with nothing else");
  require_words(!result.parameters || argc == (result.file.empty() ? 2 : 3),
                "--parameters goes with the name of a file or alone");
  require_words(
    result.resumed.empty() || (result.file.empty() && result.output.empty() && !result.check),
    "--resume takes the parameters of its directory and writes there: it goes with --set only");
  require_words(result.version || result.parameters || !result.file.empty()
                  || !result.resumed.empty(),
                "no parameter file is given");
  return result;
}

void
print_version()
{
  std::cout << "scree " << SCREE_VERSION << " (commit " << SCREE_REVISION << ")\n"
            << "deal.II " << DEAL_II_PACKAGE_VERSION << ", Trilinos "
            << DEAL_II_TRILINOS_VERSION_MAJOR << "." << DEAL_II_TRILINOS_VERSION_MINOR << ", p4est "
            << DEAL_II_P4EST_VERSION_MAJOR << "." << DEAL_II_P4EST_VERSION_MINOR << ", MPI "
            << DEAL_II_MPI_VERSION_MAJOR << "." << DEAL_II_MPI_VERSION_MINOR << std::endl;
}

void
write_documentation(const std::string &file_name)
{
  ParameterFile plane = ParameterFile::documentation(), space = ParameterFile::documentation();
  declare_dimension(plane);
  declare_dimension(space);
  Parameters<2>().declare(plane);
  Parameters<3>().declare(space);
  const auto write = [&](std::ostream &out) {
    plane.write_markdown(out);
    out << "## What differs in 3D\n\n";
    space.write_markdown_differences(out, plane);
  };
  if (file_name.empty())
    return write(std::cout);
  require(!std::filesystem::exists(std::filesystem::symlink_status(file_name)), file_name,
          "exists already", "choose another name, or remove it: nothing is overwritten");
  std::ofstream out(file_name);
  require(out.good(), file_name, "cannot be written");
  write(out);
  out.close();
  require(out.good(), file_name, "cannot be written to the end", "make room on the disk");
}

/** Makes the output directory and takes it; on the first process only. */
DirectoryLock
prepare_directory(const std::string &directory, const bool is_first)
{
  if (!is_first)
    return {};
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  require(!error && std::filesystem::is_directory(directory), "--output " + directory,
          "the directory cannot be made: " + error.message(), "choose another place");
  DirectoryLock     lock(directory, "--output " + directory);
  const std::string name = result_file_in(directory);
  require(name.empty(), "--output " + directory,
          "the directory already holds results (" + name + ")",
          "remove them, choose another directory, or go on with scree --resume " + directory
            + ": nothing is overwritten");
  return lock;
}

/** Lets the log tell of a run that was killed in the directory. */
template <int dim>
void
tell_previous_run(const DirectoryLock &lock, Parameters<dim> &parameters)
{
  if (!lock.previous().empty())
    parameters.warnings.push_back("the run before (" + lock.previous()
                                  + ") did not come to its end");
}

/** Writes the resolved parameters; the file that is there stays until the new one is complete. */
void
write_parameters(const ParameterFile &file, const std::string &directory)
{
  const std::string name = directory + "/parameters.prm", next = name + ".new";
  require_regular_if_there(next);
  std::ofstream out(next);
  file.write(out);
  out.close();
  std::error_code error;
  if (out.good())
    std::filesystem::rename(next, name, error);
  require(out.good() && !error, name, "cannot be written",
          "check the output directory and the disk");
}

template <int dim>
void
run(ParameterFile &file, const Arguments &arguments, const std::string &directory,
    const MPI_Comm communicator)
{
  Parameters<dim> parameters;
  parameters.declare(file);
  file.check();
  parameters.resolved = file.values();
  parameters.warnings = file.warnings();
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  if (!arguments.listed.empty())
    {
      const std::string table = list_of_family(parameters.bodies, arguments.listed);
      if (is_first)
        std::cout << table;
      return;
    }
  const DirectoryLock lock = prepare_directory(directory, is_first);
  tell_previous_run(lock, parameters);
  MPI_Barrier(communicator);
  if (is_first)
    write_parameters(file, directory);
  const auto run_or_check = [&](auto &&problem) {
    if (arguments.check)
      problem.check();
    else
      problem.run();
  };
  if (parameters.study.n_cycles > 1)
    run_or_check(RefinementStudy<dim>(parameters, directory, communicator));
  else
    run_or_check(Simulation<dim>(parameters, directory, communicator));
}

template <int dim>
void
resume(ParameterFile &file, const std::string &directory, const MPI_Comm communicator)
{
  Parameters<dim> parameters;
  parameters.declare(file);
  file.check();
  parameters.resolved = file.values();
  require(parameters.study.n_cycles == 1, directory, "a refinement study cannot be resumed",
          "start it anew in another directory; its finished cycles are in " + directory
            + "/cycle-0 ...");
  const bool          is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  const DirectoryLock lock
    = is_first ? DirectoryLock(directory, "--resume " + directory) : DirectoryLock();
  MPI_Barrier(communicator);
  tell_previous_run(lock, parameters);
  const auto checkpoint = Checkpoint<dim>::read(directory, communicator);
  require_resumable(checkpoint.parameters, parameters.resolved);
  Simulation<dim> simulation(parameters, directory, communicator, &checkpoint);
  if (is_first)
    write_parameters(file, directory);
  simulation.run();
}

void
execute(const Arguments &arguments, const MPI_Comm communicator)
{
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  if (arguments.help || arguments.version || arguments.parameters)
    {
      if (is_first && arguments.help)
        std::cout << usage;
      else if (is_first && arguments.version)
        print_version();
      else if (is_first)
        write_documentation(arguments.file);
      return;
    }
  const bool    is_resumed = !arguments.resumed.empty();
  ParameterFile file
    = ParameterFile::read(is_resumed ? arguments.resumed + "/parameters.prm" : arguments.file);
  for (const std::string &override_text : arguments.overrides)
    file.override_value(override_text);
  const unsigned int dimension = declare_dimension(file);
  if (is_resumed)
    {
      if (dimension == 2)
        resume<2>(file, arguments.resumed, communicator);
      else
        resume<3>(file, arguments.resumed, communicator);
      return;
    }
  const std::string directory
    = arguments.output.empty() ? "results/" + std::filesystem::path(arguments.file).stem().string()
                                   + (arguments.check ? "_check" : "")
                               : arguments.output;
  if (dimension == 2)
    run<2>(file, arguments, directory, communicator);
  else
    run<3>(file, arguments, directory, communicator);
}

/** Whether all processes come here within 2 s; those that work on do not. */
bool
meet(const MPI_Comm communicator)
{
  MPI_Request request;
  MPI_Ibarrier(communicator, &request);
  const auto start = std::chrono::steady_clock::now();
  int        all   = 0;
  while (!all && std::chrono::steady_clock::now() - start < std::chrono::seconds(2))
    {
      MPI_Test(&request, &all, MPI_STATUS_IGNORE);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  return all == 1;
}
} // namespace

int
run_command_line(int argc, char **argv, const MPI_Comm communicator)
{
  MPI_Comm    for_errors = dealii::Utilities::MPI::duplicate_communicator(communicator);
  std::string message;
  int         code     = 1;
  bool        is_quiet = false;
  try
    {
      execute(parse(argc, argv), communicator);
    }
  catch (const Interrupted &interrupted)
    {
      message  = interrupted.message;
      code     = 128 + interrupted.signal;
      is_quiet = interrupted.signal == SIGPIPE;
    }
  catch (const UserError &error)
    {
      message = error.what();
    }
  catch (const std::bad_alloc &)
    {
      message
        = "out of memory\n  remedy: choose a coarser grid (Grid/Finest level), or more processes";
    }
  catch (const std::exception &error)
    {
      message = std::string("internal error, please report it: ") + error.what();
    }
  const bool all_failed = !message.empty() && meet(for_errors);
  // The first process speaks for all that met an error together; one that failed alone ends the
  // others.
  if (!message.empty() && !is_quiet
      && (!all_failed || dealii::Utilities::MPI::this_mpi_process(communicator) == 0))
    {
      std::cout << std::flush;
      std::cerr << "scree: " + message + "\n" << std::flush;
    }
  if (!message.empty() && !all_failed)
    MPI_Abort(communicator, code);
  dealii::Utilities::MPI::free_communicator(for_errors);
  return message.empty() ? 0 : code;
}
} // namespace scree
