#include <gtest/gtest.h>

#include <scree/level_set/closest_point.h>

#include <cmath>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

// The distance to the ellipse by dense sampling and refinement of the parameter.
double
ellipse_distance(const Point<2> &x, const double a, const double b)
{
  const auto at
    = [&](const double t) { return x.distance(Point<2>(a * std::cos(t), b * std::sin(t))); };
  double best = 0, width = 2 * M_PI;
  for (unsigned int level = 0; level < 12; ++level, width /= 20)
    {
      const double centre = best;
      for (int i = -50; i <= 50; ++i)
        if (at(centre + i * width / 50) < at(best))
          best = centre + i * width / 50;
    }
  return at(best);
}

template <int dim>
void
check_ball()
{
  const double radius = 0.61;
  const auto   lattice
    = sampled<dim>(0.05, 1.2, [&](const Point<dim> &x) { return x.norm() - radius; });
  for (unsigned int i = 0; i < 300; ++i)
    {
      Point<dim> direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = std::sin(1. + 1.7 * i * (d + 1) + d);
      direction /= direction.norm();
      const Point<dim> x(direction * (0.3 + 0.8 * (i % 17) / 17.));
      for (const auto &result : {closest_point(lattice, x, 3), project(lattice, x, 3)})
        {
          ASSERT_TRUE(result.converged);
          EXPECT_LT(result.point.distance(Point<dim>(direction * radius)), 1e-2 * 0.05);
          EXPECT_LT((result.normal - direction).norm(), 2e-3);
          EXPECT_LT(std::abs(lattice.value(result.point, 3)), 1e-10 * 0.05);
        }
    }
}

TEST(ClosestPoint, IsRadialOnBalls)
{
  check_ball<2>();
  check_ball<3>();
}

// A level set that is no distance (the gradient does not point to the closest point), near and far
// points, distance times curvature up to 3 outside.
TEST(ClosestPoint, IsTheNearestPointOfAnEllipse)
{
  const double a = 1, b = 0.5;
  const auto   lattice  = sampled<2>(0.05, 2, [&](const Point<2> &x) {
    return (std::pow(x[0] / a, 2) + std::pow(x[1] / b, 2) - 1) * (1 + 0.2 * x[0]);
  });
  unsigned int n_points = 0;
  for (double x = -1.73; x < 1.8; x += 0.061)
    for (double y = -1.27; y < 1.3; y += 0.061)
      {
        const double level = std::sqrt(x * x / (a * a) + y * y / (b * b));
        if (level < 0.8)
          continue; // near the medial axis local minima compete
        ++n_points;
        const Point<2> point(x, y);
        const auto     result = closest_point(lattice, point, 3);
        ASSERT_TRUE(result.converged) << point;
        EXPECT_NEAR(point.distance(result.point), ellipse_distance(point, a, b), 1e-5) << point;
        const Tensor<1, 2> offset = point - result.point;
        EXPECT_LT(std::abs(cross_product_2d(offset) * result.normal), 1e-8);
      }
  EXPECT_GT(n_points, 1500u);
}

TEST(ClosestPoint, ErrorsFallWithOrderDegreePlusOne)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      std::array<double, 2> error{};
      for (const int level : {0, 1})
        {
          const double h     = 0.1 / (1 << (2 * level));
          const auto lattice = sampled<2>(h, 1.2, [](const Point<2> &x) { return x.norm() - 0.7; });
          for (unsigned int i = 0; i < 500; ++i)
            {
              const Point<2> direction(std::cos(0.3 + i), std::sin(0.3 + i));
              const auto     result = closest_point(lattice, Point<2>(0.75 * direction), degree);
              ASSERT_TRUE(result.converged);
              error[level] = std::max(error[level], std::abs(result.point.norm() - 0.7));
            }
        }
      EXPECT_GT(std::log2(error[0] / error[1]) / 2, degree + 1 - 0.3) << "degree " << degree;
    }
}

// The multilinear interpolant of max(|x|, |y|) - a has kinks where points outside the corners end.
TEST(ClosestPoint, EndsAtTheCornersOfASquare)
{
  const auto lattice = sampled<2>(
    0.1, 2, [](const Point<2> &x) { return std::max(std::abs(x[0]), std::abs(x[1])) - 1; });
  for (const Point<2> x : {Point<2>(1.35, 1.25), Point<2>(-1.5, 1.22), Point<2>(1.6, -1.6)})
    {
      const auto result = closest_point(lattice, x, 1);
      EXPECT_TRUE(result.converged);
      EXPECT_NEAR(std::abs(result.point[0]), 1, 1e-8);
      EXPECT_NEAR(std::abs(result.point[1]), 1, 1e-8);
    }
  const auto flat = closest_point(lattice, Point<2>(1.3, 0.4), 1);
  EXPECT_LT(flat.point.distance(Point<2>(1, 0.4)), 1e-12);
}

// Far from the origin of the coordinates a distance of 1e-13 spacings is lost in rounding.
TEST(ClosestPoint, ConvergesFarFromTheOrigin)
{
  const Point<2>  centre(1000, -2000);
  LatticeFrame<2> frame;
  frame.origin  = centre;
  frame.spacing = 0.01;
  Lattice<2> lattice(frame, {{-20, -20}}, {{41, 41}});
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = lattice.node(lattice.index(i)).distance(centre) - 0.12;
  for (unsigned int i = 0; i < 300; ++i)
    for (const unsigned int degree : {1, 2, 3})
      {
        const Point<2> x = centre + 0.15 * Point<2>(std::cos(i), std::sin(i));
        EXPECT_TRUE(closest_point(lattice, x, degree).converged);
        EXPECT_TRUE(project(lattice, x, degree).converged);
      }
}

TEST(ClosestPoint, SaysWhenThereIsNone)
{
  const auto lattice = sampled<2>(0.1, 1, [](const Point<2> &) { return 1.; });
  EXPECT_FALSE(closest_point(lattice, Point<2>(0.1, 0.2), 2).converged);
  EXPECT_FALSE(project(lattice, Point<2>(0.1, 0.2), 2).converged);
}
} // namespace
} // namespace scree
