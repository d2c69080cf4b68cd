#pragma once

#include <scree/application/model.h>
#include <scree/solver/step_control.h>

#include <optional>

namespace scree
{
template <int dim>
class ImplicitStepper;

/**
 * Brings free bodies near the end of a step of a moving geometry that Newton's method did not
 * solve, or with motions too far for the geometry that did not become smaller with the step:
 * contact opens or slides somewhere, and bodies go far until others hold them. What is
 * prescribed goes there at once, free bodies follow against a drag,
 *
 *     r(u) - m M (u - u_0) = 0,    u_0 the last state, M the artificial mass,
 *
 * again and again, the geometry following, until they are at rest (pseudo-transient continuation:
 * Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998, 508-523). Then the step itself, without drag, has
 * little left to do. What drag dissipates is energy of transfer.
 */
template <int dim>
class Relaxation
{
public:
  /** All of these outlive it. */
  Relaxation(const StepControl &step_control, Model<dim> &model, ImplicitStepper<dim> &stepper,
             RunLog &run_log);

  /** Whether there are bodies to relax: on a moving geometry, without inertia. */
  bool may_help() const;

  /**
   * The moves to the end of the next step: m is 0.1 at first, 10 times as large where
   * Newton's method fails, up to 10, 0.3 times as large after each move, until no body moves
   * by more than 0.05 h or m = 1e-5. Afterwards the time of the state is the end of the step.
   * False: m or the number of moves, 30, was not enough, and nothing has changed.
   */
  bool run();

  /** Whether the state is one of run() and its step not accepted yet. */
  bool is_pending() const
  {
    return before.has_value();
  }

  /** Goes back to before run(). */
  void go_back();

  /** The step that follows is accepted. */
  void finish();

private:
  /** The moves; false: m or their number was not enough. @throws TornBody */
  bool moves_to_rest();

  /** One move: the largest of a free body [L]; empty: it failed. */
  std::optional<double> move(const double drag);

  const StepControl        &step_control;
  Model<dim>               &model;
  ImplicitStepper<dim>     &stepper;
  RunLog                   &run_log;
  std::optional<State<dim>> before;
  unsigned int              n_iterations = 0; //!< of all moves
};
} // namespace scree
