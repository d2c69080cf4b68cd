#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/output/region_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_out.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

// What a run tells: its set-up, its steps, its failures.
namespace scree
{
namespace
{
std::string
resident_memory()
{
  dealii::Utilities::System::MemoryStats stats;
  dealii::Utilities::System::get_memory_stats(stats);
  return short_number(stats.VmRSS / 1024.) + " MB";
}
} // namespace

template <int dim>
void
Simulation<dim>::report_set_up()
{
  if (!parameters.title.empty())
    log.line(parameters.title);
  log.line("Grid: " + std::to_string(grid->triangulation().n_global_active_cells())
           + " cells, finest edge " + short_number(grid->finest_size()));
  log.line("Unknowns: " + std::to_string(fields->n_dofs()) + " of degree "
           + std::to_string(parameters.degree) + " in " + std::to_string(fields->n_fields())
           + " field(s)");
  const auto volumes = bulk->volumes();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (bodies[b].is_rigid())
        {
          log.line("Body " + bodies[b].name + ": rigid, "
                   + (bodies[b].rigid->is_free() ? "driven by forces" : "its motion prescribed"));
          continue;
        }
      log.line("Body " + bodies[b].name + ": volume " + short_number(volumes[b]));
      require(volumes[b] > 0., bodies[b].path,
              "the body '" + bodies[b].name + "' has no volume on the grid",
              "raise Grid/Finest level or check the shape: the body must be wider than a few "
              "cells of edge "
                + short_number(grid->finest_size()));
      double smallest = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        smallest = std::min(smallest, bodies[b].box.side_length(d));
      if (smallest < 4. * grid->finest_size())
        log.line("Warning: body " + bodies[b].name + " is only "
                 + short_number(smallest / grid->finest_size()) + " finest cells wide");
    }
  const auto n_points  = dealii::Utilities::MPI::sum(contact->points().size(), communicator);
  const auto summaries = summarise_contact(*contact, communicator);
  for (unsigned int p = 0; p < contact->pairs().size(); ++p)
    {
      const auto &pair = contact->pairs()[p];
      log.line("Contact " + pair.name + ": " + name_of(contact_law_names, pair.law.law) + " ('"
               + pair.law.name + "')"
               + (std::isnan(summaries[p].minimum_gap)
                    ? ", farther apart than twice the shift"
                    : ", initial gap " + short_number(summaries[p].minimum_gap)));
      if (summaries[p].minimum_gap < -1e-6 * grid->finest_size())
        log.line("Warning: the bodies of " + pair.name + " overlap at the start by "
                 + short_number(summaries[p].max_penetration));
    }
  log.line("Contact points: " + std::to_string(n_points));
  for (const auto &free : equilibrium->free_bodies())
    log.line("Body " + bodies[free.body].name + " has " + std::to_string(free.n_free)
             + " rigid motion(s) that only contact can hold; a vanishing artificial mass helps the "
               "iteration");
}

template <int dim>
void
Simulation<dim>::check()
{
  record = StepRecord();
  results->write_contact(record, *contact);
  results->write_fields(record, *bulk, equilibrium->with_ghosts(state.displacement));
  write_regions_csv(boundary_terms->regions(), bodies, communicator, directory);
  dealii::GridOut().write_mesh_per_processor_as_vtu(grid->triangulation(), directory + "/grid");
  log.line("The input is fine; nothing was computed. Set-up written to " + directory);
  plot();
}

template <int dim>
void
Simulation<dim>::plot() const
{
  const std::string script = SCREE_PLOT_SCRIPT;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0
      || !std::filesystem::exists(script))
    return;
  const std::string command = "'" + script + "' '" + directory + "'";
  if (std::system(command.c_str()) != 0)
    std::cout << "No pictures: " << command << " failed" << std::endl;
}

template <int dim>
void
Simulation<dim>::report_step(const double wall_time)
{
  const double done = step_control.time() / parameters.time.end_time;
  const double left = wall_time * (1. - done) / (done - fraction_at_restart);
  double       open = 0., stick = 0., slip = 0.;
  for (const auto &summary : summarise_contact(*contact, communicator))
    {
      open += summary.open;
      stick += summary.stick;
      slip += summary.slip;
    }
  log.line("Step " + std::to_string(record.step) + ", time " + short_number(record.time) + ": "
           + std::to_string(record.newton_iterations) + " iterations, residual "
           + short_number(record.residual) + ", open/stick/slip " + short_number(open) + "/"
           + short_number(stick) + "/" + short_number(slip) + ", " + short_duration(wall_time)
           + ", left " + short_duration(left) + ", " + resident_memory());
  log.progress(done, "left " + short_duration(left));
}

