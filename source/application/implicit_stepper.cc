#include <scree/application/implicit_stepper.h>
#include <scree/base/interruption.h>
#include <scree/contact/contact_reach.h>
#include <scree/mechanics/balance_checks.h>
#include <scree/mechanics/contact_groups.h>
#include <scree/mechanics/contact_prediction.h>
#include <scree/mechanics/existence.h>
#include <scree/mechanics/first_guess.h>
#include <scree/mechanics/material_update.h>
#include <scree/mechanics/motion_rates.h>
#include <scree/mechanics/step_criteria.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
template <int dim>
ImplicitStepper<dim>::ImplicitStepper(const Parameters<dim> &parameters,
                                      const StepControl &step_control, Model<dim> &model,
                                      RunLog &run_log)
    : parameters(parameters)
    , step_control(step_control)
    , model(model)
    , run_log(run_log)
    , closing(step_control, model, *this, run_log)
    , relaxation(step_control, model, *this, run_log)
    , accuracy(parameters.time, step_control, model, run_log)
{
}

template <int dim>
void
ImplicitStepper<dim>::begin()
{
  has_slid = step_control.n_accepted() > 0;
  if (model.has_inertia())
    {
      warn_of_overlap();
      return;
    }
  closing.resolve_overlap();
  if (step_control.n_accepted() == 0)
    closing.settle();
}

template <int dim>
void
ImplicitStepper<dim>::warn_of_overlap() const
{
  constexpr double negligible = 1e-3; // cells
  const auto       overlaps   = model.problem().contact().overlaps(model.problem().communicator());
  const double     largest
    = overlaps.empty() ? 0. : *std::max_element(overlaps.begin(), overlaps.end());
  if (!model.state().has_started && largest > negligible * model.problem().grid.finest_size())
    run_log.log.line("Warning: bodies overlap by up to " + short_number(largest)
                     + " at the start: contact pushes them apart, which gives them energy; move "
                       "them apart, or set Adjust of their contact law");
}

template <int dim>
double
ImplicitStepper<dim>::largest_step() const
{
  return std::numeric_limits<double>::infinity();
}

template <int dim>
StepEvent
ImplicitStepper<dim>::next_event() const
{
  return accuracy.next_event();
}

template <int dim>
bool
ImplicitStepper<dim>::finds_another_way(const typename Attempt<dim>::Outcome outcome)
{
  const bool is_unsolved = outcome == Attempt<dim>::Outcome::unsolved;
  if (relaxation.is_pending())
    relaxation.go_back();
  else
    {
      if (is_unsolved)
        require_equilibrium_exists(model.problem(), model.state(), step_control.next_time());
      if ((is_unsolved || goes_far) && !predicts_contact && may_predict_contact())
        {
          predicts_contact = true;
          free_motion      = std::numeric_limits<double>::infinity();
          return true;
        }
      if ((is_unsolved || has_slipped) && relaxation.may_help() && relaxation.run())
        return true;
    }
  if (!is_unsolved)
    return false;
  if (!has_turned && !model.problem().equilibrium().free_bodies().empty())
    {
      // The other way, after a fall, see Equilibrium::set_second_attempt().
      closing.settle();
      is_second_attempt = !is_second_attempt;
      has_turned        = true;
      return true;
    }
  is_second_attempt = has_turned;
  return has_turned && !std::exchange(has_slid, true) && closing.close_without_friction();
}

template <int dim>
StepperRecord
ImplicitStepper<dim>::recorded() const
{
  return {is_second_attempt, accuracy.recorded()};
}

template <int dim>
void
ImplicitStepper<dim>::resume(const StepperRecord &record)
{
  is_second_attempt = record.is_second_attempt;
  accuracy.resume(record.largest_speed);
}

