#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/output/region_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_out.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace scree
{
namespace
{
/** Lattice nodes coincide with the support points of degree k on the finest cells. */
template <int dim>
LatticeFrame<dim>
lattice_frame(const BackgroundGrid<dim> &grid, const unsigned int degree)
{
  return {grid.grid_parameters().lower, grid.finest_size() / degree, grid.box()};
}

/** Wide enough for the reach of contact and for coarse cells that straddle the surface. */
template <int dim>
double
lattice_margin(const Parameters<dim> &parameters, const BackgroundGrid<dim> &grid)
{
  const auto  &p        = parameters.grid;
  const double coarsest = p.refinement == GridRefinement::uniform ? p.cell_size(p.finest_level)
                                                                  : p.cell_size(p.coarsest_level);
  return std::max((parameters.contact.shift + 2.) * grid.finest_size(), 2. * coarsest);
}

template <int dim>
std::string
position(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "(" : ", ") + short_number(point[d]);
  return text + ")";
}

std::string
resident_memory()
{
  dealii::Utilities::System::MemoryStats stats;
  dealii::Utilities::System::get_memory_stats(stats);
  return short_number(stats.VmRSS / 1024.) + " MB";
}
} // namespace

template <int dim>
Simulation<dim>::Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
                            const MPI_Comm communicator)
    : parameters(parameters)
    , communicator(communicator)
    , log(communicator, output_directory + "/log.txt")
    , directory(output_directory)
    , grid(parameters.grid, communicator)
    , step_control(parameters.time)
{
  set_up();
  report_set_up();
}

template <int dim>
void
Simulation<dim>::set_up()
{
  std::map<std::string, std::shared_ptr<const Material<dim>>> materials;
  for (const auto &[name, material] : parameters.materials)
    materials[name] = make_material<dim>(material);

  {
    const Timings::Scope scope(timings, "geometry");
    bodies = make_bodies<dim>(parameters.bodies, materials, lattice_frame(grid, parameters.degree),
                              lattice_margin(parameters, grid));
  }

  const auto pairs = find_pairs();
  {
    const Timings::Scope                               scope(timings, "grid");
    std::vector<std::pair<unsigned int, unsigned int>> indices;
    for (const ContactPair &pair : pairs)
      indices.emplace_back(pair.a, pair.b);
    grid.refine(bodies, indices);
  }

  {
    const Timings::Scope scope(timings, "fields");
    level_set_nodes = std::make_unique<LevelSetNodes<dim>>(grid, parameters.degree);
    fields          = std::make_unique<Fields<dim>>(grid, *level_set_nodes, bodies,
                                           BoundaryTerms<dim>::n_multipliers(bodies));
  }

  {
    const Timings::Scope scope(timings, "quadrature");
    quadrature = std::make_unique<CutQuadrature<dim>>(*fields, *level_set_nodes, bodies);
    bulk = std::make_unique<Bulk<dim>>(*fields, *quadrature, bodies, parameters.ghost_penalty);
    boundary_terms
      = std::make_unique<BoundaryTerms<dim>>(*fields, *level_set_nodes, *quadrature, bodies);
  }

  {
    const Timings::Scope scope(timings, "contact search");
    contact = std::make_unique<ContactPoints<dim>>(*fields, *level_set_nodes, bodies, pairs,
                                                   parameters.contact.shift * grid.finest_size());
  }

  {
    const Timings::Scope scope(timings, "linear assembly");
    equilibrium
      = std::make_unique<Equilibrium<dim>>(*fields, bodies, *bulk, *boundary_terms, *contact);
  }

  linear_solver = std::make_unique<LinearSolver>(parameters.linear_solver, dim, parameters.degree);
  linear_solver->set_near_null_space(equilibrium->rigid_motions());
  linear_solver->set_border(fields->n_trailing());
  results = std::make_unique<Results<dim>>(directory, *fields, *level_set_nodes, bodies,
                                           parameters.output.probes);
  state   = initial_state(*fields, *contact);
  // Probes outside their bodies are told before anything is computed.
  for (const auto &probe : parameters.output.probes)
    results->sample_probe(probe, *bulk, equilibrium->with_ghosts(state.displacement));
}

template <int dim>
std::vector<ContactPair>
Simulation<dim>::find_pairs() const
{
  std::vector<ContactPair> pairs;
  const double             reach = 2. * parameters.contact.shift * grid.finest_size();
  for (const auto &[a, b] : candidate_pairs(bodies, reach))
    {
      const auto law = parameters.contact.law_of(bodies[a].name, bodies[b].name);
      const auto is_driven
        = [](const Body<dim> &body) { return body.is_rigid() && !body.rigid->is_free(); };
      if (law.law != ContactLaw::none && !(is_driven(bodies[a]) && is_driven(bodies[b])))
        pairs.push_back({a, b, bodies[a].name + "-" + bodies[b].name, law});
    }
  return pairs;
}

