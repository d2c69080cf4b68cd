#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>
#include <scree/mechanics/linear_prediction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
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
    bodies = make_bodies<dim>(parameters.bodies, materials, lattice_frame(), lattice_margin());
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
  pairs = find_pairs();
  require_distinct(bodies, pairs);
  discretise();
  was_closed.assign(contact->points().size(), false);
  results = std::make_unique<Results<dim>>(directory, bodies, parameters.output.probes);
  results->set_discretization(*fields, *level_set_nodes);
  state.time         = 0.;
  state.displacement = zero_displacement(*fields);
  state.contact      = contact->initial_history();
  if (is_moving())
    start_step();
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
    if (is_moving() && step_control.n_accepted() > 0
        && parameters.grid.refinement == GridRefinement::contact)
      grid = std::make_unique<BackgroundGrid<dim>>(parameters.grid, communicator);
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
                                                          bodies, step_start.get());
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
    const Timings::Scope scope(timings, "contact search");
    contact = std::make_unique<ContactPoints<dim>>(
      *fields, *level_set_nodes, bodies, pairs, parameters.contact.shift * grid->finest_size(),
      prediction(), step_start ? &step_start->displacement() : nullptr);
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
  // On a moving geometry any two bodies may meet in the course of the run.
  const double reach = is_moving() ? grid->box().side_length(0) + grid->box().side_length(1)
                                       + grid->box().side_length(dim - 1)
                                   : 2. * parameters.contact.shift * grid->finest_size();
  std::vector<ContactPair> pairs;
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
        report_under_resolved();
        if (is_moving())
          move_geometry();
        results->write_history();
        save_if_due();
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
        if (is_moving())
          {
            // Contact points expect the slip of the step.
            set_up_equilibrium();
            start_step();
          }
      }
  report_end(wall.wall_time());
}

template <int dim>
typename Equilibrium<dim>::Vector
Simulation<dim>::extrapolated(const double time) const
{
  if (is_moving())
    return predicted(time);
  auto result = state.displacement;
  result.add(time - state.time, last_increment);
  return result;
}

template <int dim>
typename Equilibrium<dim>::Vector
Simulation<dim>::first_guess(const double time)
{
  using Vector     = typename Equilibrium<dim>::Vector;
  Vector unchanged = state.displacement;
  equilibrium->set_time(time, unchanged);
  std::vector<Vector> guesses = {unchanged};
  if (is_moving() ? predictor.step_size > 0. : last_increment.size() != 0)
    {
      guesses.push_back(extrapolated(time));
      equilibrium->set_prescribed(guesses.back());
    }
  if (std::any_of(bodies.begin(), bodies.end(),
                  [](const Body<dim> &body) { return body.is_rigid(); }))
    try
      {
        guesses.push_back(linear_prediction<dim>(*equilibrium, state.contact, state.displacement,
                                                 unchanged, [&](const Vector &b, Vector &x) {
                                                   solve_linear_system(
                                                     b, parameters.linear_solver.tolerance, x);
                                                 }));
      }
    catch (const LinearSolverFailure &)
      {
        // The iteration starts without it.
      }
  unsigned int best     = 0;
  double       smallest = std::numeric_limits<double>::max();
  for (unsigned int i = 0; guesses.size() > 1 && i < guesses.size(); ++i)
    {
      Vector r(unchanged);
      equilibrium->residual(guesses[i], state.contact, r);
      if (r.l2_norm() < smallest)
        {
          best     = i;
          smallest = r.l2_norm();
        }
    }
  return guesses[best];
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
  if (is_moving())
    {
      const Timings::Scope scope(timings, "material points");
      points_at_end            = moved_points(u);
      const std::string reason = why_too_large();
      if (!reason.empty())
        {
          log.line("Step " + std::to_string(step) + " to time " + short_number(time)
                   + " is too large: " + reason);
          return false;
        }
    }
  equilibrium->accept(u, state.contact);
  require_contact_within_reach(*contact, parameters.contact.shift * grid->finest_size(),
                               communicator);
  if (is_moving())
    {
      predictor.step_size = time - state.time;
      state.displacement  = u;
      state.contact       = contact->current_history();
      state.time          = time;
      return true;
    }
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
  for (unsigned int i = 0; i < was_closed.size(); ++i)
    if (contact->responses()[i].pressure != 0.)
      was_closed[i] = true;
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
LinearSolveResult
Simulation<dim>::solve_linear_system(const LinearSolver::Vector &r, const double tolerance,
                                     LinearSolver::Vector &du)
{
  const auto n_contact_points = dealii::Utilities::MPI::sum(contact->points().size(), communicator);
  if (equilibrium->is_linear_but_for_contact()
      && linear_solver->condenses(fields->n_dofs(), dim * n_contact_points)
      && !equilibrium->has_free_rigid_bodies())
    try
      {
        const Timings::Scope scope(timings, "linear solver");
        if (!condensed_solver)
          {
            const auto system = equilibrium->condensation(false);
            condensed_solver
              = std::make_unique<CondensedSolver>(system.glued, system.jumps, system.symmetric);
          }
        else if (condensed_solver->is_worth_updating())
          condensed_solver->update(equilibrium->condensation(true).glued);
        return condensed_solver->solve(equilibrium->tangent_changes(), dim, du, r);
      }
    catch (const LinearSolverFailure &)
      {
        // The full system tells what is wrong, if anything is.
      }
  const auto *matrix = [&]() {
    const Timings::Scope scope(timings, "tangent");
    return &equilibrium->tangent();
  }();
  const Timings::Scope scope(timings, "linear solver");
  return linear_solver->solve(*matrix, du, r, equilibrium->is_symmetric(), tolerance);
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
  hooks.solve = [&](const Vector &, const Vector &r, const double tolerance, Vector &du) {
    const auto solved = solve_linear_system(r, tolerance, du);
    record.linear_iterations += solved.iterations;
    equilibrium->shorten(du, grid->finest_size());
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
Simulation<dim>::write_results()
{
  const Timings::Scope scope(timings, "output");
  const auto           ghosted = equilibrium->with_ghosts(state.displacement);
  const auto          &output  = parameters.output;
  const bool           is_last = step_control.finished();
  const auto           is_due
    = [&](const unsigned int every) { return every > 0 && (record.step % every == 0 || is_last); };
  results->gather_history(record, *equilibrium, *contact, *bulk, state.displacement);
  results->write_probes(record, *bulk, ghosted);
  bool is_written = true;
  if (is_due(output.fields_every))
    is_written &= results->write_fields(record, *bulk, ghosted);
  if (is_due(output.contact_every))
    is_written &= results->write_contact(record, *contact);
  if (!is_written)
    log.line("Warning: pictures of this step cannot be written (is the disk full?)");
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace scree
