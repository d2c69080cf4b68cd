#pragma once

#include <scree/application/model.h>
#include <scree/contact/status_changes.h>
#include <scree/output/run_report.h>
#include <scree/solver/newton.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** What came of an attempt of a step. */
template <int dim>
struct Attempt
{
  enum class Outcome
  {
    accepted,
    unsolved, //!< no equilibrium was found
    too_large //!< one was found, too far for the moving geometry
  };

  Outcome             outcome = Outcome::unsolved;
  StepRecord          record;
  MaterialPoints<dim> points; //!< after an accepted step on a moving geometry

  bool is_accepted() const
  {
    return outcome == Outcome::accepted;
  }
};

/**
 * Finds the equilibrium at the end of a step by Newton's method, and checks it (theory.md section
 * 3, steps 5 and 6). The state of the model changes if a step is accepted and not before; then
 * Model::move_geometry() is next on a moving geometry.
 */
template <int dim>
class Stepper
{
public:
  using Vector = typename Equilibrium<dim>::Vector;

  /** All of these outlive it. */
  Stepper(const Parameters<dim> &parameters, const StepControl &step_control, Model<dim> &model,
          RunLog &run_log);

  /** One attempt of the step that the step control says (collective). */
  Attempt<dim> attempt();

  /** How steps are tried, see Equilibrium::set_second_attempt(). */
  void set_second_attempt(const bool is_second)
  {
    is_second_attempt = is_second;
  }
  bool second_attempt() const
  {
    return is_second_attempt;
  }

  /**
   * Newton's method from u, at the loads and conditions that were set; of no step: nothing is said
   * if contact carries nothing in the end.
   */
  NewtonResult solve(Vector &u);

  /** The material points at u, and why they moved too far for the geometry; empty: they did not. */
  std::pair<MaterialPoints<dim>, std::string> move_points(const Vector &u) const;

private:
  NewtonResult solve_step(Vector &u);
  /** Newton's method, again while the enforcement of contact changes its multipliers. */
  NewtonResult solve_enforced(const Newton &newton, Vector &u);
  /** Whether all contact pressure went in the last solution, though there was some. */
  bool              has_lost_contact(const NewtonResult &result) const;
  NewtonResult      solve_with_sticking(const Newton &newton, const Vector &start, Vector &u,
                                        const NewtonResult &result);
  Newton::Hooks     hooks();
  void              set_hooks_of_mass(Newton::Hooks &hooks);
  void              observe(const NewtonIteration &iteration);
  LinearSolveResult solve_linear_system(const Vector &r, const double tolerance, Vector &du);

  const Parameters<dim> &parameters;
  const StepControl     &step_control;
  Model<dim>            &model;
  RunLog                &run_log;
  StepRecord             record;                    //!< of the step being solved
  bool                   is_second_attempt = false; //!< of all steps until it changes
  bool                   is_transient      = false; //!< K has more artificial mass
  double pressed = 0., most_pressed = 0.; //!< contact pressures, added up: now and at most [force]
  StatusChanges status_changes;
};
} // namespace scree
