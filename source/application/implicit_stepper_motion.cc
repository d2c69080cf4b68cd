#include <scree/application/implicit_stepper.h>
#include <scree/mechanics/step_criteria.h>

#include <algorithm>
#include <tuple>

// What comes of the motion of a step: its accuracy, material points, momenta.
namespace scree
{
template <int dim>
bool
ImplicitStepper<dim>::is_accurate(const Vector &u, const Rates &rates, Attempt<dim> &attempt)
{
  try
    {
      if (accuracy.test(u, rates, linear_solve(), attempt))
        return true;
      attempt.outcome = Attempt<dim>::Outcome::inaccurate;
    }
  catch (const LinearSolverFailure &failure)
    {
      run_log.log.line("Step " + std::to_string(record.step) + " to time "
                       + short_number(record.time) + " has no error estimate: " + failure.what());
    }
  return false;
}

template <int dim>
bool
ImplicitStepper<dim>::take_points(const Vector &u, Attempt<dim> &attempt)
{
  const Timings::Scope scope(run_log.timings, "material points");
  std::string          reason;
  std::tie(attempt.points, reason) = move_points(u);
  if (reason.empty())
    return true;
  run_log.log.line("Step " + std::to_string(record.step) + " to time " + short_number(record.time)
                   + " is too large: " + reason);
  // A body that slips out of contact goes as far in half a step.
  constexpr double as_far = 0.75;
  const double     motion = largest_free_motion(u);
  goes_far        = motion > parameters.moving.largest_motion * model.problem().grid.finest_size();
  has_slipped     = goes_far && motion > as_far * free_motion;
  free_motion     = motion;
  attempt.outcome = Attempt<dim>::Outcome::too_large;
  return false;
}

template <int dim>
double
ImplicitStepper<dim>::largest_free_motion(const Vector &u) const
{
  const Equilibrium<dim>   &equilibrium = model.problem().equilibrium();
  const std::vector<double> motions     = equilibrium.largest_displacements(u);
  double                    result      = 0.;
  for (const FreeMotion &free : equilibrium.free_bodies())
    result = std::max(result, motions[free.body]);
  return result;
}

template <int dim>
void
ImplicitStepper<dim>::take_motion(const Vector &u, const Rates &rates, Attempt<dim> &attempt) const
{
  if (!model.problem().mass)
    return;
  if (!model.has_inertia())
    {
      attempt.record.momenta.assign(model.problem().bodies.size() * n_rigid_components<dim>, 0.);
      return;
    }
  const Mass<dim> &mass = *model.problem().mass;
  model.problem().equilibrium().set_kinetic_energy(mass.kinetic_energy(u, rates));
  auto                                velocities = mass.at_points(rates.velocity);
  std::vector<dealii::Tensor<1, dim>> motion(velocities.size());
  if (model.is_moving())
    {
      const State<dim> &state  = model.state();
      const auto        before = mass.at_points(state.predictor.rates.velocity);
      const double      share  = parameters.time_scheme.flip_share;
      for (std::size_t p = 0; p < velocities.size(); ++p)
        {
          velocities[p] += share * (state.points.velocity[p] - before[p]);
          motion[p] = attempt.points.position[p] - state.points.position[p];
        }
      attempt.points.velocity     = velocities;
      attempt.points.acceleration = mass.at_points(rates.acceleration);
      attempt.points.forcing      = mass.at_points(mass.solve(rates.forces));
    }
  for (const auto &momentum : mass.momenta(u, rates, motion, velocities))
    {
      auto &columns = attempt.record.momenta;
      columns.insert(columns.end(), momentum.linear.begin_raw(), momentum.linear.end_raw());
      for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
        columns.push_back(momentum.angular[d]);
    }
}

template <int dim>
std::pair<MaterialPoints<dim>, std::string>
ImplicitStepper<dim>::move_points(const Vector &u) const
{
  const DiscreteProblem<dim> &problem = model.problem();
  const MaterialPoints<dim>  &points  = model.state().points;
  auto moved  = problem.kinematics->moved(points, problem.equilibrium().at_points(u));
  auto reason = why_too_large(problem, points, moved, negligible_pressure());
  return {std::move(moved), std::move(reason)};
}

#define SCREE_INSTANTIATE(dim)                                                                      \
  template bool   ImplicitStepper<dim>::is_accurate(const Vector &, const Rates &, Attempt<dim> &); \
  template bool   ImplicitStepper<dim>::take_points(const Vector &, Attempt<dim> &);                \
  template double ImplicitStepper<dim>::largest_free_motion(const Vector &) const;                  \
  template void   ImplicitStepper<dim>::take_motion(const Vector &, const Rates &, Attempt<dim> &)  \
    const;                                                                                          \
  template std::pair<MaterialPoints<dim>, std::string> ImplicitStepper<dim>::move_points(           \
    const Vector &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
