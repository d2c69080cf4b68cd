#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/bodies/rigid_placement.h>
#include <scree/mechanics/reference_map.h>
#include <scree/points/migration.h>
#include <scree/points/seeding.h>
#include <scree/points/splitting.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// A run on a moving geometry: what happens between the load steps.
namespace scree
{
template <int dim>
void
Simulation<dim>::set_up_points()
{
  const Timings::Scope scope(timings, "material points");
  if (!has_started())
    seed_points();
  else
    {
      const auto owner = [&](const dealii::Point<dim> &x) { return grid->locate(x).rank; };
      send_to_owners<dim>(state.points, owner, communicator);
      divide_points();
      // the parts of a point may lie in cells of other processes
      send_to_owners<dim>(state.points, owner, communicator);
    }
  step_start = std::make_unique<StepStart<dim>>(*fields, *quadrature, bodies, state.points,
                                                parameters.moving);
}

template <int dim>
void
Simulation<dim>::seed_points()
{
  std::vector<double> density;
  for (const auto &body : bodies)
    density.push_back(body.is_rigid() ? 0. : body.material->density());
  const PointSeeding<dim> seeding(*fields, *level_set_nodes, bodies, *quadrature, density);
  const unsigned int      n_internal
    = StepStart<dim>::needs_internal(bodies) ? StepStart<dim>::n_internal : 0;
  state.points = parameters.moving.places == PointPlaces::quadrature_points
                   ? seeding.at_quadrature_points(n_internal)
                   : seeding.on_sub_grid(points_per_direction(), n_internal);
}

template <int dim>
unsigned int
Simulation<dim>::points_per_direction() const
{
  return parameters.moving.points_per_direction > 0 ? parameters.moving.points_per_direction
                                                    : parameters.degree + 1;
}

template <int dim>
void
Simulation<dim>::divide_points()
{
  // Points may spread a little first, but in a cell that was halved they are divided.
  constexpr double    largest_spread = 1.4;
  std::vector<double> cell_size;
  for (const auto &location : locate_points(*fields, state.points))
    cell_size.push_back(largest_spread
                        * grid->cells()[fields->cells()[location.active_cell].grid_cell].size);
  split_points(state.points, cell_size, points_per_direction(),
               {parameters.degree, parameters.moving.support});
}

template <int dim>
MaterialPoints<dim>
Simulation<dim>::moved_points(const typename Equilibrium<dim>::Vector &u) const
{
  MaterialPoints<dim>                 points = state.points;
  const std::vector<double>           values = values_by_cell(*fields, equilibrium->with_ghosts(u));
  const unsigned int                  n      = fields->basis.n_nodes;
  std::vector<dealii::Tensor<1, dim>> increments(points.size());
  std::vector<dealii::Tensor<2, dim>> gradients(points.size());
  ShapeValues<dim>                    shape;
  const auto                          volumes = bulk->cell_volumes(equilibrium->with_ghosts(u));
  for (std::size_t p = 0; p < points.size(); ++p)
    {
      const auto  &location = step_start->material_points()[p];
      const double scale = 1. / grid->cells()[fields->cells()[location.active_cell].grid_cell].size;
      const double *nodal = &values[std::size_t(location.active_cell) * n * dim];
      fields->basis.evaluate(location.unit_point, shape);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          {
            increments[p][d] += nodal[a * dim + d] * shape.value[a];
            gradients[p][d] += nodal[a * dim + d] * scale * shape.gradient[a];
          }

      const auto             &law     = *bodies[points.body[p]].law;
      const PointHistory<dim> history = step_start->history_of_material_point(p);
      const IncrementStart    start   = law.start(history);
      dealii::Tensor<2, dim>  F_D     = gradients[p];
      for (unsigned int d = 0; d < dim; ++d)
        F_D[d][d] += 1.;
      F_D = bulk->projected_increment(location.active_cell, location.unit_point,
                                      volumes[location.active_cell], F_D, start);
      IncrementResponse<dim> response;
      law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(&F_D, 1),
                  dealii::ArrayView<const IncrementStart>(&start, 1),
                  dealii::ArrayView<IncrementResponse<dim>>(&response, 1), {});
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          points.stress[p][i][j] = response.cauchy[i][j];
      if (points.n_internal() > 0)
        {
          const PointHistory<dim> next = law.finish(history, F_D, response);
          store_internal(law, next, &points.internal[p * points.n_internal()]);
        }
    }
  points.move(increments, gradients);
  return points;
}

