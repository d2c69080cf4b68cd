#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/base/interruption.h>
#include <scree/output/region_output.h>
#include <scree/state/checkpoint_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_out.h>

#include <algorithm>
#include <map>
#include <optional>

namespace scree
{
namespace
{
const std::string start_anew = "start it anew: there is no checkpoint";

/** The parameters in the stage that a run has reached. */
template <int dim>
Parameters<dim>
in_stage(const Parameters<dim> &input, const StageRecord<dim> &record)
{
  Parameters<dim> result = input;
  set_times(input.stages, record, result.time);
  set_motions(input.stages, record, result.bodies);
  set_friction(input.stages, record, result.contact);
  result.time_scheme.is_static_stage = is_static(input.stages, record);
  return result;
}
} // namespace

template <int dim>
Simulation<dim>::Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
                            const MPI_Comm communicator, const Checkpoint<dim> *checkpoint,
                            const StepperFactory<dim> &stepper_of)
    : input(parameters)
    , communicator(communicator)
    , stages(input.stages, checkpoint ? checkpoint->stages : StageRecord<dim>(), communicator)
    , parameters(in_stage(input, stages.record()))
    , directory(output_directory)
    , run_log{Log(communicator, output_directory + "/log.txt", checkpoint != nullptr), {}, {}}
    , report(run_log)
    , step_control(this->parameters.time)
    , model(this->parameters, step_control.step_size(), communicator, run_log)
    , stepper(stepper_of(this->parameters, step_control, model, run_log))
    , results(directory, model.state().bodies, parameters.output.probes, parameters.output.fields,
              model.pairs_change(), {!parameters.stages.empty(), parameters.time.is_by_error()})
    , saver(this->parameters.output, directory, communicator, run_log,
            [this]() { return collect(); })
{
  const DiscreteProblem<dim> &problem = model.problem();
  results.set_discretization(problem.space, problem.level_set_nodes);
  results.require_distinct_columns(problem.equilibrium(), problem.contact());
  // Probes outside their bodies are told before anything is computed.
  results.require_probes(*problem.kinematics,
                         problem.equilibrium().with_ghosts(model.state().displacement));
  stages.require_known(results.quantities(problem.equilibrium(), problem.contact()));
  report_set_up();
  if (checkpoint)
    resume(*checkpoint);
}

template <int dim>
void
Simulation<dim>::report_set_up()
{
  if (!parameters.title.empty())
    run_log.log.line(parameters.title);
  for (const std::string &warning : parameters.warnings)
    run_log.log.line("Warning: " + warning);
  report.set_up(model.problem(), model.pairs_change());
}

template <int dim>
void
Simulation<dim>::run(const std::function<void()> &after_step)
{
  const Interruption interruption(dealii::Utilities::MPI::this_mpi_process(communicator) == 0);
  dealii::Timer      wall;
  unsigned int       n_attempts = 0; // of the present step
  std::optional<State<dim>> before;  // it, where it may be taken back
  if (!step_control.finished())
    require_prescribable();
  stepper->begin();
  begin_stages();
  while (!step_control.finished())
    {
      shorten_step();
      if (stages.has_stop() && !before)
        before = model.state();
      Attempt<dim> attempt = stepper->attempt();
      ++n_attempts;
      if (!attempt.is_accepted())
        {
          if (attempt.outcome == Attempt<dim>::Outcome::interrupted)
            end_if_interrupted();
          try_again(attempt);
          continue;
        }
      attempt.record.attempts = n_attempts;
      attempt.record.stage    = stages.number();
      if (is_cut(attempt))
        {
          model.take_back(std::move(*before), step_control.step_size());
          before.reset();
          continue;
        }
      n_attempts = 0;
      before.reset();
      finish_step(attempt, wall.wall_time());
      if (after_step)
        after_step();
    }
  finish();
}

