#include <scree/base/exceptions.h>
#include <scree/base/joint_sum.h>
#include <scree/mechanics/load_points.h>

namespace scree
{
namespace
{
/** Adds the points of a region in a cell of its body. */
template <int dim>
void
add_points(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
           const CutQuadrature<dim> &quadrature, const Body<dim> &body,
           const Kinematics<dim> &kinematics, const unsigned int a, CutCellRules<dim> &rules,
           BoundaryRegion<dim> &region)
{
  const ActiveCell  &cell     = space.cells()[a];
  const auto        &geometry = space.grid.cells()[cell.grid_cell];
  const unsigned int face     = region.condition->box_face;
  const bool         on_face  = face != BoundaryCondition<dim>::no_face;
  if (on_face ? !geometry.iterator->at_boundary(face) : !cell.is_cut)
    return;
  // Loads see the exact boundary; what holds a body acts on the cut one, as the bulk does.
  const auto &parameters = region.condition->parameters;
  const bool  is_whole   = parameters.where == "1";
  const auto  is_exact   = region.condition->kind().law.acts_on_exact_boundary;
  const auto *shape      = kinematics.exact_shape(body);
  const bool  is_load    = is_exact != nullptr && is_exact(parameters) && shape != nullptr;
  std::function<bool(const dealii::Point<dim> &)> selects; // none: all
  if (!is_whole)
    selects = [&](const dealii::Point<dim> &x) { return region.condition->selects(x); };
  CellPoints<dim> points;
  if (!on_face && !is_load)
    {
      const auto &surface = quadrature.surface;
      const auto  first = surface.begin[a], last = surface.begin[a + 1];
      points.points.assign(surface.points.begin() + first, surface.points.begin() + last);
      points.weights.assign(surface.weights.begin() + first, surface.weights.begin() + last);
      points.normals.assign(surface.normals.begin() + first, surface.normals.begin() + last);
    }
  else
    {
      const CellCut<dim> cut = level_set_nodes.cut(cell.grid_cell, body);
      points                 = is_load ? load_rule<dim>(rules, geometry, shape, cut, face, selects)
                                       : rules.face_rule(cut, geometry.size, face);
      if (is_load && on_face)
        points.append(strip_on_face(*shape, rules, geometry, cut, face));
    }
  for (unsigned int q = 0; q < points.points.size(); ++q)
    {
      const dealii::Point<dim> position = space.position(a, points.points[q]);
      BoundaryPoint<dim>       point
        = {a, points.points[q], position, points.normals[q], points.weights[q], position, {}, 1.};
      if (is_load && !on_face)
        move_to_boundary(*shape, geometry, point);
      const auto then          = kinematics.surface_history({a, points.points[q]}, point.normal);
      point.start_displacement = then.displacement;
      point.reference_position -= then.displacement;
      point.area_ratio = then.area_ratio;
      if (region.condition->selects(point.reference_position))
        region.points.push_back(point);
    }
}

/** Area, centre and polar moment of all regions over all processes. */
template <int dim>
void
measure(const MPI_Comm communicator, std::vector<BoundaryRegion<dim>> &regions)
{
  std::vector<dealii::Tensor<1, dim>> first_moments(regions.size());
  JointSum                            sum_to_first, sum_to_second;
  for (unsigned int r = 0; r < regions.size(); ++r)
    {
      for (const auto &point : regions[r].points)
        {
          regions[r].area += point.weight;
          first_moments[r] += point.weight * point.position;
        }
      sum_to_first.add(regions[r].area);
      sum_to_first.add(first_moments[r]);
    }
  sum_to_first.reduce(communicator);
  for (unsigned int r = 0; r < regions.size(); ++r)
    {
      if (regions[r].area > 0.)
        regions[r].centre = dealii::Point<dim>(first_moments[r] / regions[r].area);
      for (const auto &point : regions[r].points)
        regions[r].polar_moment += point.weight * squared_arm(regions[r], point);
      sum_to_second.add(regions[r].polar_moment);
    }
  sum_to_second.reduce(communicator);
}
} // namespace

template <int dim>
double
squared_arm(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point)
{
  const dealii::Tensor<1, dim> arm = point.position - region.centre;
  return arm[0] * arm[0] + arm[1] * arm[1];
}

template <int dim>
std::vector<BoundaryRegion<dim>>
find_boundary_regions(const DisplacementSpace<dim> &space,
                      const LevelSetNodes<dim>     &level_set_nodes,
                      const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies,
                      const Kinematics<dim> &kinematics)
{
  std::vector<BoundaryRegion<dim>>       regions;
  std::vector<std::vector<unsigned int>> regions_of_body(bodies.size());
  unsigned int                           next_multiplier = 0;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (const auto &condition : bodies[b].conditions)
      {
        if (condition.is_strong() || condition.is_at_vertex())
          continue;
        regions_of_body[b].push_back(regions.size());
        regions.push_back(
          {b, &condition, {}, 0., {}, 0., next_multiplier, kinematics.follows_surface(condition)});
        next_multiplier += condition.n_multipliers();
      }
  CutCellRules<dim> rules = level_set_nodes.rules();
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const unsigned int b = space.cells()[a].body;
      for (const unsigned int r : regions_of_body[b])
        add_points(space, level_set_nodes, quadrature, bodies[b], kinematics, a, rules, regions[r]);
    }
  measure(space.grid.communicator(), regions);
  for (const auto &region : regions)
    require(region.area > 0., region.condition->path,
            "the region selects nothing of the body '" + bodies[region.body].name + "'",
            "check On and Where; does the body reach that face of the box?");
  return regions;
}

#define SCREE_INSTANTIATE(dim)                                                              \
  template double squared_arm(const BoundaryRegion<dim> &, const BoundaryPoint<dim> &);     \
  template std::vector<BoundaryRegion<dim>> find_boundary_regions(                          \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const CutQuadrature<dim> &, \
    const std::vector<Body<dim>> &, const Kinematics<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
