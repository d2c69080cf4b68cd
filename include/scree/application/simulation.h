#pragma once

#include <scree/application/checkpoint_saver.h>
#include <scree/application/model.h>
#include <scree/application/stage_control.h>
#include <scree/application/stepper.h>
#include <scree/output/run_report.h>

#include <functional>
#include <memory>
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
   * @param stepper_of       makes what takes the steps
   * @throws UserError if the set-up is impossible, or the checkpoint belongs to something else
   */
  Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
             const MPI_Comm communicator, const Checkpoint<dim> *checkpoint = nullptr,
             const StepperFactory<dim> &stepper_of = make_stepper<dim>);

  /**
   * All load steps.
   * @param after_step called after each accepted step, when its last_values() are there; or empty
   * @throws UserError if a step cannot be solved
   */
  void run(const std::function<void()> &after_step = {});

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
  void report_set_up();
  void begin_stages();
  /** Makes the step that comes as short as the stepper needs it. */
  void shorten_step();
  /** Gathers what was found in the step; whether it ends a stage and is to be shorter for that. */
  bool is_cut(const Attempt<dim> &attempt);
  /** Writes the accepted step, moves the geometry, saves. */
  void finish_step(Attempt<dim> &attempt, const double wall_time);
  /** Prepares another attempt of a step: in another way, or of a shorter step. */
  void try_again(const Attempt<dim> &attempt);
  /** Whether the step that was accepted ends a stage; then times are those with the next one. */
  bool ends_stage();
  void begin_next_stage();
  void write_results(const StepRecord &record);
  /** Of the moved geometry. */
  void write_points(const StepRecord &record);
  /** Whether what is written every so many steps is to be written. */
  bool is_due(const unsigned int every, const StepRecord &record) const;
  void warn_unless(const bool is_written);
  void save_if_due();
  /** Saves and @throws Interrupted if a signal asked for it (collective). */
  void end_if_interrupted();
  /** How to go on with a run that ends early. */
  std::string way_on() const;
  void        finish();
  /** What is prescribed, in the first step, half way and at the end, is possible and finite. */
  void            require_prescribable();
  Checkpoint<dim> collect() const;
  /** Goes to the state of a checkpoint; the problem is set up. */
  void resume(const Checkpoint<dim> &checkpoint);

  const Parameters<dim>               input;
  const MPI_Comm                      communicator;
  StageControl<dim>                   stages;
  Parameters<dim>                     parameters; //!< in the present stage
  const std::string                   directory;
  RunLog                              run_log;
  RunReport<dim>                      report;
  StepControl                         step_control;
  Model<dim>                          model;
  const std::unique_ptr<Stepper<dim>> stepper;
  Results<dim>                        results;
  CheckpointSaver<dim>                saver;
  double                              fraction_at_restart = 0.; //!< of the end time
};
} // namespace scree
