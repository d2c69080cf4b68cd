#include <scree/discretization/polytope.h>
#include <scree/output/assembly_region.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scree
{
namespace
{
using dealii::Point;
using dealii::Tensor;

constexpr double lowest = std::numeric_limits<double>::lowest();

/** A flat face of a rigid body, its normal out of that. */
template <int dim>
struct Wall
{
  unsigned int     body;
  SmoothPiece<dim> plane;
  Tensor<1, dim>   normal;

  /** The axis along which it bounds grains, from below if the normal points up. */
  unsigned int axis() const
  {
    unsigned int result = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(normal[d]) > std::abs(normal[result]))
        result = d;
    return result;
  }
};

/** All flat faces of rigid bodies, where u brings them. */
template <int dim>
std::vector<Wall<dim>>
flat_faces(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
           const dealii::TrilinosWrappers::MPI::Vector &u)
{
  std::vector<Wall<dim>> result;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid() && bodies[b].rigid->shape)
      {
        const RigidBody<dim> &rigid = *bodies[b].rigid;
        const RigidPose<dim>  pose(rigid, rigid_unknowns(space, b, u));
        const auto            rotation = transpose(pose.initial_gradient());
        auto                  around   = space.grid.box();
        for (unsigned int d = 0; d < dim; ++d)
          around.extend(space.grid.box().side_length(d));
        std::vector<SmoothPiece<dim>> pieces;
        rigid.shape->append_pieces(around, pieces);
        for (const auto &piece : pieces)
          if (piece.is_plane())
            {
              const auto plane = piece.moved(rotation, rigid.reference_point, pose.translation());
              result.push_back({b, plane, plane.normal(Point<dim>(), 1.)});
            }
      }
  return result;
}

/** Bounds of the grains along the axes, and how far they are behind the faces. */
template <int dim>
struct Extent
{
  Point<dim>          lower, upper; //!< upper < lower: there are none
  std::vector<double> behind;       //!< each face
};

template <int dim>
Extent<dim>
extent_of_grains(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                 const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
                 const std::vector<Wall<dim>>                &faces,
                 const dealii::TrilinosWrappers::MPI::Vector &u)
{
  const PointEvaluator<dim> displacement(space, u);
  // -x, x and -distance to the faces, of which the largest values are sought
  std::vector<double> bounds(2 * dim + faces.size(), lowest);
  const auto          add = [&](const unsigned int a, const Point<dim> &unit_point) {
    const auto x = space.position(a, unit_point) + displacement.value({a, unit_point});
    for (unsigned int d = 0; d < dim; ++d)
      {
        bounds[d]       = std::max(bounds[d], -x[d]);
        bounds[dim + d] = std::max(bounds[dim + d], x[d]);
      }
    for (unsigned int i = 0; i < faces.size(); ++i)
      bounds[2 * dim + i] = std::max(bounds[2 * dim + i], -faces[i].plane.value(x));
  };
  const LagrangeBasis<dim>                   &basis = level_set_nodes.basis();
  std::array<double, max_nodes_per_cell<dim>> phi;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      for (unsigned int q = quadrature.surface.begin[a]; q < quadrature.surface.begin[a + 1]; ++q)
        add(a, quadrature.surface.points[q]);
      // Bodies that go on beyond the box of the grid end there.
      level_set_nodes.cell_values(cell.grid_cell, bodies[cell.body].level_set, phi.data());
      for (unsigned int i = 0; i < basis.n_nodes; ++i)
        if (phi[i] < 0.)
          add(a, basis.node(i));
    }
  dealii::Utilities::MPI::max(bounds, space.grid.communicator(), bounds);
  Extent<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result.lower[d] = -bounds[d];
      result.upper[d] = bounds[dim + d];
    }
  result.behind.assign(bounds.begin() + 2 * dim, bounds.end());
  return result;
}

/** Whether a body is at least half as wide as the grains, across the axis. */
template <int dim>
bool
is_wide(const dealii::BoundingBox<dim> &body, const Extent<dim> &grains, const unsigned int axis)
{
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double width = std::min(body.upper_bound(d), grains.upper[d])
                           - std::max(body.lower_bound(d), grains.lower[d]);
      if (d != axis && width < 0.5 * (grains.upper[d] - grains.lower[d]))
        return false;
    }
  return true;
}

/** What of a box with the corner `lower` and the `edges` is in front of all walls. */
template <int dim>
AssemblyRegion<dim>
room(const Point<dim> &lower, const Tensor<1, dim> &edges, const std::vector<Wall<dim>> &walls)
{
  std::optional<Polytope<dim>> part       = Polytope<dim>::unit_cell();
  double                       box_volume = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    box_volume *= edges[d];
  for (const Wall<dim> &wall : walls)
    if (part)
      {
        CellPlane<dim> plane;
        for (unsigned int d = 0; d < dim; ++d)
          plane.normal[d] = wall.normal[d] * edges[d];
        const double length = plane.normal.norm();
        plane.normal /= length;
        plane.offset = wall.plane.value(lower) / length;
        part         = part->split(plane, 0).second;
      }
  AssemblyRegion<dim> result;
  if (!part)
    return result;
  result.volume           = part->volume() * box_volume;
  const Point<dim> middle = part->middle();
  for (unsigned int d = 0; d < dim; ++d)
    {
      double     below = -middle[d] * edges[d], above = (1. - middle[d]) * edges[d];
      Point<dim> x;
      for (unsigned int e = 0; e < dim; ++e)
        x[e] = lower[e] + middle[e] * edges[e];
      for (const Wall<dim> &wall : walls)
        if (wall.normal[d] != 0.)
          {
            const double there = -wall.plane.value(x) / wall.normal[d];
            (there < 0. ? below : above)
              = there < 0. ? std::max(below, there) : std::min(above, there);
          }
      result.lengths[d] = above - below;
    }
  return result;
}
} // namespace

template <int dim>
AssemblyRegion<dim>
assembly_region(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
                const dealii::TrilinosWrappers::MPI::Vector &u)
{
  constexpr double upright = 0.9; // cos 25 degrees
  const auto       faces   = flat_faces(space, bodies, u);
  const auto       grains  = extent_of_grains(space, level_set_nodes, bodies, quadrature, faces, u);
  if (grains.upper[0] < grains.lower[0])
    return {};
  const double           far   = (grains.upper - grains.lower).norm();
  Point<dim>             lower = grains.lower, upper = grains.upper;
  std::vector<Wall<dim>> walls;
  for (unsigned int i = 0; i < faces.size(); ++i)
    {
      const unsigned int axis = faces[i].axis();
      if (grains.behind[i] > 2. * space.grid.finest_size()
          || !is_wide(bodies[faces[i].body].box, grains, axis))
        continue;
      walls.push_back(faces[i]);
      const double along = faces[i].normal[axis];
      if (along > upright)
        lower[axis] = std::min(lower[axis], grains.lower[axis] - far + grains.behind[i]);
      else if (along < -upright)
        upper[axis] = std::max(upper[axis], grains.upper[axis] + far - grains.behind[i]);
    }
  return room(lower, upper - lower, walls);
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template struct AssemblyRegion<dim>;                                                          \
  template AssemblyRegion<dim> assembly_region(                                                 \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &, \
    const CutQuadrature<dim> &, const dealii::TrilinosWrappers::MPI::Vector &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
