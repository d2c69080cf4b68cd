#pragma once

#include <scree/base/run_log.h>
#include <scree/contact/status_changes.h>
#include <scree/mechanics/discrete_problem.h>
#include <scree/output/results.h>
#include <scree/solver/newton.h>

#include <string>
#include <vector>

namespace scree
{
/** What a report knows of the steps so far: a run that is resumed goes on with it. */
struct ReportRecord
{
  bool   has_touched  = false; //!< any pair in any step
  double largest_work = 0.;    //!< of the loads up to a step, with the kinetic energy at the start
  bool   has_gained   = false; //!< energy from nowhere

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &has_touched &largest_work &has_gained;
  }
};

/** What the log says of a run: its set-up, its steps, their failures. All functions are collective.
 */
template <int dim>
class RunReport
{
public:
  explicit RunReport(RunLog &run_log)
      : run_log(run_log)
  {
  }

  /**
   * Grid, unknowns, bodies, contacts, free bodies.
   * @param pairs_change from step to step
   * @throws UserError if a body has no volume or is thinner than a cell
   */
  void set_up(const DiscreteProblem<dim> &problem, const bool pairs_change);

  /** @param done part of the run; the progress bar shows it with the wall time left [s] */
  void step(const StepRecord &record, const ContactPoints<dim> &contact,
            const MPI_Comm communicator, const double done, const double seconds_left);

  /** Warns of contact at very few points, once per pair. */
  void under_resolved(const DiscreteProblem<dim> &problem);

  /** Tells once of each body that nothing holds at the end of a step. */
  void loose(const DiscreteProblem<dim> &problem, const double time);

  /** Warns once of pairs that met on a fixed geometry beyond the contact search. */
  void meetings(const DiscreteProblem<dim> &problem, const ContactParameters &parameters,
                const typename Equilibrium<dim>::Vector &u);

  /**
   * Warns once of a motion that has got energy from nowhere, more than half of the largest work of
   * the loads so far.
   */
  void energies(const Energies &energies, const double time);

  void failure(const StepRecord &record, const NewtonResult &result,
               const ContactPoints<dim> &contact, const StatusChanges &changes,
               const MPI_Comm communicator);

  /** Wall times by part; tells if no bodies touched. @param checkpoint_bytes of the last one */
  void end(const DiscreteProblem<dim> &problem, const unsigned int n_rejected,
           const unsigned int n_checkpoints, const std::size_t checkpoint_bytes,
           const std::string &directory);

  const ReportRecord &record() const
  {
    return so_far;
  }

  void resume(const ReportRecord &record)
  {
    so_far = record;
  }

private:
  void body(const DiscreteProblem<dim> &problem, const unsigned int body, const double volume);
  void contacts(const DiscreteProblem<dim> &problem, const bool has_many);
  void free_bodies(const DiscreteProblem<dim> &problem);
  void nothing_touched(const DiscreteProblem<dim> &problem);

  RunLog      &run_log;
  ReportRecord so_far;
};

/** Makes pictures of a directory of results by contrib/plot, where it is installed. */
void plot(const std::string &directory, const MPI_Comm communicator);
} // namespace scree
