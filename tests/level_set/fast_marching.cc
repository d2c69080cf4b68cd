#include <gtest/gtest.h>

#include <scree/level_set/closest_point.h>
#include <scree/level_set/fast_marching.h>

#include <cmath>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

// The largest error of the nodal values against `exact` where `where` holds.
template <int dim, typename F, typename G>
double
error(const Lattice<dim> &lattice, const F &exact, const G &where)
{
  double result = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Point<dim> x = lattice.node(lattice.index(i));
      if (where(x))
        result = std::max(result, std::abs(lattice.values()[i] - exact(x)));
    }
  return result;
}

template <int dim>
double
ball_error(const double h)
{
  const double radius  = 0.53;
  auto         lattice = sampled<dim>(h, 1, [&](const Point<dim> &x) {
    return (x.norm_square() - radius * radius) * (2 + std::sin(2 * x[0] + x[1]));
  });
  compute_distances(lattice);
  return error(
    lattice, [&](const Point<dim> &x) { return x.norm() - radius; },
    [](const Point<dim> &x) { return x.norm() > 0.3; });
}

TEST(FastMarching, IsSecondOrderInTheMaximumNorm)
{
  std::array<double, 3> errors;
  for (int level : {0, 1, 2})
    errors[level] = ball_error<2>(0.05 / (1 << level));
  EXPECT_LT(errors[1], 1e-3);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.7);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7);

  const double coarse = ball_error<3>(0.05), fine = ball_error<3>(0.025);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

template <int dim>
void
check_contour(const double h, const double size)
{
  const double radius = 0.53;
  auto         before = sampled<dim>(h, size, [&](const Point<dim> &x) {
    return (x.norm_square() - radius * radius) * (2 + std::sin(2 * x[0] + x[1]));
  });
  auto         after  = before;
  compute_distances(after);
  double shift = 0, slope = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::sin(1. + 1.7 * i * (d + 1) + d);
      x *= radius / x.norm();
      const auto foot = closest_point(before, x, 3);
      ASSERT_TRUE(foot.converged);
      const auto [value, gradient] = after.value_and_gradient(foot.point, 3);
      shift                        = std::max(shift, std::abs(value));
      slope                        = std::max(slope, std::abs(gradient.norm() - 1));
    }
  EXPECT_LT(shift, 1e-4 * h);
  EXPECT_LT(slope, 1e-3);
}

TEST(FastMarching, LeavesTheContourInPlace)
{
  check_contour<2>(0.025, 0.75);
  check_contour<3>(0.04, 0.8);
}

TEST(FastMarching, RepeatedTwentyTimesMovesTheContourLittle)
{
  const double h       = 0.025;
  auto         lattice = sampled<2>(
    h, 1, [](const Point<2> &x) { return std::sqrt(x[0] * x[0] / 0.64 + x[1] * x[1] / 0.25) - 1; });
  const auto before = lattice;
  for (unsigned int i = 0; i < 20; ++i)
    compute_distances(lattice);
  for (unsigned int i = 0; i < 500; ++i)
    {
      const auto foot = closest_point(before, Point<2>(0.8 * std::cos(i), 0.5 * std::sin(i)), 3);
      ASSERT_TRUE(foot.converged);
      EXPECT_LT(std::abs(lattice.value(foot.point, 3)), 2e-3 * h);
    }
}

// Planes at any angle are exact.
TEST(FastMarching, IsExactForPlanes)
{
  for (const double angle : {0., 0.3, 0.7853981633974483})
    {
      const auto plane = [&](const Point<2> &x) {
        return std::cos(angle) * x[0] + std::sin(angle) * x[1] - 0.013;
      };
      auto lattice = sampled<2>(0.1, 2, [&](const Point<2> &x) { return 7.3 * plane(x); });
      compute_distances(lattice);
      // Where the lattice ends, the closest points of some nodes are beyond it.
      EXPECT_LT(error(lattice, plane, [](const Point<2> &x) { return x.norm() < 0.8; }), 1e-9);
    }
}

// Beyond a corner the distances to it are circular (first order at worst); along the sides, a few
// spacings from the corner, they stay exact.
TEST(FastMarching, KeepsTheSidesOfASquare)
{
  const double h       = 0.05;
  auto         lattice = sampled<2>(
    h, 2, [](const Point<2> &x) { return 3 * (std::max(std::abs(x[0]), std::abs(x[1])) - 1.02); });
  compute_distances(lattice);
  const auto exact = [](const Point<2> &x) {
    const double a = std::abs(x[0]) - 1.02, b = std::abs(x[1]) - 1.02;
    return std::max(a, b) < 0 ? std::max(a, b) : std::hypot(std::max(a, 0.), std::max(b, 0.));
  };
  EXPECT_LT(error(lattice, exact,
                  [](const Point<2> &x) {
                    return std::abs(x[0]) < 0.8 && std::abs(x[1]) > std::abs(x[0]) + 0.2;
                  }),
            1e-6);
  EXPECT_LT(error(lattice, exact, [](const Point<2> &) { return true; }), 0.3 * h);
}

TEST(FastMarching, NeedsAContour)
{
  auto lattice = sampled<2>(0.1, 0.5, [](const Point<2> &x) { return 1 + x.norm(); });
  EXPECT_FALSE(has_contour(lattice));
  EXPECT_THROW(compute_distances(lattice), ExceptionBase);
}
} // namespace
} // namespace scree