template <int dim>
Attempt<dim>
ImplicitStepper<dim>::attempt()
{
  DiscreteProblem<dim> &problem = model.problem();
  RunReport<dim>        report(run_log);
  record            = StepRecord();
  record.step       = step_control.n_accepted() + 1;
  const double time = record.time = step_control.next_time();
  problem.equilibrium().set_second_attempt(is_second_attempt);
  const TimeScheme<dim> &scheme = model.time_scheme();
  problem.equilibrium().set_inertia(scheme.inertia(problem.mass, model.state(), time));
  accuracy.begin_attempt();
  auto               u      = guess(time);
  const NewtonResult result = solve_step(u);
  record.newton_iterations  = result.iterations;
  record.residual           = result.residuals.empty() ? 0. : result.residuals.back();
  Attempt<dim> attempt;
  attempt.record = record;
  if (result.status == NewtonStatus::interrupted)
    {
      if (relaxation.is_pending())
        relaxation.go_back();
      attempt.outcome = Attempt<dim>::Outcome::interrupted;
      return attempt;
    }
  if (!result.converged())
    {
      report.failure(record, result, problem.contact(), status_changes, problem.communicator());
      return attempt;
    }
  if (result.status == NewtonStatus::converged_at_standstill)
    run_log.log.line("  Newton's method " + result.message);
  report.loose(problem, time);
  const auto balances = require_balance(problem, u, parameters.newton, time, run_log);
  if (model.is_moving())
    {
      problem.equilibrium().turn(u);
      if (!take_points(u, attempt))
        return attempt;
    }
  else
    require_small_rotations(problem, balances, model.state(), time);
  const Rates rates = rates_at_end(problem, scheme, model.state(), u, time);
  if (!is_accurate(u, rates, attempt))
    return attempt;
  take_motion(u, rates, attempt);
  problem.equilibrium().accept(u, model.state().contact);
  require_contact_within_reach(problem.contact(), problem.contact_reach(), problem.communicator());
  if (!model.is_moving())
    {
      report.meetings(problem, parameters.contact, u);
      warn_of_rotations(problem, balances, u, time, run_log);
      warn_of_large_strains(problem, balances, time, run_log);
    }
  model.accept(u, time, rates);
  attempt.outcome  = Attempt<dim>::Outcome::accepted;
  has_turned       = false;
  has_slid         = true;
  predicts_contact = false;
  free_motion      = std::numeric_limits<double>::infinity();
  relaxation.finish();
  accuracy.accept();
  return attempt;
}

template <int dim>
typename LocalError<dim>::Solve
ImplicitStepper<dim>::linear_solve()
{
  return [this](const Vector &b, Vector &x) {
    solve_linear_system(b, parameters.linear_solver.tolerance, x);
  };
}

template <int dim>
LinearSolveResult
ImplicitStepper<dim>::solve_linear_system(const Vector &r, const double tolerance, Vector &du)
{
  return model.problem().solver().solve(r, tolerance, !has_more_mass && !is_second_attempt, du);
}

template <int dim>
void
ImplicitStepper<dim>::hold_bodies(const Vector &r, const double tolerance, Vector &du)
{
  constexpr unsigned int max_trials  = 6;
  constexpr double       little_way  = 0.5; // cells
  Equilibrium<dim>      &equilibrium = model.problem().equilibrium();
  const double           h           = model.problem().grid.finest_size();
  for (unsigned int n = 0; n < max_trials && equilibrium.adapt_holds(du, little_way * h); ++n)
    record.linear_iterations += solve_linear_system(r, tolerance, du).iterations;
  equilibrium.shorten(du, h);
}

template <int dim>
Newton::Hooks
ImplicitStepper<dim>::hooks()
{
  DiscreteProblem<dim>      &problem     = model.problem();
  Equilibrium<dim>          &equilibrium = problem.equilibrium();
  const ContactHistory<dim> &history     = model.state().contact;
  Newton::Hooks              hooks;
  equilibrium.body_holds().release();
  hooks.residual = [&](const Vector &u, Vector &r) {
    const Timings::Scope scope(run_log.timings, "residual");
    equilibrium.residual(u, history, r);
  };
  hooks.balance = [&](Vector &u) {
    const Timings::Scope scope(run_log.timings, "residual");
    const bool           has_moved = equilibrium.balance_rigid_motions(u, history).has_value();
    if (has_moved)
      equilibrium.set_prescribed(u);
    return has_moved;
  };
  hooks.solve = [&](const Vector &, const Vector &r, const double tolerance, Vector &du) {
    record.linear_iterations += solve_linear_system(r, tolerance, du).iterations;
    hold_bodies(r, tolerance, du);
    problem.contact().laws().set_touching_holds(false);
  };
  const auto groups
    = std::make_shared<ContactGroups<dim>>(problem.space, problem.bodies, problem.contact());
  hooks.parts = [groups](const bool begins) {
    if (begins)
      groups->clear();
    groups->add();
    return begins ? Partition() : groups->partition();
  };
  hooks.is_geometric = [&](const Vector &r, const double tolerance) {
    return equilibrium.is_geometric(r, tolerance);
  };
  hooks.is_in_balance = [&](const Vector &u, const double residual) {
    return is_in_balance(problem, u, residual, parameters.newton);
  };
  hooks.reference = [&]() {
    return std::max(equilibrium.force_scale(),
                    equilibrium.round_off() / parameters.newton.relative_tolerance);
  };
  hooks.is_interrupted = [&]() { return is_interrupted(); };
  hooks.observe        = [&](const NewtonIteration &iteration) { observe(iteration); };
  set_hooks_of_lagging(hooks);
  return hooks;
}

