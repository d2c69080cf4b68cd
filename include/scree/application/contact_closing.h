#pragma once

#include <scree/application/model.h>
#include <scree/solver/step_control.h>

#include <optional>
#include <vector>

namespace scree
{
template <int dim>
class ImplicitStepper;

/** What brings bodies into contact before a step, so that friction begins with tau = 0. */
template <int dim>
class ContactClosing
{
public:
  using Vector = typename Equilibrium<dim>::Vector;

  /** All of these outlive it. */
  ContactClosing(const StepControl &step_control, Model<dim> &model, ImplicitStepper<dim> &stepper,
                 RunLog &run_log);

  /**
   * Before the first step bodies that overlap find their equilibrium without friction and loads, on
   * a moving geometry in parts, where that fails against a drag: friction begins with tau = 0, the
   * energy is external work. If something is prescribed at t = 0, or nothing helps, step 1 does it.
   */
  void resolve_overlap();

  /**
   * On a moving geometry free bodies fall as rigid ones, driven by the loads of the next step, half
   * a cell at a time, until contact holds them; the energy is that of transfer. Where it does not
   * hold them in 200 moves they stay where they were.
   */
  void settle();

  /** The loads of step 1 close contact without friction; false: no, or motion is prescribed. */
  bool close_without_friction();

private:
  /** One part, which leaves the overlaps times `left`: the largest motion [L]; empty: it failed. */
  std::optional<double> resolve_part(const std::vector<double> &overlaps, const double left);

  /** Takes u, which the equilibrium accepted, as the state at the present time. */
  void go_on_from(const Vector &u, MaterialPoints<dim> &&points);

  const StepControl    &step_control;
  Model<dim>           &model;
  ImplicitStepper<dim> &stepper;
  RunLog               &run_log;
  unsigned int          n_iterations = 0; //!< of the last part
};
} // namespace scree
