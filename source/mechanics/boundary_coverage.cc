#include <scree/mechanics/boundary_coverage.h>
#include <scree/mechanics/load_points.h>

#include <algorithm>

namespace scree
{
template <int dim>
void
set_coverage(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
             const Body<dim> &body, const BoundaryRegion<dim> &region,
             const Kinematics<dim> &kinematics, std::vector<double> &coverage)
{
  CutCellRules<dim> rules     = level_set_nodes.rules();
  int               last_cell = -1;
  for (const auto &point : region.points)
    {
      const unsigned int a = point.active_cell;
      if (last_cell == int(a))
        continue;
      last_cell                                                      = a;
      const auto                                            cell     = space.cells()[a].grid_cell;
      const auto                                           &geometry = space.grid.cells()[cell];
      const std::function<bool(const dealii::Point<dim> &)> selects  = [&](const auto &x) {
        return region.condition->selects(
           kinematics.reference_position({a, space.unit_point(a, x)}));
      };
      const CellPoints<dim> surface
        = load_rule<dim>(rules, geometry, nullptr, level_set_nodes.cut(cell, body),
                         region.condition->box_face, selects);
      double covered = 0., all = 0.;
      for (unsigned int q = 0; q < surface.points.size(); ++q)
        {
          all += surface.weights[q];
          if (selects(space.position(a, surface.points[q])))
            covered += surface.weights[q];
        }
      coverage[a] = all > 0. ? covered / all : 0.;
    }
}

template <int dim>
std::vector<bool>
outer_edge(const DisplacementSpace<dim> &space, const std::vector<double> &coverage)
{
  using Vector                = dealii::TrilinosWrappers::MPI::Vector;
  const MPI_Comm communicator = space.grid.communicator();
  Vector         owned(space.owned(), communicator); // at nodes of cells that are inside
  for (unsigned int a = 0; a < coverage.size(); ++a)
    if (coverage[a] >= 0.5)
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        owned(space.nodes(a)[i]) += 1.;
  owned.compress(dealii::VectorOperation::add);
  Vector inside(space.owned(), space.relevant(), communicator);
  inside = owned;
  std::vector<bool> result(coverage.size(), false);
  for (unsigned int a = 0; a < coverage.size(); ++a)
    if (coverage[a] > 0. && coverage[a] < 0.5)
      result[a] = std::any_of(space.nodes(a), space.nodes(a) + space.basis.n_nodes,
                              [&](const DofIndex node) { return inside(node) > 0.; });
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                           \
  template void set_coverage(const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, \
                             const Body<dim> &, const BoundaryRegion<dim> &,             \
                             const Kinematics<dim> &, std::vector<double> &);            \
  template std::vector<bool> outer_edge(const DisplacementSpace<dim> &,                  \
                                        const std::vector<double> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
