#pragma once

#include <scree/mechanics/boundary_term.h>

namespace scree
{
/**
 * Conditions that are tractions: int t . v over their regions with t of their SurfaceLaw. Dead
 * loads are loads; what depends on u is a matrix and the loads t(u_n); what follows the surface is
 * no load but forces and a tangent.
 */
template <int dim>
class SurfaceTractions : public BoundaryTerm<dim>
{
public:
  using typename BoundaryTerm<dim>::Vector;
  using typename BoundaryTerm<dim>::Matrix;
  using BoundaryTerm<dim>::BoundaryTerm;

  void add_to_matrix(Matrix &matrix) const override;

  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const override;

  bool is_linear() const override;

  void add_internal_forces(const PointEvaluator<dim> &u, const double time,
                           Vector &forces) const override;

  void add_tangent(const PointEvaluator<dim> &u, const double time, Matrix &matrix) const override;

  bool is_symmetric() const override;

  std::vector<dealii::Tensor<1, dim>> tractions(const unsigned int         region,
                                                const PointEvaluator<dim> &u,
                                                const double               time) const override;

  double energy(const PointEvaluator<dim> &u, const double time) const override;

private:
  /** The law's answer at the points of a region; u null: at the start of the step. */
  std::vector<SurfaceTraction<dim>> evaluate(const unsigned int         region,
                                             const PointEvaluator<dim> *u, const double time) const;
  /** Adds factor int t . v over a region. */
  void add_integral(const unsigned int region, const double factor,
                    const std::vector<SurfaceTraction<dim>> &tractions, Vector &forces) const;
};
} // namespace scree
