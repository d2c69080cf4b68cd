#include <scree/base/exceptions.h>
#include <scree/mechanics/load_points.h>

#include <deal.II/base/mpi.h>

namespace scree
{
namespace
{
template <int dim>
void
find_points(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
            const CutQuadrature<dim> &quadrature, const Body<dim> &body,
            const StepStart<dim> *start, BoundaryRegion<dim> &region)
{
  CutCellRules<dim>  rules(fields.basis);
  const unsigned int face = region.condition->box_face;
  // Loads see the exact boundary; what holds a body acts on the cut one, as the bulk does, and so
  // does a pressure all around, whose uniform stress is then exact.
  const auto &parameters = region.condition->parameters;
  const bool  is_whole   = parameters.where == "1";
  const bool  is_load    = (parameters.type == ConditionType::traction
                        || (parameters.type == ConditionType::pressure
                            && !(is_whole && face == BoundaryCondition<dim>::no_face)))
                       && !start && body.shape;
  std::function<bool(const dealii::Point<dim> &)> selects; // none: all
  if (!is_whole)
    selects = [&](const dealii::Point<dim> &x) { return region.condition->selects(x); };
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = fields.cells()[a];
      if (cell.body != region.body)
        continue;
      const auto     &geometry = fields.grid.cells()[cell.grid_cell];
      const bool      on_face  = face != BoundaryCondition<dim>::no_face;
      CellPoints<dim> points;
      if (on_face ? !geometry.iterator->at_boundary(face) : !cell.is_cut)
        continue;
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
          points = is_load ? load_rule<dim>(rules, fields.basis, geometry, body.shape.get(), cut,
                                            face, selects)
                           : rules.face_rule(cut, geometry.size, face);
          if (is_load && on_face)
            points.append(strip_on_face(*body.shape, fields.basis, geometry, cut, face));
        }
      for (unsigned int q = 0; q < points.points.size(); ++q)
        {
          const dealii::Point<dim> position
            = geometry.lower + geometry.size * dealii::Tensor<1, dim>(points.points[q]);
          BoundaryPoint<dim> point = {
            a, points.points[q], position, points.normals[q], points.weights[q], position, {}, 1.};
          if (is_load && face == BoundaryCondition<dim>::no_face)
            move_to_boundary(*body.shape, geometry, point);
          if (start)
            {
              const auto   then        = start->deformation({a, points.points[q]});
              const double stretch     = (point.normal * then.gradient).norm();
              point.start_displacement = then.displacement;
              point.reference_position -= then.displacement;
              point.area_ratio = stretch / determinant(then.gradient);
            }
          if (region.condition->selects(point.reference_position))
            region.points.push_back(point);
        }
    }
}

/** Area and centre over all processes. */
template <int dim>
void
measure(const MPI_Comm communicator, BoundaryRegion<dim> &region)
{
  dealii::Tensor<1, dim> first_moment;
  double                 area = 0.;
  for (const auto &point : region.points)
    {
      area += point.weight;
      first_moment += point.weight * point.position;
    }
  region.area  = dealii::Utilities::MPI::sum(area, communicator);
  first_moment = dealii::Utilities::MPI::sum(first_moment, communicator);
  if (region.area > 0.)
    region.centre = dealii::Point<dim>(first_moment / region.area);
}
} // namespace

template <int dim>
std::vector<BoundaryRegion<dim>>
find_boundary_regions(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                      const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies,
                      const StepStart<dim> *start)
{
  std::vector<BoundaryRegion<dim>> regions;
  unsigned int                     next_multiplier = 0;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (const auto &condition : bodies[b].conditions)
      {
        if (condition.is_strong() || condition.parameters.type == ConditionType::point_support)
          continue;
        regions.push_back({b, &condition, {}, 0., {}, next_multiplier});
        BoundaryRegion<dim> &region = regions.back();
        find_points(fields, level_set_nodes, quadrature, bodies[b], start, region);
        measure(fields.grid.communicator(), region);
        require(region.area > 0., condition.path,
                "the region selects nothing of the body '" + bodies[b].name + "'",
                "check On and Where; does the body reach that face of the box?");
        if (condition.parameters.type == ConditionType::mean_support)
          next_multiplier += condition.components.size();
      }
  return regions;
}

#define SCREE_INSTANTIATE(dim)                                                   \
  template std::vector<BoundaryRegion<dim>> find_boundary_regions(               \
    const Fields<dim> &, const LevelSetNodes<dim> &, const CutQuadrature<dim> &, \
    const std::vector<Body<dim>> &, const StepStart<dim> *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
