#pragma once

#include <string>
#include <vector>

namespace scree
{
/** Why Newton's method ended. */
enum class NewtonStatus
{
  converged,
  converged_at_round_off,
  converged_at_standstill, //!< Hooks::is_in_balance
  max_iterations,
  diverged,
  linear_solver_failure,
  interrupted //!< Hooks::is_interrupted
};

/** The outcome of Newton's method. */
struct NewtonResult
{
  NewtonStatus status = NewtonStatus::max_iterations;

  /** Number of linear systems solved (or tried). */
  unsigned int iterations = 0;

  /** |r|_2 at the start and after each iteration. */
  std::vector<double> residuals;

  /** What happened, in a few words with numbers. */
  std::string message;

  bool converged() const
  {
    return status == NewtonStatus::converged || status == NewtonStatus::converged_at_round_off
           || status == NewtonStatus::converged_at_standstill;
  }
};
} // namespace scree
