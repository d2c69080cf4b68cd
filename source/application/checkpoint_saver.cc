#include <scree/application/checkpoint_saver.h>
#include <scree/base/exceptions.h>

#include <deal.II/base/mpi.h>

namespace scree
{
template <int dim>
CheckpointSaver<dim>::CheckpointSaver(const OutputParameters<dim> &parameters,
                                      const std::string &directory, const MPI_Comm communicator,
                                      RunLog                                 &run_log,
                                      const std::function<Checkpoint<dim>()> &collect)
    : parameters(parameters)
    , directory(directory)
    , communicator(communicator)
    , run_log(run_log)
    , collect(collect)
{
}

template <int dim>
bool
CheckpointSaver<dim>::is_due(const unsigned int n_steps, const bool is_last) const
{
  const bool by_steps
    = parameters.checkpoint_every > 0 && (n_steps % parameters.checkpoint_every == 0 || is_last);
  const bool by_time = parameters.checkpoint_minutes > 0.
                       && (since_last.wall_time() > 60. * parameters.checkpoint_minutes || is_last);
  return dealii::Utilities::MPI::broadcast(communicator, by_steps || by_time);
}

template <int dim>
void
CheckpointSaver<dim>::save()
{
  const Timings::Scope  scope(run_log.timings, "checkpoint");
  const Checkpoint<dim> checkpoint = collect();
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    try
      {
        n_bytes = checkpoint.write(directory);
        ++n_checkpoints;
      }
    catch (const UserError &error)
      {
        run_log.log.line(std::string("Warning: ") + error.what());
      }
  since_last.restart();
}

template class CheckpointSaver<2>;
template class CheckpointSaver<3>;
} // namespace scree
