#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/output/run_report.h>
#include <scree/solver/blas.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace scree
{
namespace
{
/** Of each process: with fewer, messages cost about what is gained (the rule of thumb of PETSc). */
constexpr unsigned int fewest_unknowns_that_pay = 10000;

std::string
resident_memory()
{
  dealii::Utilities::System::MemoryStats stats;
  dealii::Utilities::System::get_memory_stats(stats);
  return short_number(stats.VmRSS / 1024.) + " MB";
}

/** Numbers of points, as they are printed. */
struct PointNumbers
{
  double open = 0., stick = 0., slip = 0.;

  std::string in_words() const
  {
    return "open/stick/slip " + short_number(open) + "/" + short_number(stick) + "/"
           + short_number(slip);
  }
};
} // namespace

template <int dim>
void
RunReport<dim>::set_up(const DiscreteProblem<dim> &problem, const bool pairs_change)
{
  Log &log = run_log.log;
  if (const std::string kernels = outdated_blas_kernels(); !kernels.empty())
    log.line("OpenBLAS does not know this processor and takes the kernels of " + kernels
             + ": with OPENBLAS_CORETYPE=Haswell in the environment linear solvers are faster");
  log.line("Grid: " + std::to_string(problem.grid.triangulation().n_global_active_cells())
           + " cells, finest edge " + short_number(problem.grid.finest_size()));
  const unsigned int degree        = problem.space.basis.degree,
                     of_level_sets = problem.level_set_nodes.basis().degree;
  log.line(
    "Unknowns: " + std::to_string(problem.space.n_dofs()) + " of degree " + std::to_string(degree)
    + " in " + std::to_string(problem.space.n_fields()) + " field(s)"
    + (of_level_sets == degree ? "" : ", level sets of degree " + std::to_string(of_level_sets)));
  const auto n_processes = dealii::Utilities::MPI::n_mpi_processes(problem.communicator());
  if (const auto each = problem.space.n_dofs() / n_processes;
      n_processes > 1 && each < fewest_unknowns_that_pay)
    log.line("Processes: " + std::to_string(n_processes) + " with " + std::to_string(each)
             + " unknowns each; below " + std::to_string(fewest_unknowns_that_pay)
             + " fewer processes are often as fast");
  const auto &bodies  = problem.bodies;
  const auto  volumes = problem.bulk.volumes();
  if (bodies.size() > most_told)
    log.line("Bodies: " + std::to_string(bodies.size()) + ", volume "
             + short_number(std::accumulate(volumes.begin(), volumes.end(), 0.)));
  for (unsigned int b = 0; b < bodies.size(); ++b)
    body(problem, b, volumes[b]);
  const auto n_points
    = dealii::Utilities::MPI::sum(problem.contact().points().size(), problem.communicator());
  contacts(problem, pairs_change || problem.pairs.size() > Results<dim>::most_pairs_in_history);
  log.line("Contact points: " + std::to_string(n_points));
  free_bodies(problem);
}

template <int dim>
void
RunReport<dim>::body(const DiscreteProblem<dim> &problem, const unsigned int b, const double volume)
{
  Log             &log  = run_log.log;
  const Body<dim> &body = problem.bodies[b];
  if (body.is_rigid())
    {
      log.line("Body " + body.name + ": rigid, "
               + (body.rigid->is_free() ? "driven by forces" : "its motion prescribed"));
      return;
    }
  if (problem.bodies.size() <= most_told)
    log.line("Body " + body.name + ": volume " + short_number(volume));
  const double h = problem.grid.finest_size();
  require(volume > 0., body.path, "the body '" + body.name + "' has no volume on the grid",
          "raise Grid/Finest level or check the shape: the body must be wider than a few "
          "cells of edge "
            + short_number(h));
  const double thickness = 2. * inscribed_radius(*body.shape, body.level_set);
  require(thickness > (1. - 1e-6) * h, body.path,
          "the body '" + body.name + "' is " + short_number(thickness)
            + " thick, less than a cell of edge " + short_number(h),
          "raise Grid/Finest level");
  double smallest = std::numeric_limits<double>::max();
  for (unsigned int d = 0; d < dim; ++d)
    smallest = std::min(smallest, body.box.side_length(d));
  if (smallest < 4. * h)
    log.line("Warning: body " + body.name + " is only " + short_number(smallest / h)
             + " finest cells wide");
}

template <int dim>
void
RunReport<dim>::contacts(const DiscreteProblem<dim> &problem, const bool has_many)
{
  Log                      &log       = run_log.log;
  const ContactPoints<dim> &contact   = problem.contact();
  const auto                summaries = summarise_contact(contact, problem.communicator());
  unsigned int              n_near = 0, n_overlaps = 0;
  double                    largest = 0.;
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    {
      const auto &pair     = contact.pairs()[p];
      const bool  is_near  = !std::isnan(summaries[p].minimum_gap);
      const bool  overlaps = summaries[p].minimum_gap < -1e-6 * problem.grid.finest_size();
      n_near += is_near;
      n_overlaps += overlaps;
      largest = std::max(largest, summaries[p].max_penetration);
      if (has_many)
        continue;
      log.line("Contact " + pair.name + ": " + pair.law.kind->name + " ('" + pair.law.name + "')"
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

template <int dim>
void
RunReport<dim>::free_bodies(const DiscreteProblem<dim> &problem)
{
  const auto &free_bodies = problem.equilibrium().free_bodies();
  if (free_bodies.size() > most_told)
    run_log.log.line("Bodies with rigid motions that only contact can hold: "
                     + std::to_string(free_bodies.size()));
  else
    for (const auto &free : free_bodies)
      run_log.log.line("Body " + problem.bodies[free.body].name + " has "
                       + std::to_string(free.n_free)
                       + " rigid motion(s) that only contact can hold");
}

template <int dim>
void
RunReport<dim>::step(const StepRecord &record, const ContactPoints<dim> &contact,
                     const MPI_Comm communicator, const double done, const double seconds_left)
{
  PointNumbers numbers;
  for (const auto &summary : summarise_contact(contact, communicator))
    {
      numbers.open += summary.open;
      numbers.stick += summary.stick;
      numbers.slip += summary.slip;
      so_far.has_touched |= summary.is_closed();
    }
  run_log.log.line(
    "Step " + std::to_string(record.step) + ", time " + short_number(record.time) + ": "
    + std::to_string(record.newton_iterations) + " iterations, residual "
    + short_number(record.residual) + ", "
    + (record.local_error > 0. ? "local error " + short_number(record.local_error) + ", " : "")
    + numbers.in_words() + ", " + short_duration(run_log.timings.total()) + ", left "
    + short_duration(seconds_left) + ", " + resident_memory());
  run_log.log.progress(done, "left " + short_duration(seconds_left));
}

template <int dim>
void
RunReport<dim>::under_resolved(const DiscreteProblem<dim> &problem)
{
  std::vector<std::string> names;
  for (const unsigned int p : under_resolved_pairs(problem.contact(), problem.communicator()))
    if (run_log.warnings.is_new(Warning::under_resolved, problem.pairs[p].a, problem.pairs[p].b))
      names.push_back(problem.pairs[p].name);
  if (!names.empty())
    run_log.log.line("Warning: under-resolved contact, closed at less than "
                     + std::to_string(dim == 2 ? 3 : 9) + " points: " + listed(names)
                     + ". What loads press has the right force; gap, pressure and stiffness, and "
                       "the force of what is moved, come from the grid; refine there "
                       "(Grid/Refinement = contact, Finest level)");
}

template <int dim>
void
RunReport<dim>::loose(const DiscreteProblem<dim> &problem, const double time)
{
  const Equilibrium<dim> &equilibrium = problem.equilibrium();
  if (run_log.warnings.count(Warning::loose) == equilibrium.free_bodies().size())
    return;
  std::vector<std::string> names;
  for (const unsigned int body : equilibrium.free_motions().not_held())
    if (run_log.warnings.is_new(Warning::loose, body))
      names.push_back(problem.bodies[body].name);
  if (!names.empty())
    run_log.log.line("Note: at time " + short_number(time)
                     + " neither supports nor closed contact resist some rigid motion of "
                     + listed(names) + "; no load drives it, and where it ends there is arbitrary");
}

template <int dim>
void
RunReport<dim>::meetings(const DiscreteProblem<dim> &problem, const ContactParameters &parameters,
                         const typename Equilibrium<dim>::Vector &u)
{
  for (const auto &[a, b] : pairs_that_may_have_met(
         problem.bodies, problem.contact(), parameters, problem.contact_reach(),
         problem.equilibrium().largest_displacements(u), problem.communicator()))
    if (run_log.warnings.is_new(Warning::may_have_met, a, b))
      run_log.log.line("Warning: " + problem.bodies[a].name + " and " + problem.bodies[b].name
                       + " may have met, but were too far apart at the start for contact between "
                         "them; raise Contact/Shift if they should touch");
}

template <int dim>
void
RunReport<dim>::failure(const StepRecord &record, const NewtonResult &result,
                        const ContactPoints<dim> &contact, const StatusChanges &changes,
                        const MPI_Comm communicator)
{
  Log &log = run_log.log;
  log.line("Step " + std::to_string(record.step) + " to time " + short_number(record.time)
           + " failed: " + result.message);
  std::string history = "  residuals:";
  for (const double residual : result.residuals)
    history += " " + short_number(residual);
  log.line(history);
  const auto                summaries = summarise_contact(contact, communicator);
  std::vector<unsigned int> of_pairs(changes.of_pairs().size());
  dealii::Utilities::MPI::sum(changes.of_pairs(), communicator, of_pairs);
  for (unsigned int p = 0; p < summaries.size(); ++p)
    if (summaries.size() <= Results<dim>::most_pairs_in_history || of_pairs[p] > 0)
      log.line("  " + contact.pairs()[p].name + ": "
               + PointNumbers{double(summaries[p].open), double(summaries[p].stick),
                              double(summaries[p].slip)}
                   .in_words()
               + ", smallest gap " + short_number(summaries[p].minimum_gap) + " at "
               + short_place(summaries[p].where)
               + ", points that changed their state in the last iteration: "
               + std::to_string(of_pairs[p]));
}

template <int dim>
void
RunReport<dim>::nothing_touched(const DiscreteProblem<dim> &problem)
{
  const ContactPoints<dim> &contact = problem.contact();
  double                    gap     = std::numeric_limits<double>::infinity();
  std::string               nearest;
  const auto                summaries = summarise_contact(contact, problem.communicator());
  for (unsigned int p = 0; p < summaries.size(); ++p)
    if (summaries[p].minimum_gap < gap)
      {
        gap     = summaries[p].minimum_gap;
        nearest = contact.pairs()[p].name;
      }
  run_log.log.line(
    "Warning: no bodies touched in any step"
    + (nearest.empty()
         ? std::string(": all are farther apart than twice Contact/Shift")
         : "; the smallest gap at the end is " + short_number(gap) + ", of " + nearest));
}

template <int dim>
void
RunReport<dim>::energies(const Energies &energies, const double time)
{
  so_far.largest_work = std::max(so_far.largest_work, std::abs(energies.external_work));
  const double gain   = -energies.balance_error();
  if (so_far.has_gained || energies.kinetic == 0. || gain <= 0.5 * so_far.largest_work)
    return;
  so_far.has_gained = true;
  run_log.log.line(
    "Warning: at time " + short_number(time) + " there is " + short_number(gain)
    + " more energy than came in (" + short_number(energies.external_work)
    + "): the scheme does not follow what is much faster than a step; take shorter steps, or "
      "Time/Scheme = backward Euler, which damps it");
}

template <int dim>
void
RunReport<dim>::end(const DiscreteProblem<dim> &problem, const unsigned int n_rejected,
                    const unsigned int n_checkpoints, const std::size_t checkpoint_bytes,
                    const std::string &directory)
{
  Log &log = run_log.log;
  if (problem.bodies.size() > 1 && !so_far.has_touched)
    nothing_touched(problem);
  log.line("Wall time by part:");
  for (const auto &[name, seconds] : run_log.timings.parts())
    log.line("  " + name + ": " + short_number(seconds) + " s");
  if (n_checkpoints > 0)
    log.line("Checkpoints: " + std::to_string(n_checkpoints) + ", the last of "
             + short_number(1e-6 * checkpoint_bytes) + " MB");
  log.line("Finished in " + short_duration(run_log.timings.total()) + " with "
           + std::to_string(n_rejected) + " rejected step(s). Results: " + directory);
}

template class RunReport<2>;
template class RunReport<3>;
} // namespace scree
