#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/base/interruption.h>
#include <scree/bodies/broad_phase.h>
#include <scree/contact/contact_reach.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace scree
{
namespace
{
/** The law between two bodies; none if they pass through each other or none of them can respond. */
template <int dim>
std::optional<ContactPairParameters>
law_between(const Body<dim> &a, const Body<dim> &b, const ContactParameters &contact)
{
  const auto is_driven
    = [](const Body<dim> &body) { return body.is_rigid() && !body.rigid->is_free(); };
  if (is_driven(a) && is_driven(b))
    return {};
  const auto law = contact.law_of(a.name, b.name);
  if (law.law == ContactLaw::none)
    return {};
  return law;
}

/** Whether more pairs of bodies may touch than history.csv has columns for. */
template <int dim>
bool
has_many_pairs(const std::vector<Body<dim>> &bodies, const ContactParameters &contact)
{
  unsigned int n_pairs = 0;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (unsigned int a = 0; a < b && n_pairs <= Results<dim>::most_pairs_in_history; ++a)
      n_pairs += law_between(bodies[a], bodies[b], contact).has_value();
  return n_pairs > Results<dim>::most_pairs_in_history;
}
} // namespace

template <int dim>
Simulation<dim>::Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
                            const MPI_Comm communicator, const Checkpoint<dim> *checkpoint)
    : parameters(parameters)
    , communicator(communicator)
    , log(communicator, output_directory + "/log.txt", checkpoint != nullptr)
    , directory(output_directory)
    , grid(std::make_unique<BackgroundGrid<dim>>(parameters.grid, communicator))
    , step_control(parameters.time)
{
  set_up();
  report_set_up();
  if (checkpoint)
    resume(*checkpoint);
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
    bodies = make_bodies<dim>(parameters.bodies, materials, lattice_frame(), lattice_margin(),
                              is_moving());
  }
  for (unsigned int b = 0; b < bodies.size() && is_moving(); ++b)
    {
      bodies[b].initial_level_set = std::make_shared<const Lattice<dim>>(bodies[b].level_set);
      if (!bodies[b].is_rigid())
        bodies[b].law
          = make_increment_law<dim>(parameters.materials.at(parameters.bodies[b].material));
    }

  if (is_moving())
    require_movable(bodies);
  pairs_change = is_moving() && has_many_pairs(bodies, parameters.contact);
  pairs        = find_pairs();
  require_distinct(bodies, pairs);
  discretise();
  was_closed.assign(contact->points().size(), false);
  results
    = std::make_unique<Results<dim>>(directory, bodies, parameters.output.probes, pairs_change);
  results->set_discretization(*fields, *level_set_nodes);
  state.time         = 0.;
  state.displacement = zero_displacement(*fields);
  state.contact      = contact->initial_history();
  if (is_moving())
    start_step();
  results->require_distinct_columns(*equilibrium, *contact);
  // Probes outside their bodies are told before anything is computed.
  results->require_probes(*bulk, equilibrium->with_ghosts(state.displacement));
}

template <int dim>
void
Simulation<dim>::discretise()
{
  {
    const Timings::Scope scope(timings, "grid");
    // What refers to the grid ends before it.
    condensed_solver.reset();
    equilibrium.reset();
    contact.reset();
    boundary_terms.reset();
    bulk.reset();
    step_start.reset();
    quadrature.reset();
    fields.reset();
    level_set_nodes.reset();
    if (is_moving() && has_started() && parameters.grid.refinement == GridRefinement::contact)
      grid = std::make_unique<BackgroundGrid<dim>>(parameters.grid, communicator);
    if (pairs_change && has_started())
      pairs = find_pairs();
    std::vector<std::pair<unsigned int, unsigned int>> indices;
    for (const ContactPair &pair : pairs)
      indices.emplace_back(pair.a, pair.b);
    grid->refine(bodies, indices);
  }
  {
    const Timings::Scope scope(timings, "fields");
    level_set_nodes = std::make_unique<LevelSetNodes<dim>>(*grid, parameters.degree);
    fields          = std::make_unique<Fields<dim>>(*grid, *level_set_nodes, bodies,
                                           BoundaryTerms<dim>::n_multipliers(bodies));
  }
  {
    const Timings::Scope scope(timings, "quadrature");
    quadrature = std::make_unique<CutQuadrature<dim>>(*fields, *level_set_nodes, bodies);
  }
  if (is_moving())
    set_up_points();
  {
    const Timings::Scope scope(timings,
                               is_moving() ? "history at quadrature points" : "quadrature");
    bulk = std::make_unique<Bulk<dim>>(*fields, *quadrature, bodies, parameters.ghost_penalty,
                                       step_start.get());
    boundary_terms = std::make_unique<BoundaryTerms<dim>>(*fields, *level_set_nodes, *quadrature,
                                                          bodies, *bulk, state.time);
  }
  set_up_equilibrium();
}

