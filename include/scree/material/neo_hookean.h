#pragma once

#include <scree/material/increment_response.h>
#include <scree/material/isotropic.h>

namespace scree
{
/**
 * Compressible neo-Hookean law, with `C = F^T F`, `b = F F^T = F_D b_n F_D^T` and `J = det F`:
 *
 *     psi = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2,
 *     tau = mu (b - I) + lambda ln J I.
 */
class NeoHookean
{
public:
  static constexpr InternalTensor internal = InternalTensor::none;

  struct Point : KirchhoffStress
  {
    static constexpr WorkOf work = WorkOf::current;

    /** `mu (l b + b l^T) + lambda tr(l) I` for `l = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    dealii::Tensor<2, 3> b;
    IsotropicModuli      moduli;
  };

  explicit NeoHookean(const IsotropicModuli &moduli);

  /** The point after the increment `F_D` of the determinant `J_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
};
} // namespace scree
