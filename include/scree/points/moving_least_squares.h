#pragma once

#include <scree/points/point_search.h>

#include <cstdint>

namespace scree
{
/** Choices of the moving least squares; theory.md section 9. */
struct MovingLeastSquaresOptions
{
  unsigned int degree       = 1;     //!< of the polynomials that are reproduced: 0, 1 or 2
  double       support      = 1.75;  //!< radius over the larger of cell and point spacing, 1.5 to 2
  bool         interpolates = false; //!< whether values at points are kept
};

/** How often the moving least squares had to do with less than was asked for. */
struct MovingLeastSquaresReport
{
  std::uint64_t n_targets      = 0;
  std::uint64_t widened        = 0;  //!< targets with a larger radius, at the full degree
  std::uint64_t lowered        = 0;  //!< targets with a lower degree than asked for
  std::uint64_t constant       = 0;  //!< of these: degree 0
  std::uint64_t without_points = 0;  //!< targets of a body without points: weights are missing
  double largest_amplification = 0.; //!< largest sum of |weights| of a target (Lebesgue constant)
};

/** Where values are wanted: position, body and size of the cell around it [L]. */
template <int dim>
struct Targets
{
  std::vector<dealii::Point<dim>> position;
  std::vector<unsigned int>       body;
  std::vector<double>             cell_size;
};

/**
 * Values at targets as sums over points, value_t = sum_i weight_i f(point_i), i in [begin[t],
 * begin[t+1]): one set of weights serves all components.
 */
struct PointWeights
{
  std::vector<std::size_t>  begin = {0};
  std::vector<unsigned int> points;
  std::vector<double>       weights;
  MovingLeastSquaresReport  report;

  std::size_t n_targets() const
  {
    return begin.size() - 1;
  }

  /** The value of a field at a target; zero for a target without points. */
  template <typename T>
  T value(const std::vector<T> &field, const std::size_t target) const
  {
    T sum = {};
    for (std::size_t i = begin[target]; i < begin[target + 1]; ++i)
      sum += weights[i] * field[points[i]];
    return sum;
  }

  /** The values at all targets. */
  template <typename T>
  std::vector<T> values(const std::vector<T> &field) const
  {
    std::vector<T> result(n_targets());
    for (std::size_t t = 0; t < n_targets(); ++t)
      result[t] = value(field, t);
    return result;
  }

  /** The same for a field of n numbers per point in a row. */
  std::vector<double> values(const std::vector<double> &field, const unsigned int n) const;
};

/**
 * Deformation gradients at the targets,
 *
 *     F = (J/det G)^(1/dim) G,    G = sum_i w_i F_i,    J = sum_i w_i det F_i:
 *
 * what F_i varies among the points changes det G by its square, which in a shear band is more than
 * any elastic change of volume. Where det G < J/4, or J is not positive, opposite shears cancel and
 * G tells nothing: F is that of the point with the largest weight.
 */
template <int dim>
std::vector<dealii::Tensor<2, dim>>
interpolated_gradients(const PointWeights                        &weights,
                       const std::vector<dealii::Tensor<2, dim>> &of_points);

/**
 * Moving least squares (Lancaster & Salkauskas 1981; ILS section 4.3) from the points of a body to
 * any target x: the polynomial q of the given degree that minimises
 *
 *     sum_i w(|x_i - x|/r) (q(x_i) - f_i)^2,   value = q(x),
 *
 * with the quadratic spline w(s') of s' = 3/2 s: 3/4 - s'^2 for s' <= 1/2, (3/2 - s')^2/2 up to
 * 3/2. The radius r is `support` times the larger of the cell size and the weighted mean spacing of
 * the points around x. Polynomials of the basis are reproduced to round-off: the basis is shifted
 * to x and scaled by r, the moment matrix scaled to unit diagonal, factorised by Cholesky, and an
 * ill-conditioned solution refined once.
 *
 * Where the smallest eigenvalue of the scaled moment matrix (bounded by 1/trace of its inverse)
 * falls below 1e-3 (degree 1) or 1e-5 (degree 2), r grows by 1.25 up to 6 times; then the degree is
 * lowered; in the end the nearest point of the body gives the value.
 */
template <int dim>
class MovingLeastSquares
{
public:
  /**
   * @param positions of the points [L]
   * @param body      number of the body of each point
   * @param spacing   distance of each point to its neighbours [L]
   */
  MovingLeastSquares(const std::vector<dealii::Point<dim>> &positions,
                     const std::vector<unsigned int> &body, const std::vector<double> &spacing,
                     const MovingLeastSquaresOptions &options);

  /** The weights for all targets. */
  PointWeights weights(const Targets<dim> &targets) const;

private:
  /** The points around a target in lanes: offsets over the radius, spline weights, places. */
  struct Neighbours;

  double gather(const unsigned int body, const dealii::Point<dim> &x, const double radius,
                Neighbours &neighbours) const;

  template <int degree>
  bool try_degree(const Targets<dim> &targets, const std::size_t t, Neighbours &neighbours,
                  MovingLeastSquaresReport &report) const;

  void solve(const Targets<dim> &targets, const std::size_t t, Neighbours &neighbours,
             MovingLeastSquaresReport &report) const;

  MovingLeastSquaresOptions options;
  PointSearch<dim>          search;
  std::vector<double>       spacing; //!< in the sorted order of the search
};
} // namespace scree
