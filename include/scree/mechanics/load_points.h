#pragma once

#include <scree/mechanics/boundary_regions.h>

#include <functional>

namespace scree
{
/**
 * Moves a point of the cut surface to the exact boundary next to it, with the normal and the share
 * of the area there: the foot y of x on the nearest smooth piece, dS by differences of y(x) along
 * the cut. Integrals of loads then have the error of the quadrature rule, not that of the cut,
 * O(h^2) for level sets of degree 1. Nothing changes on planes.
 */
template <int dim>
void move_to_boundary(const Shape<dim> &shape, const GridCell<dim> &cell,
                      BoundaryPoint<dim> &point);

/**
 * Points, with weights of either sign, of the strip between the edge of the cut {phi < 0} on a face
 * of a cell and that of the exact shape there: on the edge of the cut, half-way to the exact one.
 */
template <int dim>
CellPoints<dim> strip_on_face(const Shape<dim> &shape, const CutCellRules<dim> &rules,
                              const GridCell<dim> &cell, const CellCut<dim> &cut,
                              const unsigned int face);

/**
 * The points of a load in a cell, those of the cut surface or on a face of the cell: where
 * `selects` (position [L]) ends among them, the surface is halved until the part that holds the end
 * is small, 2^-10 of the cell in 2D, 2^-5 in 3D.
 * @param face    of the cell, no_face: the cut surface
 * @param shape   whose exact boundary `selects` sees; null: it sees the cut
 * @param selects none: all is selected
 */
template <int dim>
CellPoints<dim> load_rule(CutCellRules<dim> &rules, const GridCell<dim> &cell,
                          const Shape<dim> *shape, const CellCut<dim> &cut, const unsigned int face,
                          const std::function<bool(const dealii::Point<dim> &)> &selects);
} // namespace scree
