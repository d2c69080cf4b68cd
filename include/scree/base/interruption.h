#pragma once

#include <string>

namespace scree
{
/**
 * While it lives, signals that ask the program to end (SIGINT, SIGTERM, SIGHUP, SIGPIPE) are only
 * noted, so that a run can save its state first. The second one does what it did before, so ends
 * the program at once; further SIGPIPE, of which every line into a closed pipe brings one, are
 * ignored. There is one at a time.
 */
class Interruption
{
public:
  /** @param tells whether this process says, at the first signal, what will happen */
  explicit Interruption(const bool tells);

  Interruption(const Interruption &)            = delete;
  Interruption &operator=(const Interruption &) = delete;

  /** The signals do what they did before. */
  ~Interruption();

  /** The number of the first signal; 0: none came. */
  static int signal();
};

/**
 * While it lives, a signal that ends the program at once removes a file first; signals that an
 * Interruption notes do not. There is one at a time, made before an Interruption.
 */
class RemovalBySignals
{
public:
  explicit RemovalBySignals(const std::string &file_name);

  RemovalBySignals(const RemovalBySignals &)            = delete;
  RemovalBySignals &operator=(const RemovalBySignals &) = delete;

  /** The signals do what they did before. */
  ~RemovalBySignals();
};

/** "SIGINT" ...; the number for others. */
std::string signal_name(const int signal);

/** Ends a run that was asked to end; not an error of the input. */
struct Interrupted
{
  int         signal; //!< number
  std::string message;
};
} // namespace scree
