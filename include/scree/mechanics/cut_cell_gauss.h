#pragma once

#include <scree/mechanics/bulk_quadrature.h>
#include <scree/mechanics/step_start.h>

namespace scree
{
/** Gauss points of the cut cells; material points bring the histories and take them on. */
template <int dim>
class CutCellGauss : public BulkQuadrature<dim>
{
public:
  /** Collective. */
  CutCellGauss(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
               const std::vector<Body<dim>> &bodies, const StepStart<dim> &start);

  CellRule<dim> rule(const unsigned int active_cell) const override;

  std::vector<PointHistory<dim>>
  histories(const std::vector<PointInCell<dim>> &points) const override;

  MaterialPoints<dim> moved(const MaterialPoints<dim> &points, const IncrementalBulk<dim> &bulk,
                            const PointEvaluator<dim> &u) const override;

private:
  const CutQuadrature<dim> &quadrature;
  const StepStart<dim>     &start;
};
} // namespace scree
