#include <scree/base/interruption.h>

#include <array>
#include <csignal>
#include <cstring>
#include <unistd.h>

namespace scree
{
namespace
{
constexpr std::array<int, 4> handled = {{SIGINT, SIGTERM, SIGHUP, SIGPIPE}};

volatile std::sig_atomic_t      first_signal = 0, tells_user = 0;
std::array<struct sigaction, 4> previous, before_removal;
std::string                     removed_file;

/** Only what is safe at any moment of a program. */
void
note(const int signal)
{
  if (first_signal == 0)
    {
      first_signal = signal;
      if (signal == SIGPIPE || tells_user == 0)
        return;
      const char text[]
        = "\nscree: ends after this iteration, with a checkpoint if it keeps any; a "
          "second signal ends it at once\n";
      const ssize_t n = write(STDERR_FILENO, text, sizeof text - 1);
      static_cast<void>(n);
      return;
    }
  if (signal == SIGPIPE)
    return;
  for (unsigned int i = 0; i < handled.size(); ++i)
    if (handled[i] == signal)
      sigaction(signal, &previous[i], nullptr);
  raise(signal);
}

/** Only what is safe at any moment of a program. */
void
remove_file(const int signal)
{
  unlink(removed_file.c_str());
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/** Lets `handler` answer the signals that the caller of the program does not want ignored (nohup);
 * what they did before. */
std::array<struct sigaction, 4>
answer_signals(void (*const handler)(int))
{
  std::array<struct sigaction, 4> before;
  struct sigaction                action;
  std::memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  action.sa_flags   = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (unsigned int i = 0; i < handled.size(); ++i)
    {
      sigaction(handled[i], nullptr, &before[i]);
      if (before[i].sa_handler != SIG_IGN)
        sigaction(handled[i], &action, nullptr);
    }
  return before;
}

void
set_back(const std::array<struct sigaction, 4> &before)
{
  for (unsigned int i = 0; i < handled.size(); ++i)
    sigaction(handled[i], &before[i], nullptr);
}
} // namespace

Interruption::Interruption(const bool tells)
{
  first_signal = 0;
  tells_user   = tells ? 1 : 0;
  previous     = answer_signals(note);
}

Interruption::~Interruption()
{
  set_back(previous);
}

RemovalBySignals::RemovalBySignals(const std::string &file_name)
{
  removed_file   = file_name;
  before_removal = answer_signals(remove_file);
}

RemovalBySignals::~RemovalBySignals()
{
  set_back(before_removal);
}

int
Interruption::signal()
{
  return first_signal;
}

std::string
signal_name(const int signal)
{
  switch (signal)
    {
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    case SIGHUP:
      return "SIGHUP";
    case SIGPIPE:
      return "SIGPIPE";
    default:
      return std::to_string(signal);
    }
}
} // namespace scree
