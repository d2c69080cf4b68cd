#pragma once

#include <scree/mechanics/bulk.h>
#include <scree/mechanics/normal_moments.h>

#include <vector>

namespace scree
{
/**
 * Displacements prescribed by Nitsche's method or by a penalty (theory.md section 7): what is the
 * same whatever the stress vector sigma n is. The adjoint term has the elastic moduli at zero
 * strain.
 */
template <int dim>
class PrescribedDisplacements : public BoundaryTerm<dim>
{
public:
  using typename BoundaryTerm<dim>::Vector;
  using typename BoundaryTerm<dim>::Matrix;

  /** @param stress_is_linear whether sigma n is that of linear elasticity, a part of the matrix;
   *                         else the derived class adds its forces */
  PrescribedDisplacements(const BoundarySetting<dim>      &setting,
                          const std::vector<unsigned int> &own_regions,
                          const bool                       stress_is_linear);

  /** Penalties, the adjoint term and sigma n if it is linear. */
  void add_to_matrix(Matrix &matrix) const override;

  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const override;

  bool is_symmetric() const override;

  /** sigma n - beta (u - ubar) on the prescribed components, and that of the moments. */
  std::vector<dealii::Tensor<1, dim>> tractions(const unsigned int         region,
                                                const PointEvaluator<dim> &u,
                                                const double               time) const override;

  double energy(const PointEvaluator<dim> &u, const double time) const override;

protected:
  /** sigma n at the points of a region of Nitsche's method. */
  virtual std::vector<dealii::Tensor<1, dim>> fluxes(const unsigned int         region,
                                                     const PointEvaluator<dim> &u) const = 0;

  /** sigma(N_a e_i) n of linear elasticity for all unknowns of the cell at a point. */
  void stress_vectors(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                      ShapeValues<dim> &shape, std::vector<dealii::Tensor<1, dim>> &vectors) const;

  using BoundaryTerm<dim>::space;
  using BoundaryTerm<dim>::own_regions;
  using BoundaryTerm<dim>::setting;
  const std::vector<Body<dim>> &bodies;
  const Bulk<dim>              &bulk;

private:
  /** Sign of the adjoint term times the flow ratio in the cell of a point. */
  double adjoint_factor(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point) const;

  const bool                  stress_is_linear;
  const NitscheStiffness<dim> stiffness;
  const PrescribedValues<dim> prescribed_value;
  const NormalMoments<dim>    moments;
};
} // namespace scree
