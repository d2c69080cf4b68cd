#include <gtest/gtest.h>

#include <scree/level_set/closest_point.h>
#include <scree/level_set/lattice.h>

#include <cmath>
#include <iostream>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
double
ball(const Point<dim> &x)
{
  Point<dim> centre;
  centre[0] = 0.07;
  centre[1] = -0.03;
  return (x - centre).norm() - 0.6;
}

template <int dim>
struct Pair
{
  Lattice<dim> dense, tiled;
};

// The same ball in [-1, 1]^dim, dense and in tiles; the box does not consist of complete tiles.
template <int dim>
Pair<dim>
ball_lattices(const int n, const double band)
{
  LatticeFrame<dim> frame;
  frame.origin  = Point<dim>::unit_vector(0) * 0.001;
  frame.spacing = 1. / n;
  std::array<int, dim> lower, count;
  lower.fill(-n);
  count.fill(2 * n + 1);
  Pair<dim> result{Lattice<dim>(frame, lower, count),
                   Lattice<dim>(frame, lower, count, ball<dim>, band)};
  for (std::size_t i = 0; i < result.dense.values().size(); ++i)
    result.dense.values()[i] = ball<dim>(result.dense.node(result.dense.index(i)));
  return result;
}

// Points all over the box and a little beyond it.
template <int dim>
Point<dim>
sample(const unsigned int i)
{
  Point<dim> x;
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = 1.05 * std::sin(1. + 3.7 * i + 2.1 * d * (i + 1));
  return x;
}

template <int dim>
void
check_evaluation(const int n, const unsigned int degree)
{
  const double h            = 1. / n;
  const auto [dense, tiled] = ball_lattices<dim>(n, 8 * h);
  EXPECT_TRUE(tiled.is_tiled());
  EXPECT_FALSE(dense.is_tiled());
  EXPECT_LT(tiled.values().size(), 0.6 * dense.values().size());
  double       difference = 0;
  unsigned int n_compared = 0;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const Point<dim> x = sample<dim>(i);
      const auto       a = dense.expansion(x, degree), b = tiled.expansion(x, degree);
      EXPECT_EQ(b.value < 0, a.value < 0);
      EXPECT_NEAR(b.value, tiled.value(x, degree), 1e-14);
      EXPECT_NEAR(b.value, tiled.value_and_gradient(x, degree).first, 0.);
      if (std::abs(a.value) > 5 * h)
        continue;
      ++n_compared;
      difference = std::max({difference, std::abs(b.value - a.value) / h,
                             (b.gradient - a.gradient).norm(), h * (b.hessian - a.hessian).norm()});
    }
  std::cout << dim << "D, degree " << degree << ": " << tiled.values().size() << " of "
            << dense.values().size() << " nodes, difference " << difference << " at " << n_compared
            << " points\n";
  EXPECT_GT(n_compared, 500u);
  EXPECT_LT(difference, 1e-13);
}

TEST(Tiles, EqualTheDenseLatticeInTheBand)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      check_evaluation<2>(90, degree);
      check_evaluation<3>(50, degree);
    }
}

TEST(Tiles, StoreTheBandAndTellItsNodes)
{
  const double h            = 1. / 50;
  const auto [dense, tiled] = ball_lattices<3>(50, 8 * h);
  for (std::size_t i = 0; i < tiled.values().size(); ++i)
    {
      const auto index = tiled.index(i);
      EXPECT_EQ(tiled.values()[i], ball<3>(tiled.node(index)));
      EXPECT_TRUE(!tiled.contains(index) || tiled.offset(index) == i);
    }
  for (std::size_t i = 0; i < dense.values().size(); ++i)
    {
      const auto   index = dense.index(i);
      const double exact = dense.values()[i];
      if (std::abs(exact) <= 8 * h)
        EXPECT_EQ(tiled(index), exact);
      else
        EXPECT_NEAR(tiled(index), exact, 8 * h);
      EXPECT_EQ(tiled.nodal_value(dense.node(index)), tiled(index));
    }
}

TEST(Tiles, AreSearchedForClosestPoints)
{
  const double h            = 1. / 50;
  const auto [dense, tiled] = ball_lattices<3>(50, 8 * h);
  for (unsigned int i = 0; i < 500; ++i)
    {
      const Point<3> x = sample<3>(i);
      if (std::abs(ball<3>(x)) > 6 * h)
        continue;
      const auto a = closest_point(dense, x, 3), b = closest_point(tiled, x, 3);
      EXPECT_TRUE(b.converged);
      EXPECT_LT(a.point.distance(b.point), 1e-10);
    }
}

// 800^3 nodes in well below a gigabyte.
TEST(ReleaseTiles, HoldABigBall)
{
  const int       n = 400;
  LatticeFrame<3> frame;
  frame.spacing = 1. / n;
  const Lattice<3> tiled(
    frame, {{-n, -n, -n}}, {{2 * n, 2 * n, 2 * n}},
    [](const Point<3> &x) { return x.norm() - 0.9; }, 8. / n);
  const double bytes = 8. * tiled.values().size() + 12. * tiled.tiles().coarse().size();
  std::cout << "stored " << tiled.values().size() << " of " << std::pow(2. * n, 3) << " nodes, "
            << bytes / 1e6 << " MB\n";
  EXPECT_LT(bytes, 5e8);
  for (unsigned int i = 0; i < 10000; ++i)
    {
      const Point<3> x  = sample<3>(i);
      const Point<3> on = x * (0.9 / x.norm());
      EXPECT_NEAR(tiled.value(on, 3), 0, 1e-9);
      EXPECT_NEAR(tiled.value(x * 0.9, 1), 0.9 * x.norm() - 0.9, 8. / n);
    }
}
} // namespace
} // namespace scree
