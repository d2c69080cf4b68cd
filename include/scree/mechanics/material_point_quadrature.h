#pragma once

#include <scree/mechanics/bulk_quadrature.h>
#include <scree/mechanics/step_start.h>

#include <vector>

namespace scree
{
/**
 * The material points as quadrature points, int f = sum_p V_p f(x_p) with V_p = det F_p V_0, as in
 * the material point method (Chen et al. 2017, section 3): each asks its law with the F_p and the
 * internal variables that it carries, so that nothing is transferred between steps. Surfaces have
 * points of their own; their histories are those of CutCellGauss. A point that has left the cells
 * of its body for those of another process does not count.
 */
template <int dim>
class MaterialPointQuadrature : public BulkQuadrature<dim>
{
public:
  /** Collective. */
  MaterialPointQuadrature(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                          const StepStart<dim> &start);

  CellRule<dim> rule(const unsigned int active_cell) const override;

  std::vector<PointHistory<dim>>
  histories(const std::vector<PointInCell<dim>> &points) const override;

  MaterialPoints<dim> moved(const MaterialPoints<dim> &points, const IncrementalBulk<dim> &bulk,
                            const PointEvaluator<dim> &u) const override;

private:
  std::vector<PointHistory<dim>>
  histories_of_rules(const std::vector<PointInCell<dim>> &points) const override;

  const StepStart<dim>           &start;
  std::vector<std::size_t>        points; //!< numbers of material points, cell after cell
  std::vector<std::size_t>        begin;  //!< of owned cells in `points`, and their end
  std::vector<dealii::Point<dim>> places; //!< of `points` in unit coordinates
  std::vector<double>             volumes;
};
} // namespace scree