template <int dim>
void
ImplicitStepper<dim>::set_hooks_of_lagging(Newton::Hooks &hooks)
{
  Equilibrium<dim> &equilibrium = model.problem().equilibrium();
  const bool        has_mass    = !equilibrium.free_bodies().empty();
  if (model.is_moving() && has_mass)
    hooks.advance = [&](const Vector &du, Vector &u) { equilibrium.advance(du, u); };
  hooks.lag = [&, has_mass](const std::optional<double> mass) {
    ContactPoints<dim> &contact = model.problem().contact();
    if (mass)
      contact.laws().freeze(contact.points(), contact.responses());
    else
      contact.laws().unfreeze();
    has_more_mass = has_mass && mass;
    equilibrium.set_artificial_mass(mass.value_or(Equilibrium<dim>::default_mass_factor));
  };
  hooks.mass = [&](const Vector &du) { return equilibrium.artificial_forces(du); };
}

template <int dim>
void
ImplicitStepper<dim>::observe(const NewtonIteration &iteration)
{
  const DiscreteProblem<dim> &problem = model.problem();
  const ContactPoints<dim>   &contact = problem.contact();
  if (!problem.equilibrium().free_bodies().empty())
    {
      pressed = 0.;
      for (unsigned int i = 0; i < contact.points().size(); ++i)
        pressed += contact.points()[i].weight * std::abs(contact.responses()[i].pressure);
      pressed      = dealii::Utilities::MPI::sum(pressed, problem.communicator());
      most_pressed = std::max(most_pressed, pressed);
    }
  status_changes.count(contact);
  const std::string text = "iteration " + std::to_string(iteration.number) + ", residual "
                           + short_number(iteration.residual) + " of "
                           + short_number(iteration.tolerance);
  if (parameters.output.log_iterations)
    run_log.log.line("  " + text + ", step length " + short_number(iteration.step_length));
  run_log.log.progress(step_control.time() / parameters.time.end_time,
                       "step " + std::to_string(record.step) + ", " + text);
}

template <int dim>
NewtonResult
ImplicitStepper<dim>::solve_enforced(const Newton &newton, Vector &u)
{
  const unsigned int max_updates = parameters.contact.enforcement.maximum_updates;
  model.problem().contact().start_step(model.state().contact);
  NewtonResult result = newton.solve(u);
  for (unsigned int n = 0; result.converged() && !model.problem().contact().update_enforcement();
       ++n)
    {
      if (n == max_updates)
        {
          result.status  = NewtonStatus::max_iterations;
          result.message = "contact is not enforced after " + std::to_string(n)
                           + " updates of the multipliers; raise Contact/Augmented "
                             "Lagrangian/Maximum updates or Largest gap, or refine the contact";
          break;
        }
      const unsigned int n_before = result.iterations;
      result                      = newton.solve(u);
      result.iterations += n_before;
    }
  return result;
}

template <int dim>
bool
ImplicitStepper<dim>::is_interrupted() const
{
  return dealii::Utilities::MPI::max(Interruption::signal(), model.problem().communicator()) != 0;
}

template <int dim>
unsigned int
ImplicitStepper<dim>::patience(const bool is_patient) const
{
  constexpr unsigned int few = 60, very_few = 30;
  if (is_patient)
    return parameters.newton.patience;
  return may_predict_contact() && !predicts_contact && !relaxation.is_pending() ? very_few : few;
}

template <int dim>
Newton
ImplicitStepper<dim>::newton(const unsigned int patience, const double left)
{
  NewtonParameters of_attempt = parameters.newton;
  of_attempt.patience         = patience;
  of_attempt.absolute_tolerance += left;
  return Newton(of_attempt, hooks());
}

