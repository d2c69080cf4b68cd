#pragma once

#include <scree/material/increment_response.h>
#include <scree/material/isotropic.h>
#include <scree/material/logarithmic_strain.h>

namespace scree
{
/**
 * Hencky's law, elastic: with `eps = 1/2 ln b` and `b = F F^T = F_D b_n F_D^T`
 *
 *     psi = lambda/2 (tr eps)^2 + mu eps : eps,    tau = lambda tr(eps) I + 2 mu eps.
 *
 * There is no plastic part; HenckyPlasticity has it.
 */
class Hencky
{
public:
  static constexpr InternalTensor internal = InternalTensor::none;

  struct Point : KirchhoffStress
  {
    static constexpr WorkOf work = WorkOf::current;

    explicit Point(const LogarithmicStrain &strain);

    /** `lambda tr(d eps) I + 2 mu d eps` for `l = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    LogarithmicStrain strain;
    IsotropicModuli   moduli;
  };

  explicit Hencky(const IsotropicModuli &moduli);

  /** The point after the increment `F_D` of the determinant `J_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
};

/**
 * Multiplicative J2 plasticity in logarithmic strains with linear isotropic hardening: Hencky's
 * law gives the trial stress of `b_e^tr = F_D b_e,n F_D^T`, RadialReturn the stress and with it
 * the elastic strain `1/2 ln b_e`. Carried is the plastic metric `C_p^{-1} = F^{-1} b_e F^{-T}`,
 * which neither elastic increments nor rotations change. The flow is isochoric, `det C_p = 1`.
 *
 *     psi = lambda/2 (tr eps_e)^2 + mu eps_e : eps_e + H/2 alpha^2
 *
 * Source: J.C. Simo, Comput. Methods Appl. Mech. Engrg. 99 (1992) 61-112.
 */
class HenckyPlasticity
{
public:
  static constexpr InternalTensor internal = InternalTensor::plastic_metric;

  struct Point : KirchhoffStress
  {
    static constexpr WorkOf work = WorkOf::current;

    Point(const LogarithmicStrain &trial_strain, const RadialReturn &flow);

    /** The RadialReturn::derivative of that of the trial stress, for `l = e_k (x) f`. */
    dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

    LogarithmicStrain trial_strain;
    RadialReturn      flow;
    IsotropicModuli   moduli;
  };

  HenckyPlasticity(const IsotropicModuli &moduli, const Hardening &hardening);

  /** The point after the increment `F_D` of the determinant `J_D`. */
  Point at(const dealii::Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const;

private:
  IsotropicModuli moduli;
  Hardening       hardening;
};
} // namespace scree
