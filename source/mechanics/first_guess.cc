#include <scree/mechanics/first_guess.h>
#include <scree/mechanics/linear_prediction.h>

#include <algorithm>
#include <limits>

namespace scree
{
template <int dim>
typename Equilibrium<dim>::Vector
first_guess(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
            const State<dim> &state, const double time,
            const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                     typename Equilibrium<dim>::Vector       &x)> &solve)
{
  using Vector                  = typename Equilibrium<dim>::Vector;
  Equilibrium<dim> &equilibrium = problem.equilibrium();
  Vector            unchanged   = state.displacement;
  equilibrium.set_time(time, unchanged);
  std::vector<Vector> guesses = {unchanged};
  if (auto predicted = scheme.predicted(*problem.kinematics, state, time))
    {
      guesses.push_back(std::move(*predicted));
      equilibrium.set_prescribed(guesses.back());
    }
  if (std::any_of(state.bodies.begin(), state.bodies.end(),
                  [](const Body<dim> &body) { return body.is_rigid(); }))
    try
      {
        guesses.push_back(
          linear_prediction<dim>(equilibrium, state.contact, state.displacement, unchanged, solve));
      }
    catch (const LinearSolverFailure &)
      {
        // The iteration starts without it.
      }
  unsigned int best     = 0;
  double       smallest = std::numeric_limits<double>::max();
  for (unsigned int i = 0; guesses.size() > 1 && i < guesses.size(); ++i)
    {
      Vector r(unchanged);
      equilibrium.residual(guesses[i], state.contact, r);
      if (r.l2_norm() < smallest)
        {
          best     = i;
          smallest = r.l2_norm();
        }
    }
  return guesses[best];
}

#define SCREE_INSTANTIATE(dim)                                                               \
  template Equilibrium<dim>::Vector first_guess(                                             \
    const DiscreteProblem<dim> &, const TimeScheme<dim> &, const State<dim> &, const double, \
    const std::function<void(const Equilibrium<dim>::Vector &, Equilibrium<dim>::Vector &)> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
