#pragma once

#include <chrono>
#include <map>
#include <string>

namespace scree
{
/** Wall time spent in named parts of a run, on this process. */
class Timings
{
public:
  using Clock = std::chrono::steady_clock;

  /** Adds the time of its life to a part. */
  class Scope
  {
  public:
    Scope(Timings &timings, const std::string &part)
        : seconds(timings.seconds[part])
        , start(Clock::now())
    {
    }
    ~Scope()
    {
      seconds += std::chrono::duration<double>(Clock::now() - start).count();
    }
    Scope(const Scope &)            = delete;
    Scope &operator=(const Scope &) = delete;

  private:
    double           &seconds;
    Clock::time_point start;
  };

  /** Seconds since this object was made. */
  double total() const
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /** Seconds by part. */
  const std::map<std::string, double> &parts() const
  {
    return seconds;
  }

private:
  const Clock::time_point       start = Clock::now();
  std::map<std::string, double> seconds;
};
} // namespace scree
