#pragma once

#include <scree/application/checkpoint_saver.h>
#include <scree/application/contact_closing.h>
#include <scree/application/model.h>
#include <scree/application/stepper.h>
#include <scree/output/run_report.h>

#include <string>
#include <vector>

namespace scree
{
/**
 * A run: sets the bodies up on their grid, walks through the load steps, writes what happens. The
 * steps are those of theory.md section 3.
 */
template <int dim>
class Simulation
{
public:
  /**
   * @param output_directory where results go; must exist
   * @param checkpoint       of the run in that directory, which goes on after it; null: a new run
   * @throws UserError if the set-up is impossible, or the checkpoint belongs to something else
   */
  Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
             const MPI_Comm communicator, const Checkpoint<dim> *checkpoint = nullptr);

  /** All load steps. @throws UserError if a step cannot be solved. */
  void run();

  /** Reports what was set up and writes it for pictures; computes nothing. */
  void check();

  /** The bodies and their discrete problem. */
  const Model<dim> &get_model() const
  {
    return model;
  }

  /** Columns of history.csv and probes.csv, and their values after the last step. */
  std::vector<std::string> columns() const
  {
    return results.columns(model.problem().equilibrium(), model.problem().contact());
  }
  std::vector<double> last_values() const
  {
    return results.last_values();
  }

private:
  /** How the present step was tried so far. */
  struct Tries
  {
    unsigned int n          = 1;
    bool         has_turned = false; //!< to the other kind of attempt
  };

  void report_set_up();
  /** Writes the accepted step, moves the geometry, saves. */
  void finish_step(Attempt<dim> &attempt, const double wall_time);
  /** Prepares another attempt of a step: another kind of attempt, or a shorter step. */
  void try_again(const Attempt<dim> &attempt, Tries &tries);
  /** Whether the step that was not solved may be tried at its full length in another way. */
  bool finds_another_way(const double time, Tries &tries);
  void write_results(const StepRecord &record);
  void save_if_due();
  /** Saves and @throws Interrupted if a signal asked for it (collective). */
  void end_if_interrupted();
  void finish();
  /** What is prescribed, in the first step, half way and at the end, is possible and finite. */
  void            require_prescribable();
  Checkpoint<dim> collect() const;
  /** Goes to the state of a checkpoint; the problem is set up. */
  void resume(const Checkpoint<dim> &checkpoint);

  const Parameters<dim> parameters;
  const MPI_Comm        communicator;
  const std::string     directory;
  RunLog                run_log;
  RunReport<dim>        report;
  StepControl           step_control;
  Model<dim>            model;
  Stepper<dim>          stepper;
  ContactClosing<dim>   closing;
  Results<dim>          results;
  CheckpointSaver<dim>  saver;
  double                fraction_at_restart = 0.; //!< of the end time
  bool                  has_slid = false; //!< bodies may have: contact was closed with friction
};
} // namespace scree
