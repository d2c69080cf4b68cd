#include <scree/application/model.h>
#include <scree/base/exceptions.h>
#include <scree/bodies/rigid_placement.h>
#include <scree/contact/contact_pairs.h>
#include <scree/contact/contact_reach.h>
#include <scree/mechanics/motion_rates.h>
#include <scree/mechanics/moving_level_sets.h>
#include <scree/mechanics/step_criteria.h>
#include <scree/mechanics/step_start.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
namespace
{
/** Lets points be undeformed where they are; the equivalent plastic strain, which hardens, stays.
 */
template <int dim>
void
start_from_here(MaterialPoints<dim> &points)
{
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      points.initial_volume[i]       = points.volume(i);
      points.initial_spacing[i]      = points.spacing(i);
      points.reference_position[i]   = points.position[i];
      points.deformation_gradient[i] = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
      points.stress[i]               = 0.;
      points.out_of_plane_stress[i]  = 0.;
      if (points.n_internal() > 0)
        keep_hardening(&points.internal[i * points.n_internal()]);
    }
}
} // namespace

template <int dim>
Model<dim>::Model(const Parameters<dim> &parameters, const double step_size,
                  const MPI_Comm communicator, RunLog &run_log)
    : parameters(parameters)
    , communicator(communicator)
    , run_log(run_log)
    , scheme(make_time_scheme<dim>(parameters.time_scheme))
    , grid(std::make_unique<BackgroundGrid<dim>>(parameters.grid, communicator))
{
  current.bodies = make_bodies_and_laws();
  if (is_moving())
    require_movable(current.bodies);
  pairs_are_many = is_moving()
                   && has_more_pairs_than(Results<dim>::most_pairs_in_history, current.bodies,
                                          parameters.contact, ever_free());
  pairs = find_pairs();
  require_distinct(current.bodies, pairs);
  discretise(step_size);
  current.was_closed.assign(problem().contact().points().size(), false);
  current.displacement = zero_displacement(problem().space);
  current.contact      = problem().contact().initial_history();
  if (has_inertia())
    start_motion(step_size);
  else if (is_moving())
    start_step();
}

template <int dim>
std::vector<Body<dim>>
Model<dim>::make_bodies_and_laws()
{
  std::map<std::string, std::shared_ptr<const Material<dim>>> materials;
  for (const auto &[name, material] : parameters.materials)
    materials[name] = make_material<dim>(material);
  const Timings::Scope scope(run_log.timings, "geometry");
  auto bodies = make_bodies<dim>(parameters.bodies, materials, lattice_frame(), lattice_margin(),
                                 is_moving());
  for (unsigned int b = 0; b < bodies.size() && is_moving(); ++b)
    {
      bodies[b].initial_level_set = std::make_shared<const Lattice<dim>>(bodies[b].level_set);
      if (!bodies[b].is_rigid())
        bodies[b].law
          = make_increment_law<dim>(parameters.materials.at(parameters.bodies[b].material));
    }
  return bodies;
}

template <int dim>
LatticeFrame<dim>
Model<dim>::lattice_frame() const
{
  return {parameters.grid.lower,
          grid->finest_size() / parameters.discretization.degree_of_level_sets(), grid->box()};
}

template <int dim>
double
Model<dim>::lattice_margin() const
{
  const auto  &p        = parameters.grid;
  const double coarsest = p.refinement == GridRefinement::uniform ? p.cell_size(p.finest_level)
                                                                  : p.cell_size(p.coarsest_level);
  return std::max((parameters.contact.shift + 2.) * grid->finest_size(), 2. * coarsest);
}

