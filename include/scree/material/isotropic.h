#pragma once

#include <deal.II/base/tensor.h>

#include <limits>

namespace scree
{
/** Isotropic elastic moduli and the linear relation of a stress to an elastic strain. */
struct IsotropicModuli
{
  double lambda = std::numeric_limits<double>::quiet_NaN(); // Lame's first constant
  double mu     = std::numeric_limits<double>::quiet_NaN(); // shear modulus

  /** lambda counts up to this multiple of mu, that is up to nu = 0.4, where it does not lock. */
  static constexpr double largest_ratio = 4.;

  /**
   * What of the volumetric stiffness lambda + 2 mu/dim acts on projected volume changes: the part
   * of lambda beyond 4 mu, a share from 0 (nu <= 0.4) to 1.
   */
  double projected_share(const unsigned int dim) const;

  /** `lambda = E nu/((1 + nu)(1 - 2 nu))`, `mu = E/(2 (1 + nu))`. */
  static IsotropicModuli from_young(const double young, const double poisson);

  /** `lambda tr(eps) I + 2 mu eps` of a symmetric strain. */
  dealii::Tensor<2, 3> stress(const dealii::Tensor<2, 3> &strain) const;

  /** The strain of a stress, `(sigma - lambda/(3 lambda + 2 mu) tr(sigma) I)/(2 mu)`. */
  dealii::Tensor<2, 3> strain(const dealii::Tensor<2, 3> &stress) const;

  /** `sigma : eps(sigma)/2`. */
  double energy(const dealii::Tensor<2, 3> &stress) const;
};

/** Linear isotropic hardening: the yield stress is `yield_stress + modulus alpha`. */
struct Hardening
{
  double yield_stress = std::numeric_limits<double>::infinity(); // infinite: elastic
  double modulus      = 0;                                       // H >= 0

  /** Energy stored by hardening, `H alpha^2/2`. */
  double energy(const double alpha) const;
};

/**
 * Radial return of a trial stress to the von Mises cylinder with linear isotropic hardening, at
 * small strain or, with the Kirchhoff stress of logarithmic strains, at finite strain:
 *
 *     f      = |dev tau^tr| - sqrt(2/3) (sigma_y + H alpha_n),    n = dev tau^tr/|dev tau^tr|,
 *     dgamma = <f>/(2 mu + 2 H/3),    tau = tau^tr - 2 mu dgamma n,
 *     alpha  = alpha_n + sqrt(2/3) dgamma.
 *
 * Source: J.C. Simo and T.J.R. Hughes, Computational Inelasticity (1998), box 3.1 and section 9.3.
 */
class RadialReturn
{
public:
  RadialReturn(const dealii::Tensor<2, 3> &trial_stress, const double alpha, const double mu,
               const Hardening &hardening);

  /** Stress on or inside the yield surface. */
  dealii::Tensor<2, 3> stress;

  /** Equivalent plastic strain at the end. */
  double alpha;

  /** `sigma_y (alpha - alpha_n)`. */
  double dissipation = 0;

  /**
   * Change of the stress with that of the trial stress, with `theta = 1 - 2 mu dgamma/|dev
   * tau^tr|`:
   *
   *     d tau = d tau^tr - (1 - theta) dev d tau^tr - (theta - H/(3 mu + H)) n (n : d tau^tr).
   */
  dealii::Tensor<2, 3> derivative(const dealii::Tensor<2, 3> &trial_change) const;

private:
  dealii::Tensor<2, 3> direction;      // n, zero in an elastic increment
  double               reduction  = 0; // 1 - theta
  double               along_flow = 0; // theta - H/(3 mu + H)
};
} // namespace scree
