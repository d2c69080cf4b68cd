#pragma once

#include <scree/material/isotropic.h>
#include <scree/material/material.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
/**
 * What a material point carries from step to step. Tensors with three rows also exist in two
 * dimensions, where the strain is plane: the out-of-plane components are part of the state.
 */
template <int dim>
struct PointHistory
{
  /** Deformation gradient `F` against the reference configuration [-]. */
  dealii::Tensor<2, dim> deformation_gradient
    = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());

  /** What IncrementLaw::internal() says; zero at the start of a run. */
  dealii::SymmetricTensor<2, 3> internal;

  /** Equivalent plastic strain `alpha >= 0` [-]. */
  double alpha = 0;
};

/** The history of a point in the form that every Newton iteration of the step uses. */
struct IncrementStart
{
  /** What the law carries: see IncrementLaw::start(). */
  dealii::Tensor<2, 3> tensor;

  /** `F_n`, in plane strain with the out-of-plane stretch 1 [-]. */
  dealii::Tensor<2, 3> deformation_gradient;

  /** `J_n`: volume at the start of the step per reference volume; 1 for laws that carry sigma. */
  double volume_ratio = 1;

  /** `alpha_n`, not negative. */
  double alpha = 0;
};

/** What an increment `F_D` leads to at one point. */
template <int dim>
struct IncrementResponse
{
  /** The stress `P` of `int_{Omega_n} P : grad v dV`. */
  dealii::Tensor<2, dim> piola;

  /** Cauchy stress; the stress of the linear theory if the law has no geometric terms. */
  dealii::SymmetricTensor<2, 3> cauchy;

  /** The internal tensor at the end of the increment as IncrementLaw::finish() takes it. */
  dealii::SymmetricTensor<2, 3> internal;

  /** PointHistory::alpha at the end of the increment. */
  double alpha = 0;

  /** Stored energy, elastic and by hardening, per reference volume. */
  double energy = 0;

  /** Plastic dissipation `sigma_y (alpha - alpha_n)` of the increment, per reference volume. */
  double dissipation = 0;
};

/** Which tensor PointHistory::internal is. */
enum class InternalTensor
{
  none,           // the deformation gradient says all
  plastic_metric, // ln C_p^{-1}, trace 0, of the reference configuration; b_e = F C_p^{-1} F^T
  plastic_strain, // eps_p of small strain, trace 0, of the reference configuration
  cauchy_stress   // sigma
};

/** On which configuration the stress of a law does its work. */
enum class WorkOf
{
  current,   // tau : grad_x v, on the end of the step: geometric terms
  start,     // sigma : grad v on Omega_n
  reference, // sigma : grad_X v on Omega_0
};

/**
 * A constitutive law in increments: with the deformation gradient `F_D = I + grad du` of a step
 * on the configuration `Omega_n` at its start, and the history at that start, the stress `P` with
 *
 *     R(v) = int_{Omega_n} P : grad v dV,
 *
 * and its exact derivative `A = dP/dF_D`. There are three kinds of laws:
 *
 *     finite strain               P = J_D sigma F_D^{-T} = tau F_D^{-T}/J_n
 *     small strain, total         P = sigma F_n^T/J_n, so that R(v) = int_{Omega_0} sigma : grad_X
 * v small strain, incremental   P = sigma
 *
 * A total law gives the equations of the linear theory on the reference configuration whatever the
 * configuration they are integrated on. In two dimensions the strain is plane (`F_zz = 1`).
 * Stresses, energies and moduli have the unit of Young's modulus.
 *
 * If `det F_D <= 0`, which a Newton iteration may try, the stress, the tangent and the energy of a
 * law with geometric terms are NaN, so that a line search rejects the iterate.
 */
template <int dim>
class IncrementLaw
{
public:
  /** @param hardening its yield stress is infinite if the law is elastic */
  IncrementLaw(const IsotropicModuli &moduli, const Hardening &hardening);

  virtual ~IncrementLaw() = default;

  /** What the internal tensor of a point is. */
  virtual InternalTensor internal() const = 0;

  /** On which configuration its stress works. */
  virtual WorkOf work() const = 0;

  /**
   * The share of the volumetric stiffness that acts on projected volume changes: all of it if the
   * law flows, that of IsotropicModuli if it is elastic.
   */
  double projected_share() const;

  /**
   * Secant shear modulus of proportional loading to the equivalent plastic strain alpha over mu,
   * e/(e + alpha) with the elastic strain e = (sigma_y + H alpha)/(3 mu); 1 without yield stress.
   */
  double secant_ratio(const double alpha) const;

  /**
   * The start of a step from interpolated or carried history; needed once per step and point.
   *
   *     internal() == none:             b_e = F F^T,                       J_n = det F
   *     internal() == plastic_metric:   b_e = F exp(ln C_p^{-1}) F^T,      J_n = det F
   *     internal() == plastic_strain:   eps_p,                             J_n = det F
   *     internal() == cauchy_stress:    sigma_n,                           J_n = 1
   *
   * A negative alpha, which an interpolation may produce, is clipped.
   */
  IncrementStart start(const PointHistory<dim> &history) const;

  /**
   * The history after the accepted increment `F_D` from `history`, given the response to it; needed
   * once per step and point. `F = F_D F_n`, and
   *
   *     internal() == plastic_metric:   ln C_p^{-1} = ln(F^{-1} b_e F^{-T})
   *
   * with the `b_e` at the end, whose logarithm the response holds. A point without plastic flow
   * keeps its plastic metric or plastic strain to the last bit.
   */
  PointHistory<dim> finish(const PointHistory<dim> &history, const dealii::Tensor<2, dim> &F_D,
                           const IncrementResponse<dim> &response) const;

  /**
   * Responses at all points of `increments` (`F_D`), and the tangents `A_iJkL = dP_iJ/dF_D,kL`
   * unless `tangents` is empty. The virtual call is one per batch, not per point.
   */
  virtual void respond(const dealii::ArrayView<const dealii::Tensor<2, dim>> &increments,
                       const dealii::ArrayView<const IncrementStart>         &starts,
                       const dealii::ArrayView<IncrementResponse<dim>>       &responses,
                       const dealii::ArrayView<dealii::Tensor<4, dim>>       &tangents) const = 0;

private:
  IsotropicModuli moduli;
  Hardening       hardening;
};

/** Names of the laws that make_increment_law() knows. */
std::vector<std::string> increment_laws();

/** Whether the law of that name has a yield stress; false if there is no such law. */
bool is_plastic(const std::string &law);

/**
 * The law of the name `parameters.law` with E and nu, and with the yield stress and the hardening
 * modulus if it is plastic.
 *
 * @throws UserError if there is no law of that name, or if a constant is missing, not allowed, or
 *         given to a law that has none
 */
template <int dim>
std::unique_ptr<IncrementLaw<dim>> make_increment_law(const MaterialParameters &parameters);
} // namespace scree