template <int dim>
std::vector<ContactPair>
Model<dim>::find_pairs() const
{
  double reach = 2. * parameters.contact.shift * grid->finest_size();
  if (is_moving())
    {
      // Few pairs stay for the whole run, in the course of which any two bodies may meet.
      const dealii::BoundingBox<dim> box = grid->box();
      const double everywhere = box.side_length(0) + box.side_length(1) + box.side_length(dim - 1);
      reach = pairs_are_many ? std::min(everywhere, std::max(reach, grid->reach_of_refinement()))
                             : everywhere;
    }
  return pairs_within(reach, current.bodies, parameters.contact, ever_free());
}

template <int dim>
std::vector<bool>
Model<dim>::ever_free() const
{
  std::vector<bool> result;
  for (const Body<dim> &body : current.bodies)
    result.push_back(is_ever_free(parameters.stages, body.name));
  return result;
}

template <int dim>
void
Model<dim>::discretise(const double step_size)
{
  {
    const Timings::Scope scope(run_log.timings, "grid");
    discrete_problem.reset(); // it refers to the grid
    if (is_moving() && current.has_started && parameters.grid.refinement == GridRefinement::contact)
      grid = std::make_unique<BackgroundGrid<dim>>(parameters.grid, communicator);
    if (pairs_are_many && current.has_started)
      pairs = find_pairs();
    std::vector<std::pair<unsigned int, unsigned int>> indices;
    for (const ContactPair &pair : pairs)
      indices.emplace_back(pair.a, pair.b);
    grid->refine(current.bodies, indices);
  }
  make_problem(step_size);
}

template <int dim>
void
Model<dim>::make_problem(const double step_size)
{
  const Parameters<dim>  &p = parameters;
  const ProblemParameters of_problem{p.discretization,
                                     p.contact.shift,
                                     p.contact.grid_nodes,
                                     p.contact.enforcement,
                                     p.moving,
                                     p.linear_solver,
                                     p.time_scheme.has_inertia(),
                                     has_inertia(),
                                     p.time_scheme.lumps_mass};
  discrete_problem = std::make_unique<DiscreteProblem<dim>>(*grid, pairs, of_problem, current,
                                                            step_size, run_log.timings);
}

template <int dim>
void
Model<dim>::accept(const Vector &u, const double time, const Rates &rates)
{
  ContactPoints<dim> &contact = problem().contact();
  if (time > current.time)
    {
      current.predictor.step_size = time - current.time;
      current.predictor.rates     = rates;
      if (!is_moving())
        {
          for (unsigned int i = 0; i < current.was_closed.size(); ++i)
            if (contact.responses()[i].pressure != 0.)
              current.was_closed[i] = true;
        }
    }
  current.displacement = u;
  current.contact      = contact.current_history();
  contact.start_step(current.contact);
  current.energies    = problem().equilibrium().energies();
  current.time        = time;
  current.has_started = true;
}

template <int dim>
unsigned int
Model<dim>::move_bodies(const Vector &ghosted)
{
  const Timings::Scope scope(run_log.timings, "level sets");
  const auto           start
    = problem().equilibrium().with_ghosts(problem().kinematics->start_displacement());
  const double    margin    = lattice_margin();
  auto           &bodies    = current.bodies;
  Predictor<dim> &predictor = current.predictor;
  unsigned int    n_islands = 0;
  predictor.of_bodies.clear();
  predictor.of_rigid.resize(bodies.size());
  for (auto &motion :
       move_level_sets(bodies, problem().space, ghosted, start,
                       {margin, parameters.moving.motion, parameters.moving.slope_tolerance}))
    {
      const unsigned int b = predictor.of_bodies.size();
      if (motion.face_increment > 1e-6 * grid->finest_size()
          && run_log.warnings.is_new(Warning::leaves_box, b))
        run_log.log.line(
          "Warning: the body " + bodies[b].name + " moves by " + short_number(motion.face_increment)
          + " through a face of the background box, which does not move: its level set "
            "gains or loses volume there. Hold the motion normal to that face, or let the "
            "body end inside the box");
      predictor.of_bodies.push_back(std::move(motion.increment));
      n_islands += motion.n_islands;
    }
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      {
        const auto q = rigid_unknowns(problem().space, b, ghosted);
        for (unsigned int m = 0; m < q.size(); ++m)
          predictor.of_rigid[b][m] = q[m] - bodies[b].pose.unknowns()[m];
        place_rigid_body(bodies[b], RigidPose<dim>::unwound(*bodies[b].rigid, q), lattice_frame(),
                         margin);
      }
  return n_islands;
}