template <int dim>
void
Simulation<dim>::report_set_up()
{
  if (!parameters.title.empty())
    log.line(parameters.title);
  log.line("Grid: " + std::to_string(grid.triangulation().n_global_active_cells())
           + " cells, finest edge " + short_number(grid.finest_size()));
  log.line("Unknowns: " + std::to_string(fields->n_dofs()) + " of degree "
           + std::to_string(parameters.degree) + " in " + std::to_string(fields->n_fields())
           + " field(s)");
  const auto volumes = bulk->volumes();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (bodies[b].is_rigid())
        {
          log.line("Body " + bodies[b].name + ": rigid"
                   + (bodies[b].rigid->is_free() ? ", driven by forces" : ", motion prescribed"));
          continue;
        }
      log.line("Body " + bodies[b].name + ": volume " + short_number(volumes[b]));
      require(volumes[b] > 0., bodies[b].path,
              "the body '" + bodies[b].name + "' has no volume on the grid",
              "raise Grid/Finest level or check the shape: the body must be wider than a few "
              "cells of edge "
                + short_number(grid.finest_size()));
      double smallest = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        smallest = std::min(smallest, bodies[b].box.side_length(d));
      if (smallest < 4. * grid.finest_size())
        log.line("Warning: body " + bodies[b].name + " is only "
                 + short_number(smallest / grid.finest_size()) + " finest cells wide");
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
      if (summaries[p].minimum_gap < -1e-6 * grid.finest_size())
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
  dealii::GridOut().write_mesh_per_processor_as_vtu(grid.triangulation(), directory + "/grid");
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
Simulation<dim>::run()
{
  dealii::Timer wall;
  unsigned int  attempts = 1;
  while (!step_control.finished())
    if (solve_step(step_control.next_time()))
      {
        record.attempts = attempts;
        attempts        = 1;
        step_control.accept(record.newton_iterations);
        write_results();
        report_step(wall.wall_time());
      }
    else
      {
        ++attempts;
        // A body that slides away does so in every attempt; two are enough to tell.
        if (attempts > 2)
          for (const auto &free : equilibrium->free_bodies())
            if (slides_away(free.body))
              throw_slides_away(free.body);
        require(step_control.reject(), "Time",
                "the load step to time " + short_number(record.time)
                  + " was not solved, not even with the smallest step",
                "see the reasons above; use more steps, a smaller tangential penalty factor, or "
                "support the bodies that are not held");
        log.line("  the step is tried again with "
                 + short_number(100. * step_control.step_fraction()) + "% of its length");
      }
  log.line("Wall time by part:");
  for (const auto &[name, seconds] : timings.parts())
    log.line("  " + name + ": " + short_number(seconds) + " s");
  log.line("Finished in " + short_duration(wall.wall_time()) + " with "
           + std::to_string(step_control.n_rejected())
           + " rejected step(s). Results: " + directory);
}

template <int dim>
void
Simulation<dim>::report_step(const double wall_time)
{
  const double done = step_control.time() / parameters.time.end_time;
  const double left = wall_time * (1. - done) / done;
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
typename Equilibrium<dim>::Vector
Simulation<dim>::first_guess(const double time)
{
  using Vector     = typename Equilibrium<dim>::Vector;
  Vector unchanged = state.displacement;
  equilibrium->set_time(time, unchanged);
  if (last_increment.size() == 0)
    return unchanged;
  const auto residual_of = [&](const Vector &u) {
    Vector r(u);
    equilibrium->residual(u, state.contact, r);
    return r.l2_norm();
  };
  Vector extrapolated = state.displacement;
  extrapolated.add(time - state.time, last_increment);
  equilibrium->set_prescribed(extrapolated);
  return residual_of(extrapolated) < residual_of(unchanged) ? extrapolated : unchanged;
}

template <int dim>
bool
Simulation<dim>::solve_step(const double time)
{
  const unsigned int step   = step_control.n_accepted() + 1;
  record                    = StepRecord();
  record.step               = step;
  record.time               = time;
  auto               u      = first_guess(time);
  const NewtonResult result = solve_equilibrium(u);
  record.newton_iterations  = result.iterations;
  record.residual           = result.residuals.empty() ? 0. : result.residuals.back();
  if (!result.converged())
    {
      explain_failure(result);
      return false;
    }
  for (const auto &free : equilibrium->free_bodies())
    if (lost_contact(free.body))
      throw_slides_away(free.body);
  equilibrium->accept(u, state.contact);
  require_contact_within_reach(*contact, parameters.contact.shift * grid.finest_size(),
                               communicator);
  for (const auto &pair : pairs_that_may_have_met(bodies, contact->pairs(), parameters.contact,
                                                  equilibrium->largest_displacements(u)))
    if (warned_pairs.insert(pair).second)
      log.line("Warning: " + bodies[pair.first].name + " and " + bodies[pair.second].name
               + " may have met, but were too far apart at the start for contact between them; "
                 "raise Contact/Shift if they should touch");
  last_increment = u;
  last_increment -= state.displacement;
  last_increment *= 1. / (time - state.time);
  state.displacement = u;
  state.contact      = contact->current_history();
  state.time         = time;
  return true;
}

template <int dim>
std::vector<double>
Simulation<dim>::contact_force_on_bodies() const
{
  std::vector<double> forces(bodies.size(), 0.);
  const auto          summaries = summarise_contact(*contact, communicator);
  for (unsigned int p = 0; p < contact->pairs().size(); ++p)
    for (const unsigned int body : {contact->pairs()[p].a, contact->pairs()[p].b})
      forces[body] += summaries[p].force.norm();
  return forces;
}

template <int dim>
bool
Simulation<dim>::lost_contact(const unsigned int body) const
{
  return contact_force_on_bodies()[body] < 1e-3 * largest_contact_force[body];
}

template <int dim>
bool
Simulation<dim>::slides_away(const unsigned int body) const
{
  const auto not_held = equilibrium->bodies_not_held();
  return lost_contact(body) || std::find(not_held.begin(), not_held.end(), body) != not_held.end();
}

template <int dim>
NewtonResult
Simulation<dim>::solve_equilibrium(typename Equilibrium<dim>::Vector &u)
{
  using Vector = typename Equilibrium<dim>::Vector;
  Newton::Hooks hooks;
  hooks.residual = [&](const Vector &u, Vector &r) {
    const Timings::Scope scope(timings, "residual");
    equilibrium->residual(u, state.contact, r);
  };
  hooks.solve = [&](const Vector &, const Vector &r, Vector &du) {
    const auto *matrix = [&]() {
      const Timings::Scope scope(timings, "tangent");
      return &equilibrium->tangent();
    }();
    const Timings::Scope scope(timings, "linear solver");
    const auto           solved = linear_solver->solve(*matrix, du, r, equilibrium->is_symmetric());
    record.linear_iterations += solved.iterations;
    equilibrium->shorten(du, grid.finest_size());
  };
  hooks.reference = [&]() {
    return std::max(equilibrium->force_scale(),
                    equilibrium->round_off() / parameters.newton.relative_tolerance);
  };
  largest_contact_force.assign(bodies.size(), 0.);
  hooks.observe = [&](const NewtonIteration &iteration) {
    if (!equilibrium->free_bodies().empty())
      {
        const auto forces = contact_force_on_bodies();
        for (unsigned int b = 0; b < bodies.size(); ++b)
          largest_contact_force[b] = std::max(largest_contact_force[b], forces[b]);
      }
    count_flips();
    const std::string text = "iteration " + std::to_string(iteration.number) + ", residual "
                             + short_number(iteration.residual) + " of "
                             + short_number(iteration.tolerance);
    if (parameters.output.log_iterations)
      log.line("  " + text + ", step length " + short_number(iteration.step_length));
    log.progress(step_control.time() / parameters.time.end_time,
                 "step " + std::to_string(record.step) + ", " + text);
  };
  return Newton(parameters.newton, hooks).solve(u);
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
             + short_number(summaries[p].minimum_gap) + " at " + position(summaries[p].where)
             + ", points that changed their state in the last iteration: "
             + std::to_string(dealii::Utilities::MPI::sum(n_flips[p], communicator)));
}

template <int dim>
void
Simulation<dim>::write_results()
{
  const Timings::Scope scope(timings, "output");
  const auto           ghosted = equilibrium->with_ghosts(state.displacement);
  const auto          &output  = parameters.output;
  const bool           is_last = step_control.finished();
  const auto           is_due
    = [&](const unsigned int every) { return every > 0 && (record.step % every == 0 || is_last); };
  results->write_history(record, *equilibrium, *contact, *bulk, state.displacement);
  results->write_probes(record, *bulk, ghosted);
  if (is_due(output.fields_every))
    results->write_fields(record, *bulk, ghosted);
  if (is_due(output.contact_every))
    results->write_contact(record, *contact);
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace scree
