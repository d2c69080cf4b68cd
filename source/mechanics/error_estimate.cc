#include <scree/mechanics/error_estimate.h>
#include <scree/mechanics/error_indicator.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <numeric>

namespace scree
{
template <int dim>
ErrorEstimate
estimate_error(const DiscreteProblem<dim> &problem, const State<dim> &state)
{
  ErrorEstimate result;
  result.squares = recovery_errors(problem.space, problem.quadrature, problem.bodies, problem.bulk,
                                   problem.equilibrium().with_ghosts(state.displacement));
  const double squares = dealii::Utilities::MPI::sum(
    std::accumulate(result.squares.begin(), result.squares.end(), 0.), problem.communicator());
  result.relative
    = state.energies.strain > 0. ? std::sqrt(squares / (2. * state.energies.strain)) : 0.;
  return result;
}

template ErrorEstimate estimate_error(const DiscreteProblem<2> &, const State<2> &);
template ErrorEstimate estimate_error(const DiscreteProblem<3> &, const State<3> &);
} // namespace scree
