#pragma once

#include <scree/mechanics/bulk.h>

namespace scree
{
/**
 * The linear elastic bulk in the total displacement: int sigma(u) : grad v, all of it a matrix. The
 * part of lambda that acts on the projected divergence is projected_lambda().
 */
template <int dim>
class LinearBulk : public Bulk<dim>
{
public:
  using typename Bulk<dim>::Matrix;
  using typename Bulk<dim>::Work;

  LinearBulk(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
             const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts);

  void add_to_matrix(Matrix &matrix) const override;

  bool is_linear() const override
  {
    return true;
  }

  Work work(const PointEvaluator<dim> &u) const override;

  /** The strain is the small one, sym(grad u) with the projected divergence, J = 1 + div u. */
  BulkSample<dim> sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const PointEvaluator<dim> &u) const override;

private:
  void cell_stiffness(const unsigned int active_cell, dealii::FullMatrix<double> &matrix) const;
  /** Adds lambda int (projected div u) (projected div v). */
  void add_projected_stiffness(const unsigned int active_cell, const double lambda,
                               dealii::FullMatrix<double> &matrix) const;

  using Bulk<dim>::bodies;
  using Bulk<dim>::space;
};
} // namespace scree
