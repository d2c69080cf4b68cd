#pragma once

#include <scree/geometry/convex_shape.h>

#include <random>

namespace scree
{
/** Uniform in [0, 1) by 53 bits: distributions of the standard library differ between libraries. */
double uniform(std::mt19937_64 &random);

/** The square (2D) or cubic root of a positive number, by Newton steps from above. */
template <int dim>
double root(const double x);

enum class RandomShapeType
{
  ball,
  ellipsoid,
  superellipsoid,
  regular_polygon,
  random_polygon
};

/** Convex shapes of random size and aspect; all ranges are uniform. */
template <int dim>
struct RandomShapes
{
  RandomShapeType type = RandomShapeType::ball;
  /** Of the largest to the smallest radius, that of the disc or ball of the same volume. */
  double size_ratio = 1.;
  /** Ranges of first over second semi-axis and, in 3D, second over third: x and y of a polygon are
   * stretched accordingly. */
  std::vector<double>       aspect = {1., 1.}, second_aspect = {1., 1.};
  double                    exponent = 2.;     //!< of superellipses
  std::vector<unsigned int> corners  = {6, 6}; //!< range of their number
  double                    rounding = 0.;     //!< radius of corners over that of the shape

  /** A shape; the smallest have the radius 1. */
  std::shared_ptr<const ConvexShape<dim>> draw(std::mt19937_64 &random) const;

  /** Uniform over all rotations. */
  dealii::Tensor<2, dim> draw_rotation(std::mt19937_64 &random) const;
};
} // namespace scree
