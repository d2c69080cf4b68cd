#include <scree/application/directory_lock.h>
#include <scree/base/exceptions.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace scree
{
namespace
{
std::string
host_name()
{
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

/** "process 12 on host, begun 2024-01-31 12:00:00". */
std::string
description_of_this_process()
{
  const std::time_t now = std::time(nullptr);
  char              begin[32];
  std::strftime(begin, sizeof begin, "%Y-%m-%d %H:%M:%S", std::localtime(&now));
  return "process " + std::to_string(getpid()) + " on " + host_name() + ", begun " + begin;
}

std::string
content(const int file)
{
  char          text[512];
  const ssize_t n = pread(file, text, sizeof text, 0);
  std::string   result(text, n > 0 ? n : 0);
  return result.substr(0, result.find('\n'));
}

/** Where files cannot be locked: whether the owner may be alive, by its description. */
bool
may_be_alive(const std::string &owner)
{
  const std::string begin = "process ", middle = " on " + host_name() + ",";
  const auto        at = owner.find(middle);
  if (owner.empty())
    return false;
  if (owner.rfind(begin, 0) != 0 || at == std::string::npos)
    return true;
  const long process = std::strtol(owner.c_str() + begin.size(), nullptr, 10);
  return kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM;
}

/** Locks a file; waits a little for a run that is being killed. */
bool
lock_file(const int file)
{
  for (unsigned int attempt = 0; attempt < 5; ++attempt)
    {
      if (flock(file, LOCK_EX | LOCK_NB) == 0)
        return true;
      if (errno != EWOULDBLOCK && errno != EINTR)
        return false;
      usleep(50000);
      errno = EWOULDBLOCK;
    }
  return false;
}

/** Whether the file of that name is still the one that is open. */
bool
is_in_place(const int file, const std::string &name)
{
  struct stat open_one, named;
  return fstat(file, &open_one) == 0 && stat(name.c_str(), &named) == 0
         && open_one.st_dev == named.st_dev && open_one.st_ino == named.st_ino;
}
} // namespace

DirectoryLock::DirectoryLock(const std::string &directory, const std::string &where)
    : file_name(directory + "/lock")
{
  // A run that ends removes the file: what was opened just before that is locked in vain.
  do
    {
      if (file >= 0)
        close(file);
      file = open(file_name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      require(file >= 0, where,
              "the file " + file_name + " cannot be written: " + std::strerror(errno),
              "check the output directory and the disk");
      if (!lock_file(file) && (errno == EWOULDBLOCK || may_be_alive(content(file))))
        {
          const std::string owner = content(file);
          close(std::exchange(file, -1));
          throw UserError(where,
                          "another run owns the directory"
                            + (owner.empty() ? std::string() : ": " + owner),
                          "wait for its end or stop it; choose another directory for a second run "
                          "(if there is no such run, remove "
                            + file_name + ")");
        }
    }
  while (!is_in_place(file, file_name));
  by_signals             = std::make_unique<RemovalBySignals>(file_name);
  previous_owner         = content(file);
  const std::string text = description_of_this_process() + "\n";
  const bool is_written  = ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) > 0;
  // On a full disk the lock holds, but does not say whose it is.
  static_cast<void>(is_written);
}

DirectoryLock::DirectoryLock(DirectoryLock &&other) noexcept
    : file(std::exchange(other.file, -1))
    , file_name(std::move(other.file_name))
    , previous_owner(std::move(other.previous_owner))
    , by_signals(std::move(other.by_signals))
{
}

DirectoryLock &
DirectoryLock::operator=(DirectoryLock &&other) noexcept
{
  std::swap(file, other.file);
  std::swap(file_name, other.file_name);
  std::swap(previous_owner, other.previous_owner);
  std::swap(by_signals, other.by_signals);
  return *this;
}

DirectoryLock::~DirectoryLock()
{
  if (file < 0)
    return;
  if (is_in_place(file, file_name))
    unlink(file_name.c_str());
  close(file);
}
} // namespace scree
