#include <scree/grid/cell_bodies.h>

namespace scree
{
namespace
{
/** The cell and what lies within `reach` of it. */
template <int dim>
dealii::BoundingBox<dim>
enlarged(const typename CellBodies<dim>::Cell &cell, const double reach)
{
  dealii::BoundingBox<dim> result(
    {cell->vertex(0), cell->vertex(dealii::GeometryInfo<dim>::vertices_per_cell - 1)});
  result.extend(reach);
  return result;
}

template <int dim>
double
edge(const typename CellBodies<dim>::Cell &cell)
{
  return cell->vertex(1)[0] - cell->vertex(0)[0];
}
} // namespace

template <int dim>
CellBodies<dim>::CellBodies(const std::vector<Body<dim>> &bodies)
    : boxes(bodies)
{
}

template <int dim>
CellBodies<dim>::CellBodies(const BodyBoxes<dim> &boxes)
    : boxes(boxes)
{
}

template <int dim>
void
CellBodies<dim>::visit(const Triangulation &grid, const Reach &reach, const Visit &visit) const
{
  std::vector<std::vector<unsigned int>> near(grid.n_levels());
  for (const Cell &cell : grid.cell_iterators_on_level(0))
    {
      boxes.find(enlarged<dim>(cell, reach(edge<dim>(cell))), near[0]);
      descend(cell, reach, visit, near);
    }
}

template <int dim>
void
CellBodies<dim>::descend(const Cell &cell, const Reach &reach, const Visit &visit,
                         std::vector<std::vector<unsigned int>> &near) const
{
  const std::vector<unsigned int> &here = near[cell->level()];
  if (here.empty())
    return;
  if (cell->is_active())
    {
      if (cell->is_locally_owned())
        visit(cell, here);
      return;
    }
  const double child_reach = reach(0.5 * edge<dim>(cell));
  for (unsigned int c = 0; c < cell->n_children(); ++c)
    {
      const Cell child = cell->child(c);
      if (child->is_active() && !child->is_locally_owned())
        continue;
      const auto                 box        = enlarged<dim>(child, child_reach);
      std::vector<unsigned int> &near_child = near[child->level()];
      near_child.clear();
      for (const unsigned int body : here)
        if (box.get_neighbor_type(boxes.box(body)) != dealii::NeighborType::not_neighbors)
          near_child.push_back(body);
      descend(child, reach, visit, near);
    }
}

template class CellBodies<2>;
template class CellBodies<3>;
} // namespace scree
