#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/output/region_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_out.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

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

/** Bodies or pairs that are told one by one. */
constexpr unsigned int most_told = 30;

/** "a, b, c", the first of many with their number. */
std::string
listed(const std::vector<std::string> &names)
{
  std::string text;
  for (unsigned int i = 0; i < names.size() && i < most_told; ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  return names.size() <= most_told
           ? text
           : text + " and " + std::to_string(names.size() - most_told) + " more";
}
/** Tells the pairs and what overlaps, one by one unless they are many (collective). */
template <int dim>
void
report_pairs(Log &log, const ContactPoints<dim> &contact, const bool has_many, const double h,
             const MPI_Comm communicator)
{
  const auto   summaries = summarise_contact(contact, communicator);
  unsigned int n_near = 0, n_overlaps = 0;
  double       largest = 0.;
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    {
      const auto &pair     = contact.pairs()[p];
      const bool  is_near  = !std::isnan(summaries[p].minimum_gap);
      const bool  overlaps = summaries[p].minimum_gap < -1e-6 * h;
      n_near += is_near;
      n_overlaps += overlaps;
      largest = std::max(largest, summaries[p].max_penetration);
      if (has_many)
        continue;
      log.line("Contact " + pair.name + ": " + name_of(contact_law_names, pair.law.law) + " ('"
               + pair.law.name + "')"
               + (is_near ? ", initial gap " + short_number(summaries[p].minimum_gap)
                          : ", farther apart than twice the shift"));
      if (overlaps)
        log.line("Warning: the bodies of " + pair.name + " overlap at the start by "
                 + short_number(summaries[p].max_penetration));
    }
  if (!has_many)
    return;
  log.line("Contacts: " + std::to_string(n_near) + " pairs within twice the shift");
  if (n_overlaps > 0)
    log.line("Warning: the bodies of " + std::to_string(n_overlaps)
             + " pairs overlap at the start, by up to " + short_number(largest));
  log.line("Results of the pairs are in contacts.csv, not in history.csv: there are more than "
           + std::to_string(Results<dim>::most_pairs_in_history));
}
} // namespace

template <int dim>
void
Simulation<dim>::report_set_up()
{
  if (!parameters.title.empty())
    log.line(parameters.title);
  for (const std::string &warning : parameters.warnings)
    log.line("Warning: " + warning);
  log.line("Grid: " + std::to_string(grid->triangulation().n_global_active_cells())
           + " cells, finest edge " + short_number(grid->finest_size()));
  log.line("Unknowns: " + std::to_string(fields->n_dofs()) + " of degree "
           + std::to_string(parameters.degree) + " in " + std::to_string(fields->n_fields())
           + " field(s)");
  const auto volumes = bulk->volumes();
  if (bodies.size() > most_told)
    log.line("Bodies: " + std::to_string(bodies.size()) + ", volume "
             + short_number(std::accumulate(volumes.begin(), volumes.end(), 0.)));
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (bodies[b].is_rigid())
        {
          log.line("Body " + bodies[b].name + ": rigid, "
                   + (bodies[b].rigid->is_free() ? "driven by forces" : "its motion prescribed"));
          continue;
        }
      if (bodies.size() <= most_told)
        log.line("Body " + bodies[b].name + ": volume " + short_number(volumes[b]));
      require(volumes[b] > 0., bodies[b].path,
              "the body '" + bodies[b].name + "' has no volume on the grid",
              "raise Grid/Finest level or check the shape: the body must be wider than a few "
              "cells of edge "
                + short_number(grid->finest_size()));
      const double h         = grid->finest_size();
      const double thickness = 2. * inscribed_radius(*bodies[b].shape, bodies[b].level_set);
      require(thickness > (1. - 1e-6) * h, bodies[b].path,
              "the body '" + bodies[b].name + "' is " + short_number(thickness)
                + " thick, less than a cell of edge " + short_number(h),
              "raise Grid/Finest level");
      double smallest = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        smallest = std::min(smallest, bodies[b].box.side_length(d));
      if (smallest < 4. * grid->finest_size())
        log.line("Warning: body " + bodies[b].name + " is only "
                 + short_number(smallest / grid->finest_size()) + " finest cells wide");
    }
  const auto n_points = dealii::Utilities::MPI::sum(contact->points().size(), communicator);
  report_pairs(log, *contact, pairs_change || pairs.size() > Results<dim>::most_pairs_in_history,
               grid->finest_size(), communicator);
  log.line("Contact points: " + std::to_string(n_points));
  const auto &free_bodies = equilibrium->free_bodies();
  if (free_bodies.size() > most_told)
    log.line("Bodies with rigid motions that only contact can hold: "
             + std::to_string(free_bodies.size()));
  else
    for (const auto &free : free_bodies)
      log.line("Body " + bodies[free.body].name + " has " + std::to_string(free.n_free)
               + " rigid motion(s) that only contact can hold");
}

template <int dim>
void
Simulation<dim>::check()
{
  require_prescribable();
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
  // Without a shell: a directory may have any name.
  const std::string place     = directory[0] == '-' ? "./" + directory : directory;
  const char *const command[] = {script.c_str(), place.c_str(), nullptr};
  pid_t             process   = 0;
  int               status    = 1;
  std::cout << std::flush;
  if (posix_spawn(&process, command[0], nullptr, nullptr, const_cast<char *const *>(command),
                  environ)
      == 0)
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
      {
      }
  if (status != 0)
    std::cout << "No pictures: " << script << " failed for the directory " << directory
              << std::endl;
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
           + short_number(stick) + "/" + short_number(slip) + ", " + short_duration(timings.total())
           + ", left " + short_duration(left) + ", " + resident_memory());
  log.progress(done, "left " + short_duration(left));
}

