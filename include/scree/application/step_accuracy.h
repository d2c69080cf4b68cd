#pragma once

#include <scree/application/model.h>
#include <scree/application/stepper.h>
#include <scree/mechanics/local_error.h>

#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * Tests steps by the LocalError of their scheme, relative to the way V dt of the largest speed V of
 * a body so far, and looks ahead to where they should end.
 *
 * Where contact begins or ends the accelerations of bodies jump. A step in which it begins with too
 * large an error is taken again, shorter, as others are. If the error then hardly falls contact is
 * over in less than a step, however short that is, as it is in an impact of rigid bodies: bodies
 * whose contact begins are left out of the test. So are those whose contact ends.
 */
template <int dim>
class StepAccuracy
{
public:
  using Vector = typename Equilibrium<dim>::Vector;
  using Solve  = typename LocalError<dim>::Solve;

  /** All of these outlive it. */
  StepAccuracy(const TimeParameters &parameters, const StepControl &step_control,
               const Model<dim> &model, RunLog &run_log);

  /** Whether steps of the present stage are tested. */
  bool is_active() const
  {
    return parameters.is_by_error() && model.has_inertia();
  }

  /** Where the step should end that the step control says (collective). */
  StepEvent next_event() const;

  /** Before an attempt: what the bodies do at the start of the step (collective). */
  void begin_attempt();

  /**
   * After an attempt: whether the step to u is accurate enough, with its error in the attempt; u is
   * that of the last residual() (collective).
   */
  bool test(const Vector &u, const Rates &rates, const Solve &solve, Attempt<dim> &attempt);

  /** The step is accepted. */
  void accept();

  double recorded() const
  {
    return largest_speed;
  }
  void resume(const double speed)
  {
    largest_speed = speed;
  }

private:
  /** The pairs whose contact begins or ends. */
  struct Changes
  {
    std::vector<bool> bodies;
    std::string       names;
    bool              are_any = false, have_begun = false;
  };
  Changes changes() const;

  /** V dt, at least the motion of bodies at rest [L]. */
  double way(const double speed) const;

  const TimeParameters          &parameters;
  const StepControl             &step_control;
  const Model<dim>              &model;
  RunLog                        &run_log;
  std::optional<LocalError<dim>> local_error;         //!< of the attempt
  double                         largest_speed  = 0.; //!< V [L/time]
  double                         speed          = 0.; //!< after the attempt
  double                         last_error     = 0.; //!< of the last attempt at the step; 0: none
  double                         last_step_size = 0.; //!< of that [time]
};
} // namespace scree
