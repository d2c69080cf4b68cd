#include <scree/mechanics/material_update.h>
#include <scree/mechanics/point_neighbours.h>
#include <scree/points/migration.h>
#include <scree/points/seeding.h>
#include <scree/points/splitting.h>

namespace scree
{
template <int dim>
MaterialPoints<dim>
seed_points(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
            const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
            const MovingGeometryParameters &parameters)
{
  std::vector<double> density;
  density.reserve(bodies.size());
  for (const auto &body : bodies)
    density.push_back(body.is_rigid() ? 0. : body.material->density());
  const PointSeeding<dim> seeding(space, level_set_nodes, bodies, quadrature, density);
  const unsigned int      n_internal
    = StepStart<dim>::needs_internal(bodies) ? StepStart<dim>::n_internal : 0;
  return parameters.places == PointPlaces::quadrature_points
           ? seeding.at_quadrature_points(n_internal)
           : seeding.on_sub_grid(parameters.points_of_cell(space.basis.degree), n_internal);
}

template <int dim>
void
distribute_points(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                  const MovingGeometryParameters &parameters, MaterialPoints<dim> &points)
{
  // Points may spread a little first, but in a cell that was halved they are divided.
  constexpr double largest_spread = 1.4;
  const auto       owner = [&](const dealii::Point<dim> &x) { return space.grid.locate(x).rank; };
  send_to_owners<dim>(points, owner, space.grid.communicator());
  std::vector<double> cell_size;
  for (const auto &location : locate_points(space, bodies, points))
    cell_size.push_back(largest_spread * space.cell_size(location.active_cell));
  const unsigned int degree = space.basis.degree;
  split_points<dim>(
    points, cell_size, parameters.points_of_cell(degree),
    {parameters.least_squares_degree(degree), parameters.support},
    [&](const MaterialPoints<dim> &own) { return with_neighbours(space, parameters.support, own); },
    space.grid.communicator());
  // The parts of a point may lie in cells of other processes.
  send_to_owners<dim>(points, owner, space.grid.communicator());
}

template <int dim>
MaterialPoints<dim>
moved_points(const MaterialPoints<dim> &old_points, const std::vector<PointInCell<dim>> &places,
             const std::vector<PointHistory<dim>> &histories, const std::vector<Body<dim>> &bodies,
             const IncrementalBulk<dim> &bulk, const PointEvaluator<dim> &u,
             const bool laws_see_gradients)
{
  constexpr std::size_t               most = 256; // points that a law is asked at once
  const dealii::Tensor<2, dim>        identity(dealii::unit_symmetric_tensor<dim>());
  MaterialPoints<dim>                 points  = old_points;
  const auto                         &volumes = bulk.cell_volumes(u);
  std::vector<dealii::Tensor<1, dim>> increments(points.size());
  std::vector<dealii::Tensor<2, dim>> gradients(points.size());
  std::vector<IncrementStart>         starts(most);
  std::vector<dealii::Tensor<2, dim>> F_D(most);
  std::vector<IncrementResponse<dim>> responses(most);
  for (std::size_t first = 0, n; first < points.size(); first += n)
    {
      const auto &law = *bodies[points.body[first]].law;
      for (n = 0; n < most && first + n < points.size(); ++n)
        {
          const std::size_t p = first + n;
          if (points.body[p] != points.body[first])
            break;
          const PointInCell<dim> &place = places[p];
          const auto              here  = u.evaluate(place);
          increments[p]                 = here.value;
          starts[n]                     = law.start(histories[p]);

          F_D[n] = bulk.volume_projection().projected_increment(
            place.active_cell, place.unit_point, volumes[place.active_cell],
            here.gradient + identity, starts[n]);
          gradients[p] = laws_see_gradients ? F_D[n] - identity : here.gradient;
        }
      law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(F_D.data(), n),
                  dealii::ArrayView<const IncrementStart>(starts.data(), n),
                  dealii::ArrayView<IncrementResponse<dim>>(responses.data(), n), {});
      for (std::size_t i = 0; i < n; ++i)
        {
          const std::size_t p = first + i;
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = d; e < dim; ++e)
              points.stress[p][d][e] = responses[i].cauchy[d][e];
          if (dim == 2)
            points.out_of_plane_stress[p] = responses[i].cauchy[2][2];
          if (points.n_internal() > 0)
            store_internal(law, law.finish(histories[p], F_D[i], responses[i]),
                           &points.internal[p * points.n_internal()]);
        }
    }
  points.move(increments, gradients);
  return points;
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template MaterialPoints<dim> seed_points(                                                       \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &,   \
    const CutQuadrature<dim> &, const MovingGeometryParameters &);                                \
  template void distribute_points(const DisplacementSpace<dim> &, const std::vector<Body<dim>> &, \
                                  const MovingGeometryParameters &, MaterialPoints<dim> &);       \
  template MaterialPoints<dim> moved_points(                                                      \
    const MaterialPoints<dim> &, const std::vector<PointInCell<dim>> &,                           \
    const std::vector<PointHistory<dim>> &, const std::vector<Body<dim>> &,                       \
    const IncrementalBulk<dim> &, const PointEvaluator<dim> &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
