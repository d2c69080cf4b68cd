#include <scree/mechanics/first_guess.h>
#include <scree/mechanics/linear_prediction.h>

#include <algorithm>
#include <limits>

namespace scree
{
namespace
{
/** Sets the owned nodes of deformable bodies in u to `factor` times the extended increments. */
template <int dim>
void
set_increments(const Fields<dim> &fields, const Predictor<dim> &predictor, const double factor,
               typename Equilibrium<dim>::Vector &u)
{
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const auto &of_body = predictor.of_bodies[fields.cells()[a].body];
      for (unsigned int i = 0; i < fields.basis.n_nodes; ++i)
        {
          const DofIndex node = fields.nodes(a)[i];
          if (!fields.owned().is_element(node) || fields.hanging_constraints().is_constrained(node))
            continue;
          const auto increment = factor * of_body(fields.position(a, fields.basis.node(i)));
          for (unsigned int d = 0; d < dim; ++d)
            u(node + d) = increment[d];
        }
    }
}
} // namespace

template <int dim>
typename Equilibrium<dim>::Vector
extrapolated(const DiscreteProblem<dim> &problem, const State<dim> &state, const double time)
{
  const Predictor<dim> &predictor = state.predictor;
  auto                  result    = state.displacement;
  if (!problem.is_moving())
    {
      result.add(time - state.time, predictor.rate);
      return result;
    }
  const Fields<dim> &fields = problem.fields;
  const double       factor = (time - state.time) / predictor.step_size;
  set_increments(fields, predictor, factor, result);
  for (unsigned int b = 0; b < state.bodies.size(); ++b)
    if (state.bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (fields.owned().is_element(fields.rigid_unknown(b) + m))
          result(fields.rigid_unknown(b) + m)
            = state.bodies[b].pose.unknowns()[m] + factor * predictor.of_rigid[b][m];
  result.compress(dealii::VectorOperation::insert);
  return result;
}

template <int dim>
typename Equilibrium<dim>::Vector
first_guess(const DiscreteProblem<dim> &problem, const State<dim> &state, const double time,
            const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                     typename Equilibrium<dim>::Vector       &x)> &solve)
{
  using Vector                  = typename Equilibrium<dim>::Vector;
  Equilibrium<dim> &equilibrium = problem.equilibrium();
  Vector            unchanged   = state.displacement;
  equilibrium.set_time(time, unchanged);
  std::vector<Vector> guesses = {unchanged};
  if (!state.predictor.is_empty())
    {
      guesses.push_back(extrapolated(problem, state, time));
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

#define SCREE_INSTANTIATE(dim)                                                                     \
  template Equilibrium<dim>::Vector extrapolated(const DiscreteProblem<dim> &, const State<dim> &, \
                                                 const double);                                    \
  template Equilibrium<dim>::Vector first_guess(                                                   \
    const DiscreteProblem<dim> &, const State<dim> &, const double,                                \
    const std::function<void(const Equilibrium<dim>::Vector &, Equilibrium<dim>::Vector &)> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