template <int dim>
void
Simulation<dim>::report_under_resolved()
{
  std::vector<std::string> names;
  for (const unsigned int p : under_resolved_pairs(*contact, communicator))
    if (warned_pairs.insert({pairs[p].b, pairs[p].a}).second)
      names.push_back(pairs[p].name);
  if (!names.empty())
    log.line("Warning: under-resolved contact, closed at less than "
             + std::to_string(dim == 2 ? 3 : 9) + " points: " + listed(names)
             + ". What loads press has the right force; gap, pressure and stiffness, and the force "
               "of what is moved, come from the grid; refine there (Grid/Refinement = contact, "
               "Finest level)");
}

template <int dim>
void
Simulation<dim>::report_end()
{
  require(results->flush(), directory,
          "rows of history.csv or other tables could not be written to the last",
          "make room on the disk and go on with scree --resume " + directory);
  log.line("Wall time by part:");
  for (const auto &[name, seconds] : timings.parts())
    log.line("  " + name + ": " + short_number(seconds) + " s");
  if (n_checkpoints > 0)
    log.line("Checkpoints: " + std::to_string(n_checkpoints) + ", the last of "
             + short_number(1e-6 * checkpoint_bytes) + " MB");
  log.line("Finished in " + short_duration(timings.total()) + " with "
           + std::to_string(step_control.n_rejected())
           + " rejected step(s). Results: " + directory);
}

template <int dim>
void
Simulation<dim>::throw_slides_away(const typename FreeBodies<dim>::Coordinates &motion,
                                   const double                                 held_until)
{
  const auto  moves = equilibrium->free_motions().in_words(motion);
  std::string what, alone;
  bool        has_friction = false, turns = false;
  for (const auto &body : moves)
    {
      what += (what.empty() ? "" : ", ") + ("the body '" + bodies[body.body].name + "' ")
              + body.in_words();
      turns |= body.turns;
      if (!equilibrium->free_motions().has_neighbours(body.body))
        alone += (alone.empty() ? "" : ", ") + bodies[body.body].name;
    }
  for (const ContactPair &pair : contact->pairs())
    for (const auto &body : moves)
      has_friction |= (pair.a == body.body || pair.b == body.body)
                      && pair.law.law != ContactLaw::stick && pair.law.law != ContactLaw::tied;
  std::string remedy = turns ? "hold it against turning, lower its loads or let them act nearer to "
                               "what holds it"
                             : "support it or lower its loads";
  if (has_friction)
    remedy += ", or raise the friction coefficient";
  if (!alone.empty())
    remedy = "no other body is within reach of " + alone
             + ": support it, place it nearer to what shall hold it, or raise Contact/Shift";
  throw UserError(
    bodies[moves.front().body].path,
    "no equilibrium exists at time " + short_number(record.time)
      + (turns ? ": the body tips over, turns or slides away" : ": the body slides away")
      + ", for no contact pressure and no friction within its "
        "limit balances the loads; driven by them "
      + what
      + (std::isnan(held_until)
           ? ""
           : "; they could be balanced up to time " + short_number(held_until)),
    remedy);
}

template <int dim>
void
Simulation<dim>::tell_what_is_loose()
{
  if (told_as_loose.size() == equilibrium->free_bodies().size())
    return;
  std::vector<std::string> names;
  for (const unsigned int body : equilibrium->free_motions().not_held())
    if (told_as_loose.insert(body).second)
      names.push_back(bodies[body].name);
  if (!names.empty())
    log.line("Note: at time " + short_number(record.time)
             + " neither supports nor closed contact resist some rigid motion of " + listed(names)
             + "; no load drives it, and where it ends there is arbitrary");
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
  const auto                summaries = summarise_contact(*contact, communicator);
  std::vector<unsigned int> flips(n_flips.size());
  dealii::Utilities::MPI::sum(n_flips, communicator, flips);
  for (unsigned int p = 0; p < summaries.size(); ++p)
    if (summaries.size() <= Results<dim>::most_pairs_in_history || flips[p] > 0)
      log.line("  " + contact->pairs()[p].name + ": open/stick/slip "
               + short_number(summaries[p].open) + "/" + short_number(summaries[p].stick) + "/"
               + short_number(summaries[p].slip) + ", smallest gap "
               + short_number(summaries[p].minimum_gap) + " at " + short_place(summaries[p].where)
               + ", points that changed their state in the last iteration: "
               + std::to_string(flips[p]));
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template void Simulation<dim>::report_set_up();                                                 \
  template void Simulation<dim>::check();                                                         \
  template void Simulation<dim>::plot() const;                                                    \
  template void Simulation<dim>::report_step(const double);                                       \
  template void Simulation<dim>::report_under_resolved();                                         \
  template void Simulation<dim>::report_end();                                                    \
  template void Simulation<dim>::throw_slides_away(const typename FreeBodies<dim>::Coordinates &, \
                                                   const double);                                 \
  template void Simulation<dim>::tell_what_is_loose();                                            \
  template void Simulation<dim>::count_flips();                                                   \
  template void Simulation<dim>::explain_failure(const NewtonResult &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
