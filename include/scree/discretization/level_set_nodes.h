#pragma once

#include <scree/discretization/cut_cell_rules.h>
#include <scree/grid/background_grid.h>
#include <scree/level_set/lattice.h>

#include <vector>

namespace scree
{
/**
 * Level sets as the finite element functions that quadrature and gaps use, of a degree of their
 * own, which need not be that of the displacement: nodal values per cell, taken from a lattice at
 * the cell's support points; hanging nodes are interpolated from the coarser neighbour, so that
 * contours stay closed (theory.md section 4).
 */
template <int dim>
class LevelSetNodes
{
public:
  LevelSetNodes(const BackgroundGrid<dim> &grid, const unsigned int degree,
                const GaussPoints gauss);

  /** Nodal values phi [L] of an owned cell, lexicographic, un-nudged. */
  void cell_values(const unsigned int cell, const Lattice<dim> &lattice, double *values) const;

  /**
   * The same of a body as another one in the direction `towards` sees it: where the nearest parts
   * of the boundary look away from there, as the far side of a thin body does, the value is that of
   * the pieces which do not; behind the body, farther than half a cell, nothing is seen.
   */
  void facing_values(const unsigned int cell, const Body<dim> &body,
                     const dealii::Tensor<1, dim> &towards, double *values) const;

  /** phi/h for cutting, see nudge(). */
  void nudged(const double *values, const double cell_size, double *scaled) const;

  /**
   * How a body lies in an owned cell: by its exact shape where that has kinks or several pieces,
   * else by its level set.
   */
  CellCut<dim> cut(const unsigned int cell, const Body<dim> &body) const;

  const GaussPoints &gauss() const
  {
    return gauss_points;
  }

  /** The rules that integrate on such cuts. */
  CutCellRules<dim> rules() const
  {
    return CutCellRules<dim>(lagrange, gauss_points);
  }

  const LagrangeBasis<dim> &basis() const
  {
    return lagrange;
  }

private:
  /** Where the material at the nodes of a cell was at the start: where the shape sees them. */
  std::vector<dealii::Point<dim>> initial_nodes(const unsigned int cell,
                                                const Body<dim>   &body) const;

  /** A hanging node of a cell and the points that determine it. */
  struct HangingNode
  {
    unsigned int                                       node;
    std::vector<std::pair<dealii::Point<dim>, double>> masters;
  };

  const BackgroundGrid<dim>            &grid;
  LagrangeBasis<dim>                    lagrange;
  GaussPoints                           gauss_points;
  std::vector<std::vector<HangingNode>> hanging; //!< per owned cell, mostly empty
};
} // namespace scree
