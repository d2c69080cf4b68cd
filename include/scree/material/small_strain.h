#pragma once

#include <scree/material/increment_response.h>
#include <scree/material/isotropic.h>
#include <scree/material/logarithmic_strain.h>

namespace scree
{
/** The answer of a law whose stress is linear in the gradient and works on one configuration. */
template <WorkOf configuration>
struct LinearPoint : KirchhoffStress
{
  static constexpr WorkOf work = configuration;

  /** Change of the stress with a change `e_k (x) f` of the gradient. */
  dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

  IsotropicModuli moduli;
};

/**
 * The linear theory in total strains, `sigma = lambda tr(eps) I + 2 mu eps` with `eps = sym(F -
 * I)`. The stress works on the reference configuration; the energy is per volume of it.
 */
class SmallStrain
{
public:
  static constexpr InternalTensor internal = InternalTensor::none;

  using Point = LinearPoint<WorkOf::reference>;

  explicit SmallStrain(const IsotropicModuli &moduli);

  /** The point after the increment `F_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
};

/**
 * Linear elasticity in increments on the configuration at the start of each step,
 * `sigma = sigma_n + lambda tr(de) I + 2 mu de` with `de = sym(F_D - I)`.
 */
class SmallStrainIncremental
{
public:
  static constexpr InternalTensor internal = InternalTensor::cauchy_stress;

  using Point = LinearPoint<WorkOf::start>;

  explicit SmallStrainIncremental(const IsotropicModuli &moduli);

  /** The point after the increment `F_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
};

/**
 * J2 plasticity of the linear theory in total strains:
 *
 *     eps = sym(F - I),    sigma^tr = lambda tr(eps) I + 2 mu (eps - eps_p,n),
 *
 * sigma the RadialReturn of the trial stress and `eps_p = eps_p,n + (sigma^tr - sigma)/(2 mu)`. The
 * stress works on the reference configuration; the energy is per volume of it.
 */
class SmallStrainPlasticity
{
public:
  static constexpr InternalTensor internal = InternalTensor::plastic_strain;

  struct Point : KirchhoffStress
  {
    static constexpr WorkOf work = WorkOf::reference;

    explicit Point(const RadialReturn &flow);

    /** Change of the stress with `dF = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    RadialReturn    flow;
    IsotropicModuli moduli;
  };

  SmallStrainPlasticity(const IsotropicModuli &moduli, const Hardening &hardening);

  /** The point after the increment `F_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
  Hardening       hardening;
};

/**
 * Elasticity or J2 plasticity at small strains and large rotations: the old stress turns with the
 * rotation `R` of the increment, `F_D = V R`,
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
    static constexpr WorkOf work = WorkOf::current;

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