template <int dim>
std::string
Simulation<dim>::why_too_large() const
{
  // Of the points: nodes of cut cells off the body may run ahead where it is strained much.
  const double        h = grid->finest_size();
  std::vector<double> motions(bodies.size(), 0.);
  for (std::size_t p = 0; p < state.points.size(); ++p)
    {
      double &largest = motions[state.points.body[p]];
      largest = std::max(largest, points_at_end.position[p].distance(state.points.position[p]));
    }
  dealii::Utilities::MPI::max(motions, communicator, motions);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (motions[b] > parameters.moving.largest_motion * h)
      return "the body " + bodies[b].name + " moves by " + short_number(motions[b] / h)
             + " finest cells (Moving geometry/Largest motion)";
  double slip = 0.;
  for (const auto &response : contact->responses())
    slip = std::max(slip, response.slip);
  slip = dealii::Utilities::MPI::max(slip, communicator);
  if (slip > parameters.moving.largest_slip * h)
    return "contact slides by " + short_number(slip / h)
           + " finest cells (Moving geometry/Largest slip)";
  return "";
}

template <int dim>
void
Simulation<dim>::move_geometry()
{
  const auto ghosted = equilibrium->with_ghosts(state.displacement);
  state.step_end     = {remember(*contact, communicator),
                        {},
                        equilibrium->energies(),
                        equilibrium->driving_forces()};
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    state.step_end.multipliers.push_back(ghosted(fields->multiplier(i)));
  predictor.of_rigid.resize(bodies.size());
  MotionRecord<dim> record;
  record.transfer_report = step_start->transfer_report();
  {
    const Timings::Scope scope(timings, "level sets");
    const double         margin = lattice_margin();
    predictor.of_bodies.clear();
    for (auto &motion : move_level_sets(
           bodies, *fields, ghosted, equilibrium->with_ghosts(step_start->displacement()),
           {margin, parameters.moving.motion, parameters.moving.slope_tolerance}))
      {
        const unsigned int b = predictor.of_bodies.size();
        if (motion.face_increment > 1e-6 * grid->finest_size()
            && warned_pairs.insert({b, b}).second)
          log.line("Warning: the body " + bodies[b].name + " moves by "
                   + short_number(motion.face_increment)
                   + " through a face of the background box, which does not move: its level set "
                     "gains or loses volume there. Hold the motion normal to that face, or let the "
                     "body end inside the box");
        predictor.of_bodies.push_back(std::move(motion.increment));
        record.n_islands += motion.n_islands;
      }
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].is_rigid())
        {
          const auto q = rigid_unknowns(*fields, b, ghosted);
          for (unsigned int m = 0; m < q.size(); ++m)
            predictor.of_rigid[b][m] = q[m] - bodies[b].pose.unknowns()[m];
          place_rigid_body(bodies[b], q, lattice_frame(), margin);
        }
  }
  state.points = std::move(points_at_end);
  require_inside_box();
  discretise();
  results->set_discretization(*fields, *level_set_nodes);
  start_step();
  record.volumes = bulk->volumes();
  record.points  = state.points.totals(bodies.size(), communicator);
  require_no_loss(record.points);
  const auto forces
    = transferred_forces(*contact, state.step_end.contact, state.contact, communicator);
  for (unsigned int p = 0; p < pairs.size(); ++p)
    record.force_jumps[{pairs[p].a, pairs[p].b}]
      = forces[p].tangential_after - forces[p].tangential_before;
  results->gather_motion(record);
}

template <int dim>
void
Simulation<dim>::start_step()
{
  state.displacement = zero_displacement(*fields);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (fields->owned().is_element(fields->rigid_unknown(b) + m))
          state.displacement(fields->rigid_unknown(b) + m) = bodies[b].pose.unknowns()[m];
  const StepEnd<dim> &end = state.step_end;
  for (unsigned int i = 0; i < end.multipliers.size(); ++i)
    if (fields->owned().is_element(fields->multiplier(i)))
      state.displacement(fields->multiplier(i)) = end.multipliers[i];
  state.displacement.compress(dealii::VectorOperation::insert);
  state.contact = recall(*contact, end.contact);
  keep_resultants(*contact, end.contact, state.contact, communicator);
  equilibrium->start_step(state.time, state.displacement, state.contact, end.energies,
                          !has_started() ? nullptr : &end.driving);
}

