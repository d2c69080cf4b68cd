#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/point_evaluator.h>

#include <vector>

namespace scree
{
/**
 * The divergence of displacements projected on VolumeModes of each cell, P div u = sum_m psi_m int
 * psi_m div u: the linear volume change of bodies that would lock (theory.md section 7).
 */
template <int dim>
class ProjectedDivergence
{
public:
  /** @param is_projected by body; collective */
  ProjectedDivergence(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                      const std::vector<bool> &is_projected);

  /** Its coefficients at a point of a projected body: of the unknowns of the cell, component by
   * component of node after node [1/L]. */
  std::vector<double> coefficients(const PointInCell<dim> &point) const;

  /** Its value at a point of a projected body. */
  double value(const PointInCell<dim> &point, const PointEvaluator<dim> &u) const;

private:
  /** int f_j div u of a cell, and the factor of these rows. */
  std::pair<const double *, double> rows_of(const unsigned int active_cell) const;

  const DisplacementSpace<dim> &space;
  /** int f_j div u of cut active cells, as far as projected on the functions of VolumeModes. */
  std::vector<double>      rows;
  std::vector<std::size_t> first_row;  //!< of each active cell
  std::vector<double>      whole_rows; //!< of whole cells of unit edge
};

/** Sends a list of numbers of every active cell of the owners to their ghosts (collective). */
template <int dim>
void exchange_to_ghosts(const DisplacementSpace<dim>     &space,
                        std::vector<std::vector<double>> &of_cells);
} // namespace scree