template <int dim>
MotionRecord<dim>
Model<dim>::move_geometry(MaterialPoints<dim> &&points, const double step_size)
{
  const auto ghosted = problem().equilibrium().with_ghosts(current.displacement);
  current.step_end
    = {remember(problem().contact(), communicator), {}, problem().equilibrium().driving_forces()};
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(current.bodies); ++i)
    current.step_end.multipliers.push_back(ghosted(problem().space.multiplier(i)));
  MotionRecord<dim> record;
  record.transfer_report = problem().kinematics->transfer_report();
  if (has_inertia())
    keep_rates_of_rigid();
  record.n_islands  = move_bodies(ghosted);
  current.points    = std::move(points);
  const auto before = current.points.totals(current.bodies.size(), communicator);
  require_inside_box(problem(), current.points, current.time);
  discretise(step_size);
  start_step();
  record.volumes = problem().bulk.volumes();
  record.points  = current.points.totals(current.bodies.size(), communicator);
  require_no_loss(current.bodies, before, record.points,
                  dealii::Utilities::MPI::n_mpi_processes(communicator));
  const auto forces = transferred_forces(problem().contact(), current.step_end.contact,
                                         current.contact, communicator);
  for (unsigned int p = 0; p < pairs.size(); ++p)
    record.force_jumps[{pairs[p].a, pairs[p].b}]
      = forces[p].tangential_after - forces[p].tangential_before;
  return record;
}

