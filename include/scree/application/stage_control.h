#pragma once

#include <scree/application/stages.h>
#include <scree/application/stop_relation.h>
#include <scree/mechanics/rigid_bodies.h>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * Leads a run through its stages: which one it is in, when that one ends, what the next one finds.
 * Without stages nothing happens. Quantities are those of the first process; all functions that
 * take them are collective.
 */
template <int dim>
class StageControl
{
public:
  using Quantities = std::map<std::string, double>;

  /** @param stages outlive it; @param record of a run that goes on */
  StageControl(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
               const MPI_Comm communicator);

  /** Of the present stage, from 1; 0: there are none. */
  unsigned int number() const
  {
    return stages.empty() ? 0 : present + 1;
  }

  /** The present stage; there must be one. */
  const StageParameters<dim> &stage() const
  {
    return stages[present];
  }

  const StageRecord<dim> &record() const
  {
    return current;
  }

  /** Whether a relation may end the present stage. */
  bool has_stop() const
  {
    return stop.has_value();
  }

  /** @throws UserError if there are other names, or no formulas, in the relation of a stage */
  void require_known(const std::vector<std::string> &names) const;

  /** Begins the first stage. @param lengths of the assembly */
  void begin_run(const std::vector<double> &lengths);

  /**
   * Takes what an attempt found of a step that ends at `time`.
   *
   * @return the part of the step after which the relation holds, interpolated; 1 if it does not yet
   *         hold, or misses equality by less than 1 % of the change in the step
   */
  double observe(Quantities quantities, const double time);

  /** Takes the attempt that was observed last; whether the stage ends at `time`. */
  bool accept(const double time);

  /** Whether the stage that ended last reached its relation. */
  bool is_reached() const
  {
    return current.margin >= -tolerance;
  }

  /**
   * After the last step of a stage: begins the next one, if there is one.
   *
   * @param states of the rigid bodies after that step
   * @param bodies all of them
   */
  void begin_next(const std::vector<RigidBodyState<dim>> &states,
                  const std::vector<Body<dim>>           &bodies);

private:
  /** Of the relation of the present stage, NaN without one. */
  double margin(const double time) const;
  void   set_stop();
  double planned_end() const;

  const std::vector<StageParameters<dim>> &stages;
  const MPI_Comm                           communicator;
  StageRecord<dim>                         current;
  unsigned int                             present = 0; //!< stage
  std::optional<StopRelation>              stop;
  Quantities                               observed; //!< last
  double                                   new_margin = std::numeric_limits<double>::quiet_NaN();
  double tolerance = 0.; //!< of the margin, in the step that reaches the stop
};
} // namespace scree