template <int dim>
void
Simulation<dim>::begin_stages()
{
  if (parameters.stages.empty() || step_control.n_accepted() > 0)
    return;
  run_log.log.line("Stage " + stages.stage().name);
  const DiscreteProblem<dim> &problem = model.problem();
  const auto                  region  = assembly_region(
                      problem.space, problem.level_set_nodes, model.state().bodies, problem.quadrature,
                      problem.equilibrium().with_ghosts(model.state().displacement));
  stages.begin_run({region.lengths.begin_raw(), region.lengths.end_raw()});
}

template <int dim>
bool
Simulation<dim>::is_cut(const Attempt<dim> &attempt)
{
  const Timings::Scope        scope(run_log.timings, "output");
  const DiscreteProblem<dim> &problem = model.problem();
  if (model.is_moving()) // Closing contact may have moved it.
    results.set_discretization(problem.space, problem.level_set_nodes);
  results.gather_history(attempt.record, problem.equilibrium(), problem.contact(),
                         problem.quadrature, model.state().displacement);
  if (parameters.stages.empty())
    return false;
  const auto names  = results.quantities(problem.equilibrium(), problem.contact());
  const auto values = results.quantity_values();
  std::map<std::string, double> quantities;
  for (unsigned int i = 0; i < std::min(names.size(), values.size()); ++i)
    quantities[names[i]] = values[i];
  const double part = stages.observe(std::move(quantities), attempt.record.time);
  if (part == 1. || !step_control.cut(part))
    return false;
  run_log.log.line("Step " + std::to_string(attempt.record.step) + " to time "
                   + short_number(attempt.record.time) + " goes beyond " + stages.stage().until
                   + ": it is taken again, to time " + short_number(step_control.next_time()));
  return true;
}

template <int dim>
void
Simulation<dim>::shorten_step()
{
  const double size = step_control.step_size();
  require(step_control.shorten(stepper->largest_step()), "Time",
          "the smallest step is longer than " + short_number(stepper->largest_step())
            + ", the largest that can be taken at time " + short_number(step_control.time()),
          "use more steps, or a smaller Minimum step fraction");
  const StepEvent event = stepper->next_event();
  if (event.time_left < step_control.step_size()
      && step_control.end_before(event.time_left, !event.pair.empty()) && !event.pair.empty())
    run_log.log.line("The next step ends at time " + short_number(step_control.next_time())
                     + ", where contact of " + event.pair + " begins");
  if (model.is_moving() && step_control.step_size() < size)
    model.begin_again(step_control.step_size());
}

template <int dim>
void
Simulation<dim>::finish_step(Attempt<dim> &attempt, const double wall_time)
{
  step_control.accept(attempt.record.newton_iterations, attempt.error);
  const bool stage_ends = ends_stage();
  write_results(attempt.record);
  const double done = step_control.time() / parameters.time.end_time;
  report.step(attempt.record, model.problem().contact(), communicator, done,
              wall_time * (1. - done) / (done - fraction_at_restart));
  report.under_resolved(model.problem());
  report.energies(model.problem().equilibrium().energies(), step_control.time());
  if (model.is_moving())
    {
      const auto motion = model.move_geometry(std::move(attempt.points), step_control.step_size());
      results.set_discretization(model.problem().space, model.problem().level_set_nodes);
      results.gather_motion(motion);
      write_points(attempt.record);
    }
  results.write_history();
  if (stage_ends && !step_control.finished())
    begin_next_stage();
  save_if_due();
  end_if_interrupted();
}

template <int dim>
bool
Simulation<dim>::ends_stage()
{
  const double time = step_control.time();
  if (!stages.accept(time))
    return false;
  if (stages.is_reached())
    run_log.log.line("Stage " + stages.stage().name + " reached " + stages.stage().until
                     + " at time " + short_number(time));
  else if (stages.has_stop())
    run_log.log.line("Warning: stage " + stages.stage().name + " ended without reaching "
                     + stages.stage().until + "; give it a longer Duration");
  const Equilibrium<dim> &equilibrium = model.problem().equilibrium();
  stages.begin_next(equilibrium.rigid_states(equilibrium.with_ghosts(model.state().displacement)),
                    model.state().bodies);
  set_times(input.stages, stages.record(), parameters.time);
  step_control.change_times(parameters.time);
  return true;
}

