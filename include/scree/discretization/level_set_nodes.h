#pragma once

#include <scree/discretization/lagrange.h>
#include <scree/grid/background_grid.h>
#include <scree/level_set/lattice.h>

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
 * Level sets as the finite element functions of degree k that quadrature and gaps use: nodal values
 * per cell, taken from a lattice at the cell's support points; hanging nodes are interpolated from
 * the coarser neighbour, so that contours stay closed (method.md section 4).
 */
template <int dim>
class LevelSetNodes
{
public:
  LevelSetNodes(const BackgroundGrid<dim> &grid, const unsigned int degree);

  /** Nodal values phi [L] of an owned cell, lexicographic, un-nudged. */
  void cell_values(const unsigned int cell, const Lattice<dim> &lattice, double *values) const;

  /**
   * phi/h for cutting: values with |phi| < 1e-12 h are moved to +1e-12, so that a contour on a grid
   * line is cut exactly once, from the inside, without slivers.
   */
  void nudged(const double *values, const double cell_size, double *scaled) const;

  /** Where an owned cell lies with respect to the body of `lattice`. */
  CellLocation classify(const unsigned int cell, const Lattice<dim> &lattice) const;

  const LagrangeBasis<dim> &basis() const
  {
    return lagrange;
  }

private:
  /** A hanging node of a cell and the points that determine it. */
  struct HangingNode
  {
    unsigned int                                       node;
    std::vector<std::pair<dealii::Point<dim>, double>> masters;
  };

  const BackgroundGrid<dim>            &grid;
  LagrangeBasis<dim>                    lagrange;
  std::vector<std::vector<HangingNode>> hanging; //!< per owned cell, mostly empty
};
} // namespace scree
