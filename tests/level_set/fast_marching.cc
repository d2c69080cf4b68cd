#include <gtest/gtest.h>

#include <scree/level_set/closest_point.h>
#include <scree/level_set/fast_marching.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>

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

struct Errors
{
  double start; // nodes next to the contour
  double all;   // away from the centre
};

template <int dim>
Errors
ball_errors(const double h)
{
  const double radius  = 0.53;
  auto         lattice = sampled<dim>(h, 1, [&](const Point<dim> &x) {
    return (x.norm_square() - radius * radius) * (2 + std::sin(2 * x[0] + x[1]));
  });
  compute_distances(lattice);
  const auto exact = [&](const Point<dim> &x) { return x.norm() - radius; };
  return {error(lattice, exact, [&](const Point<dim> &x) { return std::abs(exact(x)) < h; }),
          error(lattice, exact, [](const Point<dim> &x) { return x.norm() > 0.3; })};
}

double
order(const double coarse, const double fine)
{
  return std::log2(coarse / fine);
}

TEST(FastMarching, IsSecondOrderInTheMaximumNorm)
{
  std::array<Errors, 3> errors;
  for (int level : {0, 1, 2})
    errors[level] = ball_errors<2>(0.05 / (1 << level));
  std::cout << "2D errors " << errors[0].all << ' ' << errors[1].all << ' ' << errors[2].all
            << ", order " << order(errors[1].all, errors[2].all) << "; next to the contour "
            << errors[2].start << ", order " << order(errors[1].start, errors[2].start) << '\n';
  EXPECT_LT(errors[1].all, 1e-3);
  EXPECT_GT(order(errors[0].all, errors[1].all), 1.7);
  EXPECT_GT(order(errors[1].all, errors[2].all), 1.8);
  EXPECT_GT(order(errors[1].start, errors[2].start), 3);

  const Errors coarse = ball_errors<3>(0.05), fine = ball_errors<3>(0.025);
  std::cout << "3D errors " << coarse.all << ' ' << fine.all << ", order "
            << order(coarse.all, fine.all) << "; next to the contour " << fine.start << ", order "
            << order(coarse.start, fine.start) << '\n';
  EXPECT_GT(order(coarse.all, fine.all), 1.7);
  EXPECT_GT(order(coarse.start, fine.start), 3);
}

// A march on one side must not depend on the other one: the complement has the opposite distances.
TEST(FastMarching, TreatsBothSidesAlike)
{
  auto inside  = sampled<2>(0.05, 1, [](const Point<2> &x) { return x.norm() - 0.53; });
  auto outside = inside;
  for (double &value : outside.values())
    value = -value;
  compute_distances(inside);
  compute_distances(outside);
  for (std::size_t i = 0; i < inside.values().size(); ++i)
    EXPECT_EQ(inside.values()[i], -outside.values()[i]);
}

template <int dim>
void
print_rate(const int n)
{
  const auto lattice = sampled<dim>(1. / n, 1, [&](const Point<dim> &x) {
    return (x.norm_square() - 0.36) * (2 + std::sin(2 * x[0] + x[1]));
  });
  double     best    = 1e10;
  for (unsigned int repeat = 0; repeat < 2; ++repeat)
    {
      auto               copy  = lattice;
      const std::clock_t start = std::clock();
      compute_distances(copy);
      best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
      EXPECT_TRUE(std::isfinite(copy.values().back()));
    }
  std::cout << dim << "D, " << 2 * n + 1
            << " nodes per direction: " << lattice.values().size() / best * 1e-6
            << " million points per second\n";
}

TEST(ReleaseFastMarching, Rate)
{
  print_rate<2>(50);
  print_rate<2>(250);
  print_rate<3>(32);
  print_rate<3>(50);
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