template <int dim>
void
Simulation<dim>::begin_next_stage()
{
  run_log.log.line("Stage " + stages.stage().name);
  parameters.bodies = input.bodies;
  set_motions(input.stages, stages.record(), parameters.bodies);
  parameters.time_scheme.is_static_stage = is_static(input.stages, stages.record());
  const double step_size                 = step_control.step_size();
  model.begin_stage(set_friction(input.stages, stages.record(), parameters.contact), step_size);
  if (stages.stage().resets)
    run_log.log.line("  the bodies are reset: stored energy changes by "
                     + short_number(model.reset(step_size)));
  results.set_discretization(model.problem().space, model.problem().level_set_nodes);
}

template <int dim>
void
Simulation<dim>::try_again(const Attempt<dim> &attempt)
{
  if (stepper->finds_another_way(attempt.outcome))
    return;
  const bool is_shorter = attempt.outcome == Attempt<dim>::Outcome::inaccurate
                            ? step_control.reject(*attempt.error)
                            : step_control.reject();
  require(is_shorter, "Time",
          "the load step to time " + short_number(attempt.record.time)
            + " was not solved, not even with the smallest step",
          "see the reasons above; use more steps, a smaller tangential penalty factor, or "
          "support the bodies that are not held");
  run_log.log.line("  the step is tried again with "
                   + short_number(100. * step_control.step_fraction()) + "% of its length");
  if (model.is_moving())
    model.begin_again(step_control.step_size());
}

template <int dim>
void
Simulation<dim>::write_results(const StepRecord &record)
{
  const Timings::Scope        scope(run_log.timings, "output");
  const DiscreteProblem<dim> &problem = model.problem();
  const auto                 &u       = model.state().displacement;
  const auto                  ghosted = problem.equilibrium().with_ghosts(u);
  results.write_probes(record, *problem.kinematics, ghosted);
  bool is_written = true;
  if (is_due(parameters.output.fields_every, record))
    {
      std::optional<VelocityField<dim>> velocities;
      if (model.has_inertia())
        velocities.emplace(*problem.mass, u, model.state().predictor.rates.velocity);
      is_written &= results.write_fields(record, *problem.kinematics, ghosted,
                                         velocities ? &*velocities : nullptr);
    }
  if (is_due(parameters.output.contact_every, record))
    is_written &= results.write_contact(record, problem.contact());
  warn_unless(is_written);
}

template <int dim>
bool
Simulation<dim>::is_due(const unsigned int every, const StepRecord &record) const
{
  return every > 0 && (record.step % every == 0 || step_control.finished());
}

template <int dim>
void
Simulation<dim>::write_points(const StepRecord &record)
{
  const Timings::Scope scope(run_log.timings, "output");
  warn_unless(!is_due(parameters.output.points_every, record)
              || results.write_points(record, model.state().points, model.has_inertia()));
}

template <int dim>
void
Simulation<dim>::warn_unless(const bool is_written)
{
  if (!is_written)
    run_log.log.line("Warning: pictures of this step cannot be written (is the disk full?)");
}

template <int dim>
void
Simulation<dim>::finish()
{
  require(results.flush(), directory,
          "rows of history.csv or other tables could not be written to the last",
          "make room on the disk and " + way_on());
  report.end(model.problem(), step_control.n_rejected(), saver.n_saved(), saver.bytes(), directory);
}

template <int dim>
void
Simulation<dim>::check()
{
  require_prescribable();
  const DiscreteProblem<dim> &problem = model.problem();
  results.write_contact(StepRecord(), problem.contact());
  results.write_fields(StepRecord(), *problem.kinematics,
                       problem.equilibrium().with_ghosts(model.state().displacement), nullptr);
  write_regions_csv(problem.boundary_terms.regions(), model.state().bodies, communicator,
                    directory);
  dealii::GridOut().write_mesh_per_processor_as_vtu(problem.grid.triangulation(),
                                                    directory + "/grid");
  run_log.log.line("The input is fine; nothing was computed. Set-up written to " + directory);
  plot(directory, communicator);
}

