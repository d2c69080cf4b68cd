#pragma once

#include <scree/discretization/lagrange.h>
#include <scree/material/increment_response.h>

#include <array>
#include <vector>

namespace scree
{
/**
 * Polynomials of degree k - 1 on the physical part of a cell, orthonormal for its quadrature: the
 * constant for degree 1, up to dim + 1 linear ones for degree 2. The volume change of the cell is
 * projected on them, so that nearly incompressible materials and isochoric flow do not lock (Q1/P0
 * and Q2/P-1; Simo, Taylor, Pister 1985; theory.md, Volume changes).
 */
template <int dim>
struct VolumeModes
{
  static constexpr unsigned int n_max = dim + 1;

  /** By Gram and Schmidt; directions in which the points are not spread carry no mode. */
  VolumeModes(const dealii::Point<dim> *points, const double *weights, const unsigned int n_points,
              const unsigned int degree);

  /** psi_m at a point in unit coordinates. */
  std::array<double, n_max> operator()(const dealii::Point<dim> &unit_point) const;

  unsigned int n = 0;
  /** psi_m = sum_j coefficients[m][j] f_j with f = 1, x_1 - 1/2, ... */
  std::array<std::array<double, n_max>, n_max> coefficients = {};
};

/**
 * The volume change at one point of an increment F_D and how F_D follows its projection. With
 * delta value = scale H : delta F_D,
 *
 *     finite strain            value = J = det(F_D) J_n,       scale = J,   H = F_D^{-T},  B = F_D
 *     small strain, total      value = theta = tr(F_D F_n - I), scale = 1,  H = F_n^T,     B =
 * F_n^{-1} small strain, increments value = theta = tr(F_D - I),     scale = 1,  H = B = I
 *
 * and with the projection J* or theta* the law sees, at finite strain, F* = m F_D, m = (J* / J)^r,
 * otherwise F* = F_D + r (theta* - theta) B (m = 1).
 */
template <int dim>
class VolumeChange
{
public:
  VolumeChange() = default;
  VolumeChange(const WorkOf work, const dealii::Tensor<2, dim> &F_D, const IncrementStart &start);

  /** F*, all NaN where the volume is not positive. */
  dealii::Tensor<2, dim> project(const double projected_value, const double r);

  double                 value = 0.;
  double                 scale = 1.; //!< of H in the derivative of the value
  dealii::Tensor<2, dim> H;
  /** Derivative of the projected value in the measure of what follows: 1/J* or 1. */
  double slope = 1.;

  /** P, the derivative of the energy with respect to F_D at fixed projection, and trace. */
  struct Stress
  {
    dealii::Tensor<2, dim> scaled; //!< m P*
    dealii::Tensor<2, dim> piola;  //!< m P* - r (m P* : B) H
    double                 trace;  //!< m P* : B
  };
  Stress stress(const dealii::Tensor<2, dim> &law_piola) const;

  /** Derivatives with respect to F_D and to the projection, d ln J* or d theta*. */
  struct Tangent
  {
    dealii::Tensor<4, dim> scaled, piola;
    dealii::Tensor<2, dim> trace;
    dealii::Tensor<2, dim> scaled_by_volume, piola_by_volume;
    double                 trace_by_volume;
  };
  Tangent tangent(const Stress &stress, const dealii::Tensor<4, dim> &law_tangent) const;

  bool is_geometric() const
  {
    return geometric;
  }

private:
  bool                   geometric = false;
  double                 r = 0., m = 1.;
  dealii::Tensor<2, dim> increment, B;
};
} // namespace scree
