#pragma once

#include <scree/application/contact_closing.h>
#include <scree/application/relaxation.h>
#include <scree/application/step_accuracy.h>
#include <scree/application/stepper.h>
#include <scree/contact/status_changes.h>
#include <scree/mechanics/time_scheme.h>
#include <scree/solver/newton.h>

#include <string>
#include <utility>

namespace scree
{
/**
 * Finds the equilibrium at the end of a step by Newton's method, and checks it (theory.md section
 * 3, steps 5 and 6).
 */
template <int dim>
class ImplicitStepper : public Stepper<dim>
{
public:
  using Vector = typename Equilibrium<dim>::Vector;

  /** All of these outlive it. */
  ImplicitStepper(const Parameters<dim> &parameters, const StepControl &step_control,
                  Model<dim> &model, RunLog &run_log);

  /** Resolves overlap; lets free bodies fall before the first step. */
  void          begin() override;
  double        largest_step() const override;
  StepEvent     next_event() const override;
  Attempt<dim>  attempt() override;
  bool          finds_another_way(const typename Attempt<dim>::Outcome outcome) override;
  StepperRecord recorded() const override;
  void          resume(const StepperRecord &record) override;

  /**
   * Newton's method from u, at the loads and conditions that were set, without inertia; of no step:
   * nothing is said if contact carries nothing in the end.
   *
   * @param is_patient whether it goes on beyond 60 iterations
   */
  NewtonResult solve(Vector &u, const bool is_patient = true);

  /** Whether a signal asked the run to end (collective). */
  bool is_interrupted() const;

  /** The material points at u, and why they moved too far for the geometry; empty: they did not. */
  std::pair<MaterialPoints<dim>, std::string> move_points(const Vector &u) const;

  /** The largest increment of a body that supports do not hold [L] (collective). */
  double largest_free_motion(const Vector &u) const;

private:
  /** Whether StepAccuracy::test() holds; if not, with the outcome. */
  bool is_accurate(const Vector &u, const Rates &rates, Attempt<dim> &attempt);
  /** With inertia, where nothing resolves it. */
  void warn_of_overlap() const;
  /** In runs with inertia: kinetic energy, momenta, and velocities of material points. */
  void take_motion(const Vector &u, const Rates &rates, Attempt<dim> &attempt) const;
  /** The material points after the step; false, with the outcome, if they moved too far. */
  bool take_points(const Vector &u, Attempt<dim> &attempt);
  /** NewtonParameters::patience: of the input, or 60 while there are other ways to go, 30 while
   * contact_prediction() is one. */
  unsigned int patience(const bool is_patient) const;
  /** @param left what of the residual may be left, beyond the tolerances [force] */
  Newton       newton(const unsigned int patience, const double left = 0.);
  NewtonResult solve_step(Vector &u);
  /** Newton's method, again while the enforcement of contact changes its multipliers. */
  NewtonResult solve_enforced(const Newton &newton, Vector &u);
  /** Whether several bodies of a moving geometry that only contact holds may be where a
   * contact_prediction() leads. */
  bool may_predict_contact() const;
  /** The u from which Newton's method starts: first_guess() or a contact_prediction() from it. */
  Vector guess(const double time);
  /** Sum of contact pressures that is none beside those of this step [force]. */
  double negligible_pressure() const
  {
    return 1e-6 * most_pressed;
  }
  /** Whether all contact pressure went in the last solution, though there was some. */
  bool has_lost_contact(const NewtonResult &result) const
  {
    return result.converged() && pressed < negligible_pressure();
  }
  NewtonResult  solve_with_sticking(const Newton &newton, const Vector &start, Vector &u,
                                    const NewtonResult &result);
  Newton::Hooks hooks();
  void          set_hooks_of_lagging(Newton::Hooks &hooks);
  void          observe(const NewtonIteration &iteration);
  /** Solves K x = b to the tolerance of the linear solver; may throw LinearSolverFailure. */
  typename LocalError<dim>::Solve linear_solve();
  LinearSolveResult solve_linear_system(const Vector &r, const double tolerance, Vector &du);
  /** Solves again while `du` moves bodies far that nothing holds, see BodyHolds. */
  void hold_bodies(const Vector &r, const double tolerance, Vector &du);

  const Parameters<dim> &parameters;
  const StepControl     &step_control;
  Model<dim>            &model;
  RunLog                &run_log;
  ContactClosing<dim>    closing;
  Relaxation<dim>        relaxation;
  StepAccuracy<dim>      accuracy;
  StepRecord             record;                    //!< that is being solved
  bool                   is_second_attempt = false; //!< of all steps until it changes
  bool                   has_turned        = false; //!< this step, to the other kind of attempt
  bool                   predicts_contact  = false; //!< this step, after an attempt that failed
  bool                   has_slid = false; //!< bodies may have: contact was closed with friction
  bool                   goes_far = false; //!< a free body, in an attempt that was too large
  bool   has_slipped              = false; //!< it went as far in the one before, which was longer
  double free_motion
    = std::numeric_limits<double>::infinity(); //!< largest in the last of these [L]
  bool   has_more_mass = false;                //!< K, in a lagged step
  double pressed = 0., most_pressed = 0.; //!< contact pressures, added up: now and at most [force]
  StatusChanges status_changes;
};
} // namespace scree
