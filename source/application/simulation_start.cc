#include <scree/application/simulation.h>

#include <algorithm>

// What closes contact before the first step: overlap, falls, closing without friction.
namespace scree
{
template <int dim>
std::optional<double>
Simulation<dim>::resolve_part(const std::vector<double> &overlaps, const double left)
{
  record       = StepRecord();
  auto u       = state.displacement;
  auto allowed = overlaps;
  for (double &overlap : allowed)
    overlap *= left;
  contact->resolve_overlap(allowed);
  equilibrium->set_unloaded(u);
  const NewtonResult result = solve_equilibrium(u);
  record.newton_iterations  = result.iterations;
  bool is_solved            = result.converged();
  if (is_solved && is_moving())
    {
      points_at_end = moved_points(u);
      is_solved     = why_too_large().empty();
    }
  double largest_motion = 0.;
  if (is_solved)
    {
      const auto motions = equilibrium->largest_displacements(u);
      largest_motion     = *std::max_element(motions.begin(), motions.end());
      equilibrium->accept(u, state.contact);
      equilibrium->count_overlap();
      go_on_from(u);
    }
  contact->resolve_overlap({});
  return is_solved ? std::make_optional(largest_motion) : std::nullopt;
}

template <int dim>
void
Simulation<dim>::resolve_overlap()
{
  constexpr double       negligible = 1e-6; // cells
  constexpr double       first_drag = 0.1, largest_drag = 10.;
  constexpr double       at_rest   = 0.05; // cells
  constexpr unsigned int max_moves = 10;   // of a part
  const auto             overlaps  = contact->overlaps(communicator);
  const double           largest
    = overlaps.empty() ? 0. : *std::max_element(overlaps.begin(), overlaps.end());
  auto u = state.displacement;
  if (has_started() || largest < negligible * grid->finest_size() || !equilibrium->set_unloaded(u))
    return;
  TimeParameters parts;
  parts.minimum_step_fraction = 1. / 1024;
  StepControl  control(parts);
  unsigned int n_iterations = 0, n_parts = 0, n_moves = 0; // moves of the present part
  bool         goes_on = true;
  double       drag    = 0.;
  while (goes_on && !control.finished())
    {
      const auto motion = resolve_part(overlaps, 1. - control.next_time());
      n_iterations += record.newton_iterations;
      if (motion)
        {
          ++n_parts;
          if (drag == 0. || *motion < at_rest * grid->finest_size() || ++n_moves >= max_moves)
            {
              n_moves = 0;
              control.accept(record.newton_iterations);
            }
        }
      else if (is_moving() && drag < largest_drag && !equilibrium->free_bodies().empty())
        drag = std::max(first_drag, 10. * drag);
      else
        goes_on = control.reject();
      equilibrium->set_drag(drag);
    }
  equilibrium->set_drag(0.);
  if (goes_on)
    log.line("Overlap at the start is resolved without friction in " + std::to_string(n_parts)
             + " part(s) and " + std::to_string(n_iterations) + " iterations");
  else
    log.line("Warning: the overlap at the start is resolved without friction only to "
             + short_number(100. * control.time())
             + "%; the first step resolves the rest, with friction");
}

template <int dim>
void
Simulation<dim>::go_on_from(const typename Equilibrium<dim>::Vector &u)
{
  state.displacement = u;
  state.contact      = contact->current_history();
  geometry_has_moved = true;
  if (is_moving())
    move_geometry();
}

template <int dim>
bool
Simulation<dim>::close_without_friction()
{
  auto u = state.displacement, unused = u;
  if (equilibrium->set_moved(step_control.next_time(), u))
    {
      equilibrium->set_time(state.time, unused);
      return false;
    }
  record = StepRecord();
  contact->resolve_overlap(std::vector<double>(contact->pairs().size(), 0.));
  bool is_closed = solve_equilibrium(u).converged();
  if (is_closed && is_moving())
    {
      equilibrium->turn(u);
      points_at_end = moved_points(u);
      is_closed     = why_too_large().empty();
    }
  if (is_closed)
    equilibrium->accept_as_transfer(u, state.contact);
  contact->resolve_overlap({});
  equilibrium->set_time(state.time, unused);
  if (!is_closed)
    return false;
  log.line("  the loads close contact without friction, which begins there");
  go_on_from(u);
  return true;
}

template <int dim>
void
Simulation<dim>::settle()
{
  constexpr unsigned int max_moves  = 200;
  constexpr double       negligible = 1e-3;
  if (!is_moving() || equilibrium->free_bodies().empty())
    return;
  unsigned int n_moves = 0;
  for (; n_moves < max_moves; ++n_moves)
    {
      auto u = state.displacement, r = u, unused = u;
      equilibrium->set_time(step_control.next_time(), unused);
      equilibrium->residual(u, state.contact, r);
      const auto work = equilibrium->balance_rigid_motions(u, state.contact, true);
      equilibrium->set_time(state.time, unused);
      if (!work || *work < negligible)
        break;
      equilibrium->residual(u, state.contact, r);
      points_at_end = moved_points(u);
      equilibrium->accept_as_transfer(u, state.contact);
      go_on_from(u);
    }
  if (n_moves > 0)
    log.line("  bodies that nothing holds fall until contact does, in " + std::to_string(n_moves)
             + " move(s)");
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template std::optional<double> Simulation<dim>::resolve_part(const std::vector<double> &,     \
                                                               const double);                   \
  template void                  Simulation<dim>::resolve_overlap();                            \
  template void                  Simulation<dim>::go_on_from(const Equilibrium<dim>::Vector &); \
  template bool                  Simulation<dim>::close_without_friction();                     \
  template void                  Simulation<dim>::settle();

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
