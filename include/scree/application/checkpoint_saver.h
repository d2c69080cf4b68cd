#pragma once

#include <scree/application/checkpoint.h>
#include <scree/application/parameters.h>
#include <scree/base/run_log.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <string>

namespace scree
{
/** Saves checkpoints of a run when they are due. All functions are collective. */
template <int dim>
class CheckpointSaver
{
public:
  /** @param collect the checkpoint of the present state, on process 0; called when one is due */
  CheckpointSaver(const OutputParameters<dim> &parameters, const std::string &directory,
                  const MPI_Comm communicator, RunLog &run_log,
                  const std::function<Checkpoint<dim>()> &collect);

  /**
   * Whether one is due after an accepted step: by their number, by wall time, at the end. The clock
   * of the first process counts.
   */
  bool is_due(const unsigned int n_steps, const bool is_last) const;

  /** A failure is told in the log. */
  void save();

  unsigned int n_saved() const
  {
    return n_checkpoints;
  }

  /** Of the last one, on process 0. */
  std::size_t bytes() const
  {
    return n_bytes;
  }

private:
  const OutputParameters<dim>     &parameters;
  std::string                      directory;
  MPI_Comm                         communicator;
  RunLog                          &run_log;
  std::function<Checkpoint<dim>()> collect;
  dealii::Timer                    since_last;
  unsigned int                     n_checkpoints = 0;
  std::size_t                      n_bytes       = 0;
};
} // namespace scree