template <int dim>
bool
ImplicitStepper<dim>::may_predict_contact() const
{
  const Equilibrium<dim> &equilibrium = model.problem().equilibrium();
  return model.is_moving() && equilibrium.free_bodies().size() > 1 && !equilibrium.has_inertia()
         && !is_second_attempt;
}

template <int dim>
typename ImplicitStepper<dim>::Vector
ImplicitStepper<dim>::guess(const double time)
{
  const DiscreteProblem<dim> &problem = model.problem();
  problem.equilibrium().body_holds().release();
  Vector u = first_guess<dim>(problem, model.time_scheme(), model.state(), time, linear_solve());
  if (!predicts_contact || relaxation.is_pending())
    return u;
  ContactPrediction<dim> prediction = contact_prediction<dim>(problem, model.state().contact, u,
                                                              [&]() { return is_interrupted(); });
  record.linear_iterations += prediction.n_linear_iterations;
  run_log.log.line("  contact is closed by an interior-point method first, in "
                   + std::to_string(prediction.n_iterations) + " iterations");
  problem.equilibrium().set_prescribed(prediction.u);
  return prediction.u;
}

template <int dim>
NewtonResult
ImplicitStepper<dim>::solve(Vector &u, const bool is_patient)
{
  record = StepRecord();
  model.problem().equilibrium().set_inertia({});
  model.problem().contact().laws().set_touching_holds(true);
  pressed = most_pressed = 0.;
  return solve_enforced(newton(patience(is_patient)), u);
}

template <int dim>
NewtonResult
ImplicitStepper<dim>::solve_with_sticking(const Newton &newton, const Vector &start, Vector &u,
                                          const NewtonResult &result)
{
  constexpr double       rough    = 1e-5; // of the residual: enough to begin from
  constexpr unsigned int patience = 20;   // most that succeed take less than 10, some 15
  DiscreteProblem<dim>  &problem  = model.problem();
  Vector                 v(start);
  const double           pressed_before = pressed;
  problem.contact().laws().set_sticks(true);
  Vector r(v);
  problem.equilibrium().residual(v, model.state().contact, r);
  const NewtonResult sticking = this->newton(patience, rough * r.l2_norm()).solve(v);
  problem.contact().laws().set_sticks(false);
  unsigned int n_iterations = result.iterations + sticking.iterations;
  NewtonResult best         = sticking;
  if (sticking.converged())
    {
      best = solve_enforced(newton, v);
      n_iterations += best.iterations;
    }
  if (best.converged()
      && (!has_lost_contact(best) || largest_free_motion(v) < largest_free_motion(u)))
    u = v;
  else
    {
      best    = result;
      pressed = pressed_before;
      problem.equilibrium().residual(u, model.state().contact, v);
    }
  best.iterations = n_iterations;
  return best;
}

template <int dim>
NewtonResult
ImplicitStepper<dim>::solve_step(Vector &u)
{
  model.problem().contact().laws().set_touching_holds(true);
  pressed = most_pressed = 0.;
  const Vector start(u);
  const bool   is_patient = !relaxation.may_help() || relaxation.is_pending() || has_turned;
  const Newton newton     = this->newton(patience(is_patient));
  NewtonResult result     = solve_enforced(newton, u);
  // Friction may hold what sticks at first.
  if (has_lost_contact(result) && model.problem().contact().laws().have_friction())
    result = solve_with_sticking(newton, start, u, result);
  if (!has_lost_contact(result))
    return result;
  std::optional<UserError> error;
  if (!model.is_moving())
    error
      = slide(model.problem(), model.state().contact, record.time, step_control.step_fraction());
  if (error)
    {
      if (step_control.step_fraction() <= parameters.time.minimum_step_fraction)
        throw UserError(*error);
      result.status  = NewtonStatus::diverged;
      result.message = "bodies slide along each other until nothing presses any more";
      return result;
    }
  if (run_log.warnings.is_new(Warning::lost_contact, 0))
    run_log.log.line("Warning: contact carries nothing at time " + short_number(record.time)
                     + ": bodies that nothing else holds move away from what presses them (told "
                       "once)");
  return result;
}

template class ImplicitStepper<2>;
template class ImplicitStepper<3>;
} // namespace scree
