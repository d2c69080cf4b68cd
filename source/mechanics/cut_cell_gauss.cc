#include <scree/mechanics/cut_cell_gauss.h>
#include <scree/mechanics/cut_cell_rule.h>
#include <scree/mechanics/material_update.h>

namespace scree
{
template <int dim>
CutCellGauss<dim>::CutCellGauss(const DisplacementSpace<dim> &space,
                                const CutQuadrature<dim>     &quadrature,
                                const std::vector<Body<dim>> &bodies, const StepStart<dim> &start)
    : BulkQuadrature<dim>(space, bodies)
    , quadrature(quadrature)
    , start(start)
{
  this->tabulate();
}

template <int dim>
CellRule<dim>
CutCellGauss<dim>::rule(const unsigned int active_cell) const
{
  return cut_cell_rule(this->space, quadrature, active_cell);
}

template <int dim>
std::vector<PointHistory<dim>>
CutCellGauss<dim>::histories(const std::vector<PointInCell<dim>> &points) const
{
  return start.histories(points);
}

template <int dim>
MaterialPoints<dim>
CutCellGauss<dim>::moved(const MaterialPoints<dim> &points, const IncrementalBulk<dim> &bulk,
                         const PointEvaluator<dim> &u) const
{
  std::vector<PointHistory<dim>> histories;
  for (std::size_t p = 0; p < points.size(); ++p)
    histories.push_back(start.history_of_material_point(p));
  return moved_points<dim>(points, start.material_points(), histories, this->bodies, bulk, u,
                           start.gradients_are_of_cloud());
}

template class CutCellGauss<2>;
template class CutCellGauss<3>;
} // namespace scree
