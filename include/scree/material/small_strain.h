#pragma once

#include <scree/material/increment_response.h>
#include <scree/material/isotropic.h>
#include <scree/material/logarithmic_strain.h>

namespace scree
{
/**
 * Small-strain isotropic law in increments, elastic or, with a finite yield stress, J2 plastic:
 *
 *     sigma^tr = sigma_n + lambda tr(de) I + 2 mu de,    de = sym(F_D - I),    P = sigma,
 *
 * and sigma the RadialReturn of the trial stress. No geometric terms; `F_D = I + grad du`.
 */
class SmallStrain
{
public:
  static constexpr InternalTensor internal = InternalTensor::cauchy_stress;

  struct Point : KirchhoffStress
  {
    static constexpr bool is_geometric = false;

    explicit Point(const RadialReturn &flow);

    /** Change of the stress with `d grad du = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    RadialReturn    flow;
    IsotropicModuli moduli;
  };

  SmallStrain(const IsotropicModuli &moduli, const Hardening &hardening);

  /** The point after the increment `F_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
  Hardening       hardening;
};

/**
 * The same law for small strains and large rotations: the old stress turns with the rotation `R` of
 * the increment, `F_D = V R`,
 *
 *     sigma^tr = R sigma_n R^T + lambda tr(de) I + 2 mu de,    de = ln V,
 *     P        = J_D sigma F_D^{-T}.
 *
 * A rotation of the whole increment turns sigma and leaves everything else as it is. The law has no
 * stored energy that its stress derives from (a closed path at large strain may do work); the
 * energy given is that of the stress, `sigma : eps(sigma)/2`, per volume.
 */
class SmallStrainRotated
{
public:
  static constexpr InternalTensor internal = InternalTensor::cauchy_stress;

  struct Point : KirchhoffStress
  {
    static constexpr bool is_geometric = true;

    Point(const LogarithmicStrain &strain, const PolarRotation &rotation, const RadialReturn &flow);

    /** `d(J_D sigma)` for `l = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    LogarithmicStrain    strain;
    PolarRotation        rotation;
    RadialReturn         flow;
    dealii::Tensor<2, 3> rotated_stress; // R sigma_n R^T
    IsotropicModuli      moduli;
    double               J_D = 1;
  };

  SmallStrainRotated(const IsotropicModuli &moduli, const Hardening &hardening);

  /** The point after the increment `F_D` of the determinant `J_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
  Hardening       hardening;
};
} // namespace scree