template <int dim>
void
Simulation<dim>::require_prescribable()
{
  auto         u     = model.state().displacement;
  const double start = model.state().time, end = parameters.time.end_time;
  for (const double time : {step_control.next_time(), 0.5 * (start + end), end, start})
    model.problem().equilibrium().set_time(time, u);
}

template <int dim>
void
Simulation<dim>::save_if_due()
{
  const bool is_written = results.flush();
  if (!is_written)
    run_log.log.line(
      "Warning: rows of history.csv or other tables cannot be written (is the disk full?). They "
      "are kept and tried again after the next step; no checkpoint is written meanwhile, the last "
      "one remains");
  // The first process, which writes the tables, decides.
  if (dealii::Utilities::MPI::broadcast(communicator, is_written)
      && saver.is_due(step_control.n_accepted(), step_control.finished()))
    saver.save();
}

template <int dim>
void
Simulation<dim>::end_if_interrupted()
{
  const int signal = dealii::Utilities::MPI::max(Interruption::signal(), communicator);
  if (signal == 0)
    return;
  const bool        may_resume = parameters.study.n_cycles <= 1;
  const std::string by         = "interrupted by " + signal_name(signal) + " ";
  const std::string after      = step_control.n_accepted() == 0
                                   ? "in the first load step"
                                   : "after step " + std::to_string(step_control.n_accepted());
  std::string       remedy;
  if (may_resume && step_control.n_accepted() > 0)
    {
      if (dealii::Utilities::MPI::broadcast(communicator, results.flush()))
        saver.save();
      remedy = way_on();
    }
  else
    remedy = start_anew;
  run_log.log.line("The run was " + by + after + "; " + remedy);
  throw Interrupted{signal, by + after + "\n  remedy: " + remedy};
}

template <int dim>
std::string
Simulation<dim>::way_on() const
{
  return has_checkpoint(directory) ? "go on with scree --resume " + directory : start_anew;
}

template <int dim>
Checkpoint<dim>
Simulation<dim>::collect() const
{
  Checkpoint<dim> result;
  result.program    = std::string(SCREE_VERSION) + " (commit " + SCREE_REVISION + ")";
  result.parameters = parameters.resolved;
  result.steps      = step_control.record();
  result.stages     = stages.record();
  result.results    = results.record();
  result.report     = report.record();
  result.warnings   = run_log.warnings;
  result.stepper    = stepper->recorded();
  result.state      = model.gathered();
  return result;
}

template <int dim>
void
Simulation<dim>::resume(const Checkpoint<dim> &checkpoint)
{
  step_control.resume(checkpoint.steps);
  const double time   = step_control.time();
  run_log.warnings    = checkpoint.warnings;
  fraction_at_restart = time / parameters.time.end_time;
  stepper->resume(checkpoint.stepper);
  model.restore(checkpoint.state, time, step_control.step_size(), directory);
  const DiscreteProblem<dim> &problem = model.problem();
  results.set_discretization(problem.space, problem.level_set_nodes);
  report.resume(checkpoint.report);
  results.resume(checkpoint.results, problem.equilibrium(), problem.contact());
  if (!checkpoint.warning.empty())
    {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        set_damaged_aside(directory);
      run_log.log.line("Warning: " + checkpoint.warning);
    }
  run_log.log.line("Resumed after step " + std::to_string(step_control.n_accepted()) + ", time "
                   + short_number(time) + "; the checkpoint is of scree " + checkpoint.program);
  if (step_control.finished())
    run_log.log.line("The run had reached its end time; to go on beyond it, set Time/End time and "
                     "Time/Steps");
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace scree