template <int dim>
void
Model<dim>::set_rigid_rows()
{
  for (unsigned int b = 0; b < current.bodies.size(); ++b)
    if (current.bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (problem().space.owned().is_element(problem().space.rigid_unknown(b) + m))
          current.displacement(problem().space.rigid_unknown(b) + m)
            = current.bodies[b].pose.unknowns()[m];
  current.displacement.compress(dealii::VectorOperation::insert);
}

template <int dim>
void
Model<dim>::start_step()
{
  const DisplacementSpace<dim> &space = problem().space;
  current.displacement                = zero_displacement(space);
  set_rigid_rows();
  const StepEnd<dim> &end = current.step_end;
  for (unsigned int i = 0; i < end.multipliers.size(); ++i)
    if (space.owned().is_element(space.multiplier(i)))
      current.displacement(space.multiplier(i)) = end.multipliers[i];
  current.displacement.compress(dealii::VectorOperation::insert);
  current.contact = recall(problem().contact(), end.contact);
  keep_resultants(problem().contact(), end.contact, current.contact, communicator);
  problem().contact().start_step(current.contact);
  if (has_inertia())
    {
      fit_rates();
      Rates &rates = current.predictor.rates;
      if (parameters.contact.grid_nodes.is_chosen)
        remove_approach(problem(), current.contact, rates);
      problem().equilibrium().set_kinetic_energy(
        problem().mass->kinetic_energy(current.displacement, rates));
      problem().equilibrium().set_inertia(
        inertia_of<dim>(problem().mass, current.displacement, rates));
    }
  problem().equilibrium().start_step(current.time, current.displacement, current.contact,
                                     current.energies,
                                     !current.has_started ? nullptr : &end.driving);
}

template <int dim>
void
Model<dim>::begin_again(const double step_size)
{
  problem().find_contact(current, step_size);
  start_step();
}

template <int dim>
void
Model<dim>::go_back(State<dim> &&to, const double step_size)
{
  current = std::move(to);
  discretise(step_size);
  start_step();
}

template <int dim>
void
Model<dim>::resume_problem()
{
  problem().contact().start_step(current.contact);
  problem().equilibrium().resume(current.time, current.displacement, current.contact,
                                 current.energies);
}

template <int dim>
void
Model<dim>::take_back(State<dim> &&before, const double step_size)
{
  // The problem refers to the bodies, which are as they were, and so are the points.
  std::swap(before.bodies, current.bodies);
  std::swap(before.points, current.points);
  current = std::move(before);
  if (is_moving())
    begin_again(step_size);
  else
    resume_problem();
}

template <int dim>
void
Model<dim>::begin_stage(const bool friction_changes, const double step_size)
{
  bool is_other = friction_changes;
  for (unsigned int b = 0; b < current.bodies.size(); ++b)
    if (current.bodies[b].is_rigid())
      {
        auto driven = std::make_shared<RigidBody<dim>>(*current.bodies[b].rigid);
        is_other |= driven->set_motion(parameters.bodies[b].motion);
        current.bodies[b].rigid = driven;
      }
  const bool begins_motion = has_inertia() && current.predictor.rates.acceleration.size() == 0;
  if (begins_motion)
    scheme = make_time_scheme<dim>(parameters.time_scheme);
  if (is_other || begins_motion)
    {
      discrete_problem.reset(); // it refers to the pairs
      pairs = find_pairs();
      is_moving() ? discretise(step_size) : make_problem(step_size);
    }
  if (begins_motion)
    start_motion(step_size);
  else if (is_other)
    is_moving() ? start_step() : resume_problem();
}

template <int dim>
double
Model<dim>::reset(const double step_size)
{
  const double stored = problem().equilibrium().energies().stored();
  start_from_here(current.points);
  for (auto &body : current.bodies)
    if (!body.is_rigid())
      {
        body.initial_level_set = std::make_shared<const Lattice<dim>>(body.level_set);
        body.displacement      = {};
        body.shape             = nullptr;
      }
  current.step_end.contact = {};
  current.predictor        = {};
  is_reset                 = true;
  discretise(step_size);
  start_step();
  return problem().equilibrium().energies().stored() - stored;
}

template <int dim>
GatheredState<dim>
Model<dim>::gathered() const
{
  return gather(current, problem().space, problem().contact(), is_moving(), is_reset);
}

template <int dim>
void
Model<dim>::restore(const GatheredState<dim> &saved, const double time, const double step_size,
                    const std::string &directory)
{
  current.time = time;
  require(saved.has_inertia == has_inertia(), directory,
          std::string("its run is one ") + (saved.has_inertia ? "with" : "without") + " inertia",
          "leave Time/Scheme as it was; schemes with inertia may take the place of each other");
  if (!is_moving())
    {
      restore_fixed(saved, problem().space, problem().contact(), directory, current);
      resume_problem();
      return;
    }
  restore_moving(saved, grid->box(), communicator, directory, current);
  is_reset = saved.is_reset;
  for (unsigned int b = 0; b < current.bodies.size(); ++b)
    if (current.bodies[b].is_rigid())
      place_rigid_body(current.bodies[b], saved.bodies[b].pose, lattice_frame(), lattice_margin());
  try
    {
      discretise(step_size);
    }
  catch (const dealii::ExceptionBase &error)
    {
      throw UserError(directory,
                      std::string("the grid of the checkpoint does not fit its bodies and points: ")
                        + error.what(),
                      "start the run anew");
    }
  const StepEnd<dim> &end = current.step_end;
  require(end.multipliers.size() == BoundaryTerms<dim>::n_multipliers(current.bodies)
            && std::all_of(end.driving.of_points.begin(), end.driving.of_points.end(),
                           [n = problem().boundary_terms.regions().size()](const auto &point) {
                             return point.region < n;
                           }),
          directory, "the checkpoint belongs to other boundary conditions", "start the run anew");
  start_step();
}

template class Model<2>;
template class Model<3>;
} // namespace scree
