#pragma once

#include <scree/material/increment_response.h>
#include <scree/material/isotropic.h>

namespace scree
{
/**
 * Saint Venant-Kirchhoff law, with `E = (F^T F - I)/2` and `b = F F^T = F_D b_n F_D^T`:
 *
 *     psi = lambda/2 (tr E)^2 + mu E : E,
 *     tau = F (lambda tr(E) I + 2 mu E) F^T = lambda tr(e) b + 2 mu e b,    e = (b - I)/2.
 *
 * It softens in compression (the force on a bar has a maximum at the stretch 1/sqrt(3)): it serves
 * comparisons with other programs, at moderate strain.
 */
class SaintVenantKirchhoff
{
public:
  static constexpr InternalTensor internal = InternalTensor::none;

  struct Point : KirchhoffStress
  {
    static constexpr WorkOf work = WorkOf::current;

    /** `lambda (tr(db)/2 b + tr(e) db) + mu (db b + b db - db)`, `db = l b + b l^T`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    dealii::Tensor<2, 3> b;
    IsotropicModuli      moduli;
  };

  explicit SaintVenantKirchhoff(const IsotropicModuli &moduli);

  /** The point after the increment `F_D` of the determinant `J_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
};
} // namespace scree
