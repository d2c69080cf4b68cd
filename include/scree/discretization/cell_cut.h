#pragma once

#include <scree/discretization/lagrange.h>
#include <scree/discretization/polytope.h>
#include <scree/geometry/shape.h>

#include <array>
#include <vector>

namespace scree
{
/** Where a cell lies with respect to a body. */
enum class CellLocation : unsigned char
{
  outside,
  inside,
  cut
};

/**
 * How a body lies in a cell. Where its surface is one smooth piece, that is a level set of degree
 * k; where pieces meet, or a flat piece lies on a face of the cell, the body is a set of convex
 * parts, whose facets know whether they belong to the surface.
 */
template <int dim>
struct CellCut
{
  CellLocation location = CellLocation::outside;
  /** phi/h at the nodes, without zeros; of a cut cell without parts. */
  std::array<double, max_nodes_per_cell<dim>> scaled;
  std::vector<Polytope<dim>>                  parts;
};

/**
 * phi/h for cutting: values with |phi| < 1e-12 h are moved to +1e-12, so that a contour on a grid
 * line is cut exactly once, from the inside, without slivers.
 */
void nudge(const double *values, const unsigned int n, const double cell_size, double *scaled);

/** Where a cell lies by the signs of its nodal values. */
CellLocation location_of(const double *scaled, const unsigned int n);

/**
 * The cut of a cell by a shape, exact where the pieces of the shape are planes: each piece that
 * passes through the cell becomes a plane, the mean linear function of its values at the vertices;
 * the planes divide the cell into convex parts, which lie inside where the shape is negative in
 * their middle. A facet between a part inside and one outside is surface; beyond a face of the cell
 * the shape next to it decides, so that a surface on a grid plane belongs to the cell inside.
 *
 * @param nodes of the cell, of basis.n_nodes, at the start of the run [L]
 * @param cell_size edge of the cell [L]
 */
template <int dim>
CellCut<dim> cut_by_pieces(const Shape<dim> &shape, const LagrangeBasis<dim> &basis,
                           const std::vector<dealii::Point<dim>> &nodes, const double cell_size);
} // namespace scree
