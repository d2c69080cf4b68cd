#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace scree
{
/** Tangents of a surface. */
template <int dim>
using SurfaceTangents = std::array<dealii::Tensor<1, dim>, dim - 1>;

/** Orthonormal tangents with t_1 x t_2 = n; 2D: n is t_1 turned to the left. */
template <int dim>
SurfaceTangents<dim> surface_tangents(const dealii::Tensor<1, dim> &normal);

/** The normal of orthonormal tangents. */
template <int dim>
dealii::Tensor<1, dim> surface_normal(const SurfaceTangents<dim> &tangents);

/** A point of a surface next to the place of interest, the origin of the tangent plane there. */
template <int dim>
struct SurfaceNeighbour
{
  unsigned int               entry;
  double                     square; //!< of the distance
  double                     weight; //!< the sum over all is 1
  dealii::Tensor<1, dim - 1> place;  //!< in the tangent plane
};

/**
 * Weighted linear least squares in the tangent plane: of values f_i at xi_i with mean xi the slope
 * is C^{-1} sum w_i (xi_i - xi) f_i, C = sum w_i (xi_i - xi)(xi_i - xi)^T.
 */
template <int dim>
class LinearFit
{
public:
  /** `length` [L] of the neighbourhood. */
  LinearFit(const std::vector<SurfaceNeighbour<dim>> &neighbours, const double length);

  /** s with slope . v = sum_i w_i (s . (xi_i - xi)) f_i. */
  dealii::Tensor<1, dim - 1> direction(const dealii::Tensor<1, dim - 1> &v) const
  {
    return inverse * v;
  }

  dealii::Tensor<1, dim - 1> mean;
  bool                       is_linear = false; //!< their places determine a slope

private:
  dealii::SymmetricTensor<2, dim - 1> inverse;
};

/**
 * Moving least squares at the origin of the tangent plane with polynomials of degree 2, or of the
 * largest degree that the places of the neighbours determine.
 */
template <int dim>
class InterpolatingFit
{
public:
  /** `length` [L] of the neighbourhood, which has at least one point. */
  InterpolatingFit(const std::vector<SurfaceNeighbour<dim>> &neighbours, const double length);

  /** Factor of a neighbour's value in the value at the origin. */
  double factor(const SurfaceNeighbour<dim> &neighbour) const
  {
    const Terms terms = monomials(neighbour.place);
    double      sum   = 0.;
    for (unsigned int i = 0; i < n_terms; ++i)
      sum += coefficients[i] * terms[i];
    return neighbour.weight * sum;
  }

  bool is_outside; //!< all neighbours lie on one side

private:
  static constexpr unsigned int n_linear = dim, n_terms = dim * (dim + 1) / 2;
  using Terms  = std::array<double, n_terms>;
  using Matrix = std::array<Terms, n_terms>;

  Terms monomials(const dealii::Tensor<1, dim - 1> &place) const
  {
    const dealii::Tensor<1, dim - 1> x = (place - origin) / length;
    if constexpr (dim == 2)
      return {{1., x[0], x[0] * x[0]}};
    else
      return {{1., x[0], x[1], x[0] * x[0], x[0] * x[1], x[1] * x[1]}};
  }

  /** coefficients = M^{-1} monomials(0) by Cholesky's method with unit diagonal of M. */
  void solve(const Matrix &moments, const unsigned int largest_size);

  double                     length;
  dealii::Tensor<1, dim - 1> origin;
  Terms                      coefficients;
};
} // namespace scree
