#pragma once

#include <scree/base/interruption.h>

#include <memory>
#include <string>

namespace scree
{
/**
 * One run owns its output directory: the file DIR/lock, locked as long as the process lives and
 * removed at its end, says which one: host, process and begin.
 *
 * The lock is the system's (flock), so it ends with the process whatever ends that; a file that a
 * killed run left behind is no obstacle. Signals that end the program before a run notes them
 * (Interruption) remove it.
 */
class DirectoryLock
{
public:
  /** Owns nothing. */
  DirectoryLock() = default;

  /**
   * @param where what asked for the directory, for messages
   * @throws UserError if another run owns it, or the file cannot be made
   */
  DirectoryLock(const std::string &directory, const std::string &where);

  DirectoryLock(const DirectoryLock &)            = delete;
  DirectoryLock &operator=(const DirectoryLock &) = delete;
  DirectoryLock(DirectoryLock &&other) noexcept;
  DirectoryLock &operator=(DirectoryLock &&other) noexcept;
  ~DirectoryLock();

  /** What the run that ended without removing its lock said of itself; empty: there was none. */
  const std::string &previous() const
  {
    return previous_owner;
  }

private:
  int                               file = -1; //!< descriptor
  std::string                       file_name, previous_owner;
  std::unique_ptr<RemovalBySignals> by_signals;
};
} // namespace scree
