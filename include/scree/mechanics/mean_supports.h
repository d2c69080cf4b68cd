#pragma once

#include <scree/mechanics/boundary_term.h>

namespace scree
{
/**
 * Means of displacement components or of the rotation over regions, held by a multiplier each: its
 * row, times multiplier_scale(), says int u_c = int ubar_c, of the rotation about the centre
 * int (x u_y - y u_x) = int (x^2 + y^2) ubar.
 */
template <int dim>
class MeanSupports : public BoundaryTerm<dim>
{
public:
  using typename BoundaryTerm<dim>::Vector;
  using typename BoundaryTerm<dim>::Matrix;
  using BoundaryTerm<dim>::BoundaryTerm;

  void add_to_matrix(Matrix &matrix) const override;

  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const override;

  std::vector<std::vector<DofIndex>> couplings() const override;

  Resultant<dim> resultant_of_multipliers(const unsigned int         region,
                                          const PointEvaluator<dim> &u) const override;

private:
  /** Row `m` of a region: coefficients of the cell's unknowns at a point. */
  void   mean_row(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                  const unsigned int m, std::vector<double> &row) const;
  double multiplier_scale(const BoundaryRegion<dim> &region) const;
};
} // namespace scree
