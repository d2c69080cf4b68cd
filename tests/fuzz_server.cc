/* What contrib/checks/fuzz starts when it is told so: scree, which is loaded and initialises MPI
 * once, and forks for each run.
 *
 * usage: fuzz_server SECONDS BYTES (limits of the processor time and, if not 0, of the memory of a
 * run)
 *
 * Reads a line per run, OUTPUT<tab>WORD<tab>WORD ..., runs scree WORD WORD ... with its output in
 * the file OUTPUT, and writes two lines: the number of the process, and its status as waitpid()
 * gives it.
 */
#include <scree/application/command_line.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace
{
void
limit(const int resource, const rlim_t value)
{
  const rlimit both = {value, value};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/** Runs scree in this process and ends it. */
[[noreturn]] void
run(std::vector<std::string> words, const rlim_t seconds, const rlim_t bytes)
{
  const int output = open(words[0].c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int input  = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_FSIZE, 200000000);
  if (bytes > 0)
    limit(RLIMIT_AS, bytes);
  std::vector<char *> argv;
  for (std::string &word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  const int code
    = scree::run_command_line(static_cast<int>(words.size()), argv.data(), MPI_COMM_WORLD);
  std::cout << std::flush;
  _exit(code);
}
} // namespace

int
main(int argc, char **argv)
{
  if (argc != 3)
    {
      std::cerr << "fuzz_server: SECONDS and BYTES are needed" << std::endl;
      return 2;
    }
  const rlim_t seconds                                  = std::strtoull(argv[1], nullptr, 10),
               bytes                                    = std::strtoull(argv[2], nullptr, 10);
  int                                      argc_of_name = 1;
  char                                   **name         = argv;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc_of_name, name, 1);
  for (std::string line; std::getline(std::cin, line);)
    {
      const pid_t process = fork();
      if (process == 0)
        run(dealii::Utilities::split_string_list(line, '\t'), seconds, bytes);
      int status = 0;
      std::cout << process << std::endl;
      waitpid(process, &status, 0);
      std::cout << status << std::endl;
    }
  return 0;
}
