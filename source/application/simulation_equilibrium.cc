#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/mechanics/linear_prediction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// How a load step finds its equilibrium.
namespace scree
{
template <int dim>
typename Equilibrium<dim>::Vector
Simulation<dim>::extrapolated(const double time) const
{
  if (is_moving())
    return predicted(time);
  auto result = state.displacement;
  result.add(time - state.time, last_increment);
  return result;
}

template <int dim>
typename Equilibrium<dim>::Vector
Simulation<dim>::first_guess(const double time)
{
  using Vector     = typename Equilibrium<dim>::Vector;
  Vector unchanged = state.displacement;
  equilibrium->set_time(time, unchanged);
  std::vector<Vector> guesses = {unchanged};
  if (is_moving() ? predictor.step_size > 0. : last_increment.size() != 0)
    {
      guesses.push_back(extrapolated(time));
      equilibrium->set_prescribed(guesses.back());
    }
  if (std::any_of(bodies.begin(), bodies.end(),
                  [](const Body<dim> &body) { return body.is_rigid(); }))
    try
      {
        guesses.push_back(linear_prediction<dim>(*equilibrium, state.contact, state.displacement,
                                                 unchanged, [&](const Vector &b, Vector &x) {
                                                   solve_linear_system(
                                                     b, parameters.linear_solver.tolerance, x);
                                                 }));
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
      equilibrium->residual(guesses[i], state.contact, r);
      if (r.l2_norm() < smallest)
        {
          best     = i;
          smallest = r.l2_norm();
        }
    }
  return guesses[best];
}

template <int dim>
bool
Simulation<dim>::solve_step(const double time)
{
  const unsigned int step = step_control.n_accepted() + 1;
  record                  = StepRecord();
  record.step             = step;
  record.time             = time;
  is_too_large            = false;
  equilibrium->set_second_attempt(is_second_attempt);
  auto               u      = first_guess(time);
  const NewtonResult result = solve_equilibrium(u);
  record.newton_iterations  = result.iterations;
  record.residual           = result.residuals.empty() ? 0. : result.residuals.back();
  if (!result.converged())
    {
      explain_failure(result);
      return false;
    }
  tell_what_is_loose();
  const auto balances = require_balance(u);
  if (is_moving())
    {
      equilibrium->turn(u);
      const Timings::Scope scope(timings, "material points");
      points_at_end            = moved_points(u);
      const std::string reason = why_too_large();
      if (!reason.empty())
        {
          log.line("Step " + std::to_string(step) + " to time " + short_number(time)
                   + " is too large: " + reason);
          is_too_large = true;
          return false;
        }
    }
  equilibrium->accept(u, state.contact);
  require_contact_within_reach(*contact, parameters.contact.shift * grid->finest_size(),
                               communicator);
  if (is_moving())
    {
      predictor.step_size = time - state.time;
      state.displacement  = u;
      state.contact       = contact->current_history();
      state.time          = time;
      return true;
    }
  warn_of_meetings(u);
  warn_of_rotations(balances, u);
  last_increment = u;
  last_increment -= state.displacement;
  last_increment *= 1. / (time - state.time);
  state.displacement = u;
  state.contact      = contact->current_history();
  state.time         = time;
  for (unsigned int i = 0; i < was_closed.size(); ++i)
    if (contact->responses()[i].pressure != 0.)
      was_closed[i] = true;
  return true;
}

template <int dim>
LinearSolveResult
Simulation<dim>::solve_linear_system(const LinearSolver::Vector &r, const double tolerance,
                                     LinearSolver::Vector &du)
{
  const auto n_contact_points = dealii::Utilities::MPI::sum(contact->points().size(), communicator);
  // Artificial mass and second attempts change what was factorised.
  if (!is_transient && !is_second_attempt && equilibrium->is_linear_but_for_contact()
      && linear_solver->condenses(fields->n_dofs(), dim * n_contact_points)
      && !equilibrium->has_free_rigid_bodies())
    try
      {
        const Timings::Scope scope(timings, "linear solver");
        if (!condensed_solver)
          {
            const auto system = equilibrium->condensation(false);
            condensed_solver
              = std::make_unique<CondensedSolver>(system.glued, system.jumps, system.symmetric);
          }
        else if (condensed_solver->is_worth_updating())
          condensed_solver->update(equilibrium->condensation(true).glued);
        return condensed_solver->solve(equilibrium->tangent_changes(), dim, du, r);
      }
    catch (const LinearSolverFailure &)
      {
        // The full system tells what is wrong, if anything is.
      }
  const auto *matrix = [&]() {
    const Timings::Scope scope(timings, "tangent");
    return &equilibrium->tangent();
  }();
  const Timings::Scope scope(timings, "linear solver");
  return linear_solver->solve(*matrix, du, r, equilibrium->is_symmetric(), tolerance);
}

template <int dim>
Newton::Hooks
Simulation<dim>::newton_hooks(std::pair<double, double> &pressed)
{
  using Vector = typename Equilibrium<dim>::Vector;
  Newton::Hooks hooks;
  hooks.residual = [&](const Vector &u, Vector &r) {
    const Timings::Scope scope(timings, "residual");
    equilibrium->residual(u, state.contact, r);
  };
  if (is_moving() && !equilibrium->free_bodies().empty())
    hooks.advance = [&](const Vector &du, Vector &u) { equilibrium->advance(du, u); };
  hooks.balance = [&](Vector &u) {
    const Timings::Scope scope(timings, "residual");
    const bool has_moved = equilibrium->balance_rigid_motions(u, state.contact).has_value();
    if (has_moved)
      equilibrium->set_prescribed(u);
    return has_moved;
  };
  hooks.solve = [&](const Vector &, const Vector &r, const double tolerance, Vector &du) {
    const auto solved = solve_linear_system(r, tolerance, du);
    record.linear_iterations += solved.iterations;
    contact->set_touching_holds(false);
    equilibrium->shorten(du, grid->finest_size());
  };
  hooks.is_geometric = [&](const Vector &r, const double tolerance) {
    return equilibrium->is_geometric(r, tolerance);
  };
  hooks.reference = [&]() {
    return std::max(equilibrium->force_scale(),
                    equilibrium->round_off() / parameters.newton.relative_tolerance);
  };
  const bool has_mass = !equilibrium->free_bodies().empty();
  hooks.set_mass      = [&, has_mass](const double factor) {
    is_transient = has_mass && factor > Equilibrium<dim>::default_mass_factor;
    equilibrium->set_artificial_mass(factor);
  };
  hooks.mass_work = [&](const Vector &du) { return equilibrium->artificial_work(du); };
  hooks.freeze    = [&](const bool freeze) { contact->freeze_friction(freeze); };
  hooks.observe   = [&, has_mass](const NewtonIteration &iteration) {
    if (has_mass)
      {
        auto &[now, most] = pressed;
        now               = 0.;
        for (unsigned int i = 0; i < contact->points().size(); ++i)
          now += contact->points()[i].weight * std::abs(contact->responses()[i].pressure);
        now  = dealii::Utilities::MPI::sum(now, communicator);
        most = std::max(most, now);
      }
    count_flips();
    const std::string text = "iteration " + std::to_string(iteration.number) + ", residual "
                             + short_number(iteration.residual) + " of "
                             + short_number(iteration.tolerance);
    if (parameters.output.log_iterations)
      log.line("  " + text + ", step length " + short_number(iteration.step_length));
    log.progress(step_control.time() / parameters.time.end_time,
                   "step " + std::to_string(record.step) + ", " + text);
  };
  return hooks;
}

template <int dim>
NewtonResult
Simulation<dim>::solve_equilibrium(typename Equilibrium<dim>::Vector &u)
{
  using Vector = typename Equilibrium<dim>::Vector;
  contact->set_touching_holds(true);
  std::pair<double, double> pressed;
  const Vector              start(u);
  const Newton              newton(parameters.newton, newton_hooks(pressed));
  NewtonResult              result  = newton.solve(u);
  const auto                is_lost = [&]() { // in a step, not in a part of the overlap
    return record.step > 0 && result.converged() && pressed.first < 1e-6 * pressed.second;
  };
  if (is_lost())
    {
      // Friction may hold what sticks at first.
      Vector       v(start);
      const double pressed_before = pressed.first;
      contact->set_sticks(true);
      const unsigned int n_sticking = newton.solve(v).iterations;
      contact->set_sticks(false);
      const NewtonResult again        = newton.solve(v);
      const unsigned int n_iterations = result.iterations + n_sticking + again.iterations;
      if (again.converged())
        {
          u      = v;
          result = again;
        }
      else
        {
          pressed.first = pressed_before;
          equilibrium->residual(u, state.contact, v);
        }
      result.iterations = n_iterations;
    }
  if (is_lost())
    {
      if (const auto error = slide())
        {
          if (step_control.step_fraction() <= parameters.time.minimum_step_fraction)
            throw UserError(*error);
          result.status  = NewtonStatus::diverged;
          result.message = "bodies slide along each other until nothing presses any more";
          return result;
        }
      log.line("Warning: contact carries nothing at time " + short_number(record.time)
               + ": a body that nothing else holds moves away from what presses it");
    }
  return result;
}

template <int dim>
std::optional<UserError>
Simulation<dim>::slide() const
{
  if (is_moving())
    return {};
  // Gap, slip in cells, and pair of the point where bodies are nearest.
  std::array<double, 3> nearest = {{std::numeric_limits<double>::max(), 0., 0.}};
  for (unsigned int i = 0; i < contact->points().size(); ++i)
    if (contact->gap(i) < nearest[0])
      {
        const auto &n    = contact->points()[i].normal;
        const auto  jump = contact->jumps()[i] - state.contact.jump[i];
        nearest          = {{contact->gap(i), (jump - (n * jump) * n).norm() / grid->finest_size(),
                             double(contact->points()[i].pair)}};
      }
  for (const auto &other : dealii::Utilities::MPI::all_gather(communicator, nearest))
    nearest = std::min(nearest, other);
  if (nearest[1] < step_control.step_fraction())
    return {};
  const ContactPair &pair = contact->pairs()[static_cast<unsigned int>(nearest[2])];
  return UserError(
    "Contact/" + pair.law.name,
    "'" + bodies[pair.a].name + "' or '" + bodies[pair.b].name + "' slides away at time "
      + short_number(record.time)
      + ": what is prescribed presses them, and they slip along each other by "
      + short_number(nearest[1] * grid->finest_size()) + " until nothing presses any more",
    "hold the body that slides, drive it by a force, or raise the friction coefficient");
}

template <int dim>
double
Simulation<dim>::unbalanced_part(const double time, typename FreeBodies<dim>::Coordinates &motion)
{
  auto u = state.displacement;
  auto r = u;
  equilibrium->set_time(time, u);
  equilibrium->residual(u, state.contact, r);
  motion      = equilibrium->unbalanced_loads();
  double norm = 0.;
  for (const double part : motion)
    norm += part * part;
  return std::sqrt(norm);
}

template <int dim>
void
Simulation<dim>::require_equilibrium_exists()
{
  // Less than what cut quadrature leaves in the resultants of loads, nothing is said about it.
  constexpr double                      smallest_part = 1e-3;
  constexpr unsigned int                n_bisections  = 12;
  typename FreeBodies<dim>::Coordinates motion;
  if (equilibrium->free_bodies().empty() || unbalanced_part(record.time, motion) < smallest_part)
    return;
  typename FreeBodies<dim>::Coordinates other;
  double                                held = state.time, lost = record.time;
  const bool                            was_held = unbalanced_part(held, other) < smallest_part;
  for (unsigned int i = 0; i < n_bisections && was_held; ++i)
    {
      const double middle                                            = 0.5 * (held + lost);
      (unbalanced_part(middle, other) < smallest_part ? held : lost) = middle;
    }
  throw_slides_away(motion, was_held ? held : std::numeric_limits<double>::quiet_NaN());
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template typename Equilibrium<dim>::Vector Simulation<dim>::extrapolated(const double) const;    \
  template typename Equilibrium<dim>::Vector Simulation<dim>::first_guess(const double);           \
  template bool                              Simulation<dim>::solve_step(const double);            \
  template LinearSolveResult                 Simulation<dim>::solve_linear_system(                 \
                    const LinearSolver::Vector &, const double, LinearSolver::Vector &);           \
  template std::optional<UserError> Simulation<dim>::slide() const;                                \
  template Newton::Hooks            Simulation<dim>::newton_hooks(std::pair<double, double> &);    \
  template NewtonResult Simulation<dim>::solve_equilibrium(typename Equilibrium<dim>::Vector &);   \
  template double       Simulation<dim>::unbalanced_part(const double,                             \
                                                         typename FreeBodies<dim>::Coordinates &); \
  template void         Simulation<dim>::require_equilibrium_exists();

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