template <int dim>
void
Simulation<dim>::set_up_equilibrium()
{
  // What refers to the contact points ends before them.
  condensed_solver.reset();
  equilibrium.reset();
  {
    const Timings::Scope       scope(timings, "contact search");
    typename Bulk<dim>::Vector ratios;
    if (step_start)
      ratios = bulk->nodal_secant_ratios();
    contact = std::make_unique<ContactPoints<dim>>(
      *fields, *level_set_nodes, bodies, pairs, parameters.contact.shift * grid->finest_size(),
      prediction(), step_start ? &step_start->displacement() : nullptr,
      step_start ? &ratios : nullptr);
  }
  {
    const Timings::Scope scope(timings, "linear assembly");
    equilibrium
      = std::make_unique<Equilibrium<dim>>(*fields, bodies, *bulk, *boundary_terms, *contact);
  }
  linear_solver = std::make_unique<LinearSolver>(parameters.linear_solver, dim, parameters.degree);
  linear_solver->set_near_null_space(equilibrium->rigid_motions());
  linear_solver->set_border(fields->n_trailing());
}

template <int dim>
LatticeFrame<dim>
Simulation<dim>::lattice_frame() const
{
  return {parameters.grid.lower, grid->finest_size() / parameters.degree, grid->box()};
}

template <int dim>
double
Simulation<dim>::lattice_margin() const
{
  const auto  &p        = parameters.grid;
  const double coarsest = p.refinement == GridRefinement::uniform ? p.cell_size(p.finest_level)
                                                                  : p.cell_size(p.coarsest_level);
  return std::max((parameters.contact.shift + 2.) * grid->finest_size(), 2. * coarsest);
}

template <int dim>
std::vector<ContactPair>
Simulation<dim>::find_pairs() const
{
  double reach = 2. * parameters.contact.shift * grid->finest_size();
  if (is_moving())
    {
      // Few pairs stay for the whole run, in the course of which any two bodies may meet.
      const dealii::BoundingBox<dim> box = grid->box();
      const double everywhere = box.side_length(0) + box.side_length(1) + box.side_length(dim - 1);
      reach = pairs_change ? std::min(everywhere, std::max(reach, grid->reach_of_refinement()))
                           : everywhere;
    }
  std::vector<ContactPair> result;
  for (const auto &[a, b] : BodyBoxes<dim>(bodies).pairs(reach))
    if (const auto law = law_between(bodies[a], bodies[b], parameters.contact))
      result.push_back({a, b, bodies[a].name + "-" + bodies[b].name, *law});
  return result;
}

template <int dim>
void
Simulation<dim>::run()
{
  const Interruption interruption(dealii::Utilities::MPI::this_mpi_process(communicator) == 0);
  if (!step_control.finished())
    require_prescribable();
  dealii::Timer wall;
  unsigned int  attempts   = 1;
  bool          has_turned = false; // to the other kind of attempt, in this step
  bool          has_slid   = step_control.n_accepted() > 0;
  resolve_overlap();
  if (step_control.n_accepted() == 0)
    settle();
  while (!step_control.finished())
    {
      if (solve_step(step_control.next_time()))
        {
          record.attempts = attempts;
          attempts        = 1;
          has_turned      = false;
          has_slid        = true;
          step_control.accept(record.newton_iterations);
          write_results();
          report_step(wall.wall_time());
          report_under_resolved();
          if (is_moving())
            move_geometry();
          results->write_history();
          save_if_due();
          end_if_interrupted();
          continue;
        }
      ++attempts;
      if (!is_too_large)
        {
          require_equilibrium_exists();
          if (!has_turned && !equilibrium->free_bodies().empty())
            {
              // The other way, after a fall, see Equilibrium::set_second_attempt().
              settle();
              is_second_attempt = !is_second_attempt;
              has_turned        = true;
              continue;
            }
          is_second_attempt = has_turned;
          if (has_turned && !std::exchange(has_slid, true) && close_without_friction())
            continue;
        }
      require(step_control.reject(), "Time",
              "the load step to time " + short_number(record.time)
                + " was not solved, not even with the smallest step",
              "see the reasons above; use more steps, a smaller tangential penalty factor, or "
              "support the bodies that are not held");
      log.line("  the step is tried again with " + short_number(100. * step_control.step_fraction())
               + "% of its length");
      if (is_moving())
        {
          // Contact points expect the slip of the step.
          set_up_equilibrium();
          start_step();
        }
    }
  report_end();
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
  results->gather_history(record, *equilibrium, *contact, *quadrature, *bulk, state.displacement);
  results->write_probes(record, *bulk, ghosted);
  bool is_written = true;
  if (is_due(output.fields_every))
    is_written &= results->write_fields(record, *bulk, ghosted);
  if (is_due(output.contact_every))
    is_written &= results->write_contact(record, *contact);
  if (!is_written)
    log.line("Warning: pictures of this step cannot be written (is the disk full?)");
}

template <int dim>
unsigned int
Simulation<dim>::n_unknowns() const
{
  return fields->n_dofs();
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace scree
