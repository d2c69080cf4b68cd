#include <scree/application/implicit_stepper.h>
#include <scree/application/relaxation.h>
#include <scree/base/exceptions.h>

namespace scree
{
template <int dim>
Relaxation<dim>::Relaxation(const StepControl &step_control, Model<dim> &model,
                            ImplicitStepper<dim> &stepper, RunLog &run_log)
    : step_control(step_control)
    , model(model)
    , stepper(stepper)
    , run_log(run_log)
{
}

template <int dim>
bool
Relaxation<dim>::may_help() const
{
  return model.is_moving() && !model.has_inertia()
         && !model.problem().equilibrium().free_bodies().empty();
}

template <int dim>
std::optional<double>
Relaxation<dim>::move(const double drag)
{
  const double      time        = step_control.next_time();
  Equilibrium<dim> &equilibrium = model.problem().equilibrium();
  auto              u           = model.state().displacement;
  equilibrium.set_time(time, u);
  equilibrium.set_drag(drag);
  const NewtonResult result = stepper.solve(u, false);
  equilibrium.set_drag(0.);
  n_iterations += result.iterations;
  if (!result.converged())
    return {};
  auto [points, reason] = stepper.move_points(u);
  if (!reason.empty())
    return {};
  const double largest = stepper.largest_free_motion(u);
  equilibrium.accept_as_transfer(u, model.state().contact);
  model.accept(u, time);
  model.move_geometry(std::move(points), step_control.step_size());
  return largest;
}

template <int dim>
bool
Relaxation<dim>::moves_to_rest()
{
  constexpr double       first_drag = 0.1, smallest_drag = 1e-5, largest_drag = 10.;
  constexpr double       growth = 10., decay = 0.3;
  constexpr double       at_rest   = 0.05; // cells
  constexpr unsigned int max_moves = 30;
  const double           h         = model.problem().grid.finest_size();
  double                 drag      = first_drag;
  run_log.log.line("  where bodies go is sought against a drag, in up to "
                   + std::to_string(max_moves) + " moves");
  for (unsigned int n_moves = 0; n_moves < max_moves && drag <= largest_drag;)
    {
      const auto motion = move(drag);
      if (!motion)
        {
          drag *= growth;
          continue;
        }
      ++n_moves;
      drag *= decay;
      if (*motion > at_rest * h && drag > smallest_drag)
        continue;
      run_log.log.line("  bodies go there against a drag, in " + std::to_string(n_moves)
                       + " move(s) and " + std::to_string(n_iterations) + " iterations");
      return true;
    }
  return false;
}

template <int dim>
bool
Relaxation<dim>::run()
{
  before       = model.state();
  n_iterations = 0;
  try
    {
      if (moves_to_rest())
        return true;
    }
  catch (const TornBody &error)
    {
      run_log.log.line("  the drag leads nowhere: " + std::string(error.what()));
    }
  go_back();
  return false;
}

template <int dim>
void
Relaxation<dim>::go_back()
{
  model.go_back(std::move(*before), step_control.step_size());
  finish();
}

template <int dim>
void
Relaxation<dim>::finish()
{
  before.reset();
}

template class Relaxation<2>;
template class Relaxation<3>;
} // namespace scree