template <int dim>
void
Simulation<dim>::require_no_loss(const std::vector<PointTotals<dim>> &points)
{
  // Division of points raises their number and keeps their mass and initial volume. The sums are
  // compensated on each process, so that only those of the processes add up rounding.
  const double tolerance = (64. + dealii::Utilities::MPI::n_mpi_processes(communicator))
                           * std::numeric_limits<double>::epsilon();
  const auto is_kept = [&](const double before, const double now) {
    return std::abs(now - before) <= tolerance * before;
  };
  for (unsigned int b = 0; b < points.size() && !points_before.empty(); ++b)
    AssertThrow(points[b].count >= points_before[b].count
                  && is_kept(points_before[b].mass, points[b].mass)
                  && is_kept(points_before[b].initial_volume, points[b].initial_volume),
                dealii::ExcMessage("material points of " + bodies[b].name + " were lost"));
  points_before = points;
}

template <int dim>
typename ContactPoints<dim>::Prediction
Simulation<dim>::prediction() const
{
  if (predictor.step_size == 0.)
    return {};
  return [this](const unsigned int body, const dealii::Point<dim> &x) {
    return expected_increment(body, x);
  };
}

template <int dim>
dealii::Tensor<1, dim>
Simulation<dim>::expected_increment(const unsigned int body, const dealii::Point<dim> &x) const
{
  const double factor = step_control.step_size() / predictor.step_size;
  if (!bodies[body].is_rigid())
    {
      // The increment belongs to where the point was before.
      const auto &increment = predictor.of_bodies[body];
      return factor * increment(x - increment(x));
    }
  const RigidPose<dim> &now  = bodies[body].pose;
  auto                  next = now.unknowns();
  const auto            X    = now.initial_position(x);
  for (unsigned int m = 0; m < next.size(); ++m)
    next[m] += factor * predictor.of_rigid[body][m];
  return RigidPose<dim>(*bodies[body].rigid, next).displacement(X) - now.displacement(X);
}

template <int dim>
typename Equilibrium<dim>::Vector
Simulation<dim>::predicted(const double time) const
{
  const double factor = (time - state.time) / predictor.step_size;
  auto         result = state.displacement;
  for (unsigned int a = 0; a < fields->n_owned_cells(); ++a)
    {
      const ActiveCell &cell     = fields->cells()[a];
      const auto       &geometry = grid->cells()[cell.grid_cell];
      for (unsigned int i = 0; i < fields->basis.n_nodes; ++i)
        {
          const DofIndex node = fields->nodes(a)[i];
          if (!fields->owned().is_element(node)
              || fields->hanging_constraints().is_constrained(node))
            continue;
          const auto increment
            = factor
              * predictor.of_bodies[cell.body](
                geometry.lower + geometry.size * dealii::Tensor<1, dim>(fields->basis.node(i)));
          for (unsigned int d = 0; d < dim; ++d)
            result(node + d) = increment[d];
        }
    }
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (fields->owned().is_element(fields->rigid_unknown(b) + m))
          result(fields->rigid_unknown(b) + m)
            = bodies[b].pose.unknowns()[m] + factor * predictor.of_rigid[b][m];
  result.compress(dealii::VectorOperation::insert);
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template void                Simulation<dim>::set_up_points();                                \
  template void                Simulation<dim>::seed_points();                                  \
  template unsigned int        Simulation<dim>::points_per_direction() const;                   \
  template void                Simulation<dim>::divide_points();                                \
  template MaterialPoints<dim> Simulation<dim>::moved_points(                                   \
    const typename Equilibrium<dim>::Vector &) const;                                           \
  template std::string Simulation<dim>::why_too_large() const;                                  \
  template void        Simulation<dim>::move_geometry();                                        \
  template void        Simulation<dim>::require_no_loss(const std::vector<PointTotals<dim>> &); \
  template void        Simulation<dim>::start_step();                                           \
  template typename ContactPoints<dim>::Prediction Simulation<dim>::prediction() const;         \
  template dealii::Tensor<1, dim>                  Simulation<dim>::expected_increment(         \
                     const unsigned int, const dealii::Point<dim> &) const;                     \
  template typename Equilibrium<dim>::Vector Simulation<dim>::predicted(const double) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
