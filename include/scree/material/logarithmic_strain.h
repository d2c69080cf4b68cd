#pragma once

#include <deal.II/base/tensor.h>

#include <array>

namespace scree
{
/** Eigenvalues and, as columns of `vectors`, orthonormal eigenvectors of a symmetric tensor. */
struct Eigensystem
{
  std::array<double, 3> values;
  dealii::Tensor<2, 3>  vectors;

  /** `Q m Q^T` of a tensor `m` given in the principal axes, with `Q = vectors`. */
  dealii::Tensor<2, 3> rotate(const dealii::Tensor<2, 3> &principal) const;
};

/**
 * Eigensystem of a symmetric tensor by cyclic Jacobi rotations: as accurate for equal and nearly
 * equal eigenvalues as for distinct ones, and a single rotation in plane strain.
 */
Eigensystem eigensystem(const dealii::Tensor<2, 3> &symmetric);

/** `exp(m)` of a symmetric tensor. */
dealii::Tensor<2, 3> exponential(const dealii::Tensor<2, 3> &symmetric);

/**
 * Logarithmic strain `eps = 1/2 ln b` of a positive definite `b` with the eigenvalues `b_a`, and
 * its change when `b` changes with a velocity gradient `l`, `db = l b + b l^T`. In principal axes
 *
 *     d eps_ab = 1/2 L_ab db_ab,    L_ab = (ln b_a - ln b_b)/(b_a - b_b),    L_aa = 1/b_a.
 *
 * With `x = (b_a - b_b)/b_b` it is `L_ab = log1p(x)/(x b_b)`, which does not suffer from
 * cancellation: equal eigenvalues (`x = 0`) are the only exception, nearly equal ones are none.
 */
class LogarithmicStrain
{
public:
  explicit LogarithmicStrain(const Eigensystem &system);

  /** `1/2 ln b`. */
  dealii::Tensor<2, 3> value() const;

  /** Change of the strain for `l = e_k (x) f`. */
  dealii::Tensor<2, 3> derivative(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

private:
  Eigensystem          system;
  dealii::Tensor<2, 3> weights; // L_ab/2
};

/**
 * The rotation `R` of the polar decomposition `F = V R`, from the eigensystem of `b = F F^T`, and
 * its change. In the principal axes, with `v_a = sqrt(b_a)`, the spin `W = dR R^T` of a velocity
 * gradient `l = dF F^{-1}` is `W_ab = (l_ab v_b - l_ba v_a)/(v_a + v_b)`.
 */
class PolarRotation
{
public:
  PolarRotation(const dealii::Tensor<2, 3> &F, const Eigensystem &system);

  /** `R`. */
  const dealii::Tensor<2, 3> &value() const;

  /** The spin `dR R^T` for `l = e_k (x) f`. */
  dealii::Tensor<2, 3> spin(const unsigned int k, const dealii::Tensor<1, 3> &f) const;

private:
  Eigensystem           system;
  std::array<double, 3> stretches; // v_a
  dealii::Tensor<2, 3>  rotation;
};
} // namespace scree