template <int dim>
void
Simulation<dim>::report_under_resolved()
{
  std::string names;
  for (const unsigned int p : under_resolved_pairs(*contact, communicator))
    if (warned_pairs.insert({pairs[p].b, pairs[p].a}).second)
      names += (names.empty() ? "" : ", ") + pairs[p].name;
  if (!names.empty())
    log.line("Warning: under-resolved contact, closed at less than "
             + std::to_string(dim == 2 ? 3 : 9) + " points: " + names
             + ". Its force follows from balance, its pressure and stiffness from the grid; "
               "refine there (Grid/Refinement = contact, Finest level)");
}

template <int dim>
void
Simulation<dim>::report_end(const double wall_time)
{
  require(results->flush(), directory,
          "rows of history.csv or probes.csv could not be written to the last",
          "make room on the disk and go on with scree --resume " + directory);
  log.line("Wall time by part:");
  for (const auto &[name, seconds] : timings.parts())
    log.line("  " + name + ": " + short_number(seconds) + " s");
  if (n_checkpoints > 0)
    log.line("Checkpoints: " + std::to_string(n_checkpoints) + ", the last of "
             + short_number(1e-6 * checkpoint_bytes) + " MB");
  log.line("Finished in " + short_duration(wall_time) + " with "
           + std::to_string(step_control.n_rejected())
           + " rejected step(s). Results: " + directory);
}

template <int dim>
void
Simulation<dim>::throw_slides_away(const unsigned int body) const
{
  std::string contacts;
  const auto  summaries = summarise_contact(*contact, communicator);
  for (unsigned int p = 0; p < contact->pairs().size(); ++p)
    {
      const ContactPair &pair = contact->pairs()[p];
      if (pair.a != body && pair.b != body)
        continue;
      contacts += (contacts.empty() ? "" : "; ") + pair.name + " slips over "
                  + short_number(summaries[p].slip) + ", sticks over "
                  + short_number(summaries[p].stick) + ", is open over "
                  + short_number(summaries[p].open)
                  + (pair.law.law == ContactLaw::coulomb
                       ? " (mu = " + short_number(pair.law.friction_coefficient) + ")"
                       : "");
    }
  throw UserError(bodies[body].path,
                  "the body '" + bodies[body].name + "' slides away before time "
                    + short_number(record.time)
                    + ": neither its supports nor contact resist all of its rigid motions"
                    + (contacts.empty() ? "" : "; " + contacts),
                  "support the body, or raise the friction if it should hold");
}

template <int dim>
void
Simulation<dim>::count_flips()
{
  const auto &responses = contact->responses();
  last_status.resize(responses.size(), ContactStatus::open);
  n_flips.assign(contact->pairs().size(), 0);
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      n_flips[contact->points()[i].pair] += responses[i].status != last_status[i];
      last_status[i] = responses[i].status;
    }
}

template <int dim>
void
Simulation<dim>::explain_failure(const NewtonResult &result)
{
  log.line("Step " + std::to_string(record.step) + " to time " + short_number(record.time)
           + " failed: " + result.message);
  std::string history = "  residuals:";
  for (const double residual : result.residuals)
    history += " " + short_number(residual);
  log.line(history);
  const auto summaries = summarise_contact(*contact, communicator);
  for (unsigned int p = 0; p < summaries.size(); ++p)
    log.line("  " + contact->pairs()[p].name + ": open/stick/slip "
             + short_number(summaries[p].open) + "/" + short_number(summaries[p].stick) + "/"
             + short_number(summaries[p].slip) + ", smallest gap "
             + short_number(summaries[p].minimum_gap) + " at " + short_place(summaries[p].where)
             + ", points that changed their state in the last iteration: "
             + std::to_string(dealii::Utilities::MPI::sum(n_flips[p], communicator)));
}

#define SCREE_INSTANTIATE(dim)                                                \
  template void Simulation<dim>::report_set_up();                             \
  template void Simulation<dim>::check();                                     \
  template void Simulation<dim>::plot() const;                                \
  template void Simulation<dim>::report_step(const double);                   \
  template void Simulation<dim>::report_under_resolved();                     \
  template void Simulation<dim>::report_end(const double);                    \
  template void Simulation<dim>::throw_slides_away(const unsigned int) const; \
  template void Simulation<dim>::count_flips();                               \
  template void Simulation<dim>::explain_failure(const NewtonResult &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
