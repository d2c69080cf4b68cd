#pragma once

#include <scree/bodies/broad_phase.h>

#include <deal.II/distributed/tria.h>

#include <functional>
#include <vector>

namespace scree
{
/**
 * Who is where: walks down the trees of the grid and keeps, from parent to child, the bodies whose
 * boxes come near the cell, so that the work is proportional to the cells and the bodies near them
 * and not to their product.
 */
template <int dim>
class CellBodies
{
public:
  using Triangulation = dealii::parallel::distributed::Triangulation<dim>;
  using Cell          = typename Triangulation::cell_iterator;

  /** What comes within this distance of a cell of the given edge is near; must grow with it. */
  using Reach = std::function<double(const double size)>;

  /** @param bodies in ascending order */
  using Visit = std::function<void(const Cell &cell, const std::vector<unsigned int> &bodies)>;

  explicit CellBodies(const std::vector<Body<dim>> &bodies);
  explicit CellBodies(const BodyBoxes<dim> &boxes);

  /** Visits the owned active cells that have bodies near. */
  void visit(const Triangulation &grid, const Reach &reach, const Visit &visit) const;

private:
  /** `near`: level by level, the bodies near the cell's ancestors and the cell. */
  void descend(const Cell &cell, const Reach &reach, const Visit &visit,
               std::vector<std::vector<unsigned int>> &near) const;

  BodyBoxes<dim> boxes;
};
} // namespace scree
