#pragma once

#include <scree/material/material.h>

namespace scree
{
/**
 * Isotropic linear elasticity (Hooke), plane strain for dim == 2:
 *
 *     sigma = lambda tr(eps) I + 2 mu eps,        psi = lambda/2 tr(eps)^2 + mu eps : eps,
 *     lambda = E nu/((1 + nu)(1 - 2 nu)),         mu = E/(2 (1 + nu)).
 */
template <int dim>
class LinearElastic : public Material<dim>
{
public:
  /** Uses young, poisson and density of `parameters`, which make_material() has checked. */
  explicit LinearElastic(const MaterialParameters &parameters);

  dealii::SymmetricTensor<2, dim>
  stress(const dealii::SymmetricTensor<2, dim> &strain) const override;

  dealii::SymmetricTensor<4, dim>
  tangent(const dealii::SymmetricTensor<2, dim> &strain) const override;

  double energy_density(const dealii::SymmetricTensor<2, dim> &strain) const override;

  double out_of_plane_stress(const dealii::SymmetricTensor<2, dim> &strain) const override;

  bool is_linear() const override;

  double lame_lambda() const override;

  double shear_modulus() const override;

private:
  double lambda;
  double mu;
};
} // namespace scree
