#include <scree/application/contact_closing.h>
#include <scree/application/implicit_stepper.h>

#include <algorithm>

namespace scree
{
template <int dim>
ContactClosing<dim>::ContactClosing(const StepControl &step_control, Model<dim> &model,
                                    ImplicitStepper<dim> &stepper, RunLog &run_log)
    : step_control(step_control)
    , model(model)
    , stepper(stepper)
    , run_log(run_log)
{
}

template <int dim>
void
ContactClosing<dim>::go_on_from(const Vector &u, MaterialPoints<dim> &&points)
{
  model.accept(u, model.state().time);
  if (model.is_moving())
    model.move_geometry(std::move(points), step_control.step_size());
}

template <int dim>
std::optional<double>
ContactClosing<dim>::resolve_part(const std::vector<double> &overlaps, const double left)
{
  Equilibrium<dim> &equilibrium = model.problem().equilibrium();
  auto              u           = model.state().displacement;
  auto              allowed     = overlaps;
  for (double &overlap : allowed)
    overlap *= left;
  model.problem().contact().laws().resolve_overlap(allowed);
  equilibrium.set_unloaded(u);
  const NewtonResult  result = stepper.solve(u);
  MaterialPoints<dim> points;
  std::string         reason;
  n_iterations = result.iterations;
  if (result.converged() && model.is_moving())
    std::tie(points, reason) = stepper.move_points(u);
  std::optional<double> largest_motion;
  if (result.converged() && reason.empty())
    {
      const auto motions = equilibrium.largest_displacements(u);
      largest_motion     = *std::max_element(motions.begin(), motions.end());
      equilibrium.accept(u, model.state().contact);
      equilibrium.count_overlap();
      go_on_from(u, std::move(points));
    }
  model.problem().contact().laws().resolve_overlap({});
  return largest_motion;
}

template <int dim>
void
ContactClosing<dim>::resolve_overlap()
{
  constexpr double       negligible = 1e-6; // cells
  constexpr double       first_drag = 0.1, largest_drag = 10.;
  constexpr double       at_rest   = 0.05; // cells
  constexpr unsigned int max_moves = 10;   // of a part
  const double           h         = model.problem().grid.finest_size();
  const auto   overlaps = model.problem().contact().overlaps(model.problem().communicator());
  const double largest
    = overlaps.empty() ? 0. : *std::max_element(overlaps.begin(), overlaps.end());
  auto u = model.state().displacement;
  if (model.state().has_started || largest < negligible * h
      || !model.problem().equilibrium().set_unloaded(u))
    return;
  TimeParameters parts;
  parts.minimum_step_fraction = 1. / 1024;
  StepControl  control(parts);
  unsigned int n_all_iterations = 0, n_parts = 0, n_moves = 0; // moves of the present part
  bool         goes_on = true;
  double       drag    = 0.;
  while (goes_on && !control.finished())
    {
      const auto motion = resolve_part(overlaps, 1. - control.next_time());
      n_all_iterations += n_iterations;
      if (motion)
        {
          ++n_parts;
          if (drag == 0. || *motion < at_rest * h || ++n_moves >= max_moves)
            {
              n_moves = 0;
              control.accept(n_iterations);
            }
        }
      else if (model.is_moving() && drag < largest_drag
               && !model.problem().equilibrium().free_bodies().empty())
        drag = std::max(first_drag, 10. * drag);
      else
        goes_on = control.reject();
      model.problem().equilibrium().set_drag(drag);
    }
  model.problem().equilibrium().set_drag(0.);
  if (goes_on)
    run_log.log.line("Overlap at the start is resolved without friction in "
                     + std::to_string(n_parts) + " part(s) and " + std::to_string(n_all_iterations)
                     + " iterations");
  else
    run_log.log.line("Warning: the overlap at the start is resolved without friction only to "
                     + short_number(100. * control.time())
                     + "%; the first step resolves the rest, with friction");
}

template <int dim>
bool
ContactClosing<dim>::close_without_friction()
{
  Equilibrium<dim>   &equilibrium = model.problem().equilibrium();
  ContactPoints<dim> &contact     = model.problem().contact();
  auto                u = model.state().displacement, unused = u;
  if (equilibrium.set_moved(step_control.next_time(), u))
    {
      equilibrium.set_time(model.state().time, unused);
      return false;
    }
  contact.laws().resolve_overlap(std::vector<double>(contact.pairs().size(), 0.));
  bool                is_closed = stepper.solve(u).converged();
  MaterialPoints<dim> points;
  if (is_closed && model.is_moving())
    {
      equilibrium.turn(u);
      std::string reason;
      std::tie(points, reason) = stepper.move_points(u);
      is_closed                = reason.empty();
    }
  if (is_closed)
    equilibrium.accept_as_transfer(u, model.state().contact);
  contact.laws().resolve_overlap({});
  equilibrium.set_time(model.state().time, unused);
  if (!is_closed)
    return false;
  run_log.log.line("  the loads close contact without friction, which begins there");
  go_on_from(u, std::move(points));
  return true;
}

template <int dim>
void
ContactClosing<dim>::settle()
{
  constexpr unsigned int max_moves  = 200;
  constexpr double       negligible = 1e-3;
  if (!model.is_moving() || model.problem().equilibrium().free_bodies().empty())
    return;
  std::optional<State<dim>> before; // the first move
  unsigned int              n_moves = 0;
  for (; n_moves < max_moves && !stepper.is_interrupted(); ++n_moves)
    {
      Equilibrium<dim>          &equilibrium = model.problem().equilibrium();
      const ContactHistory<dim> &history     = model.state().contact;
      auto                       u = model.state().displacement, r = u, unused = u;
      equilibrium.set_time(step_control.next_time(), unused);
      equilibrium.residual(u, history, r);
      const auto work = equilibrium.balance_rigid_motions(u, history, true);
      equilibrium.set_time(model.state().time, unused);
      if (!work || *work < negligible)
        break;
      equilibrium.residual(u, history, r);
      auto points = stepper.move_points(u).first;
      if (!before)
        before = model.state();
      equilibrium.accept_as_transfer(u, history);
      go_on_from(u, std::move(points));
    }
  if (n_moves == max_moves)
    model.go_back(std::move(*before), step_control.step_size());
  else if (n_moves > 0)
    run_log.log.line("  bodies that nothing holds fall until contact does, in "
                     + std::to_string(n_moves) + " move(s)");
}

template class ContactClosing<2>;
template class ContactClosing<3>;
} // namespace scree
