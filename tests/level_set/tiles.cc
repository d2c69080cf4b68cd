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
ball_lattices(const int n)
{
  LatticeFrame<dim> frame;
  frame.origin  = Point<dim>::unit_vector(0) * 0.001;
  frame.spacing = 1. / n;
  std::array<int, dim> lower, count;
  lower.fill(-n);
  count.fill(2 * n + 1);
  Pair<dim> result{Lattice<dim>(frame, lower, count), Lattice<dim>(frame, lower, count, ball<dim>)};
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
  const auto [dense, tiled] = ball_lattices<dim>(n);
  EXPECT_TRUE(tiled.is_tiled());
  EXPECT_FALSE(dense.is_tiled());
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const Point<dim> x = sample<dim>(i);
      const auto       a = dense.expansion(x, degree), b = tiled.expansion(x, degree);
      EXPECT_EQ(b.value, a.value);
      EXPECT_EQ(b.gradient, a.gradient);
      EXPECT_EQ(b.hessian, a.hessian);
      EXPECT_EQ(tiled.value(x, degree), dense.value(x, degree));
    }
}

TEST(Tiles, EqualTheDenseLattice)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      check_evaluation<2>(90, degree);
      check_evaluation<3>(50, degree);
    }
}

TEST(Tiles, ComeWhereNodesAreAskedFor)
{
  const auto [dense, tiled] = ball_lattices<3>(50);
  const Lattice<3>::Index node{{20, -3, 7}};
  const std::size_t       few = Tiles<3>::n_nodes / 8;
  for (std::size_t i = 0; i < few - 1; ++i)
    {
      EXPECT_EQ(tiled(node), dense(node));
      EXPECT_EQ(tiled.offset(node), Tiles<3>::absent);
    }
  EXPECT_EQ(tiled(node), dense(node));
  EXPECT_EQ(tiled.values().size(), std::size_t(Tiles<3>::n_nodes));
  EXPECT_EQ(tiled.index(tiled.offset(node)), node);
  for (std::size_t i = 0; i < dense.values().size(); ++i)
    {
      const auto index = dense.index(i);
      EXPECT_EQ(tiled(index), dense.values()[i]);
      EXPECT_EQ(tiled.nodal_value(dense.node(index)), dense.values()[i]);
    }
  for (std::size_t i = 0; i < tiled.values().size(); ++i)
    {
      const auto index = tiled.index(i);
      EXPECT_EQ(tiled.values()[i], ball<3>(tiled.node(index)));
      EXPECT_TRUE(!tiled.contains(index) || tiled.offset(index) == i);
    }
  Lattice<3> changed = ball_lattices<3>(50).tiled;
  changed(node)      = 7.;
  EXPECT_EQ(changed.nodal_value(changed.node(node)), 7.);
}

TEST(Tiles, AreSearchedForClosestPoints)
{
  const double h            = 1. / 50;
  const auto [dense, tiled] = ball_lattices<3>(50);
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
  const Lattice<3> tiled(frame, {{-n, -n, -n}}, {{2 * n, 2 * n, 2 * n}},
                         [](const Point<3> &x) { return x.norm() - 0.9; });
  for (unsigned int i = 0; i < 100000; ++i)
    {
      const Point<3> x  = sample<3>(i);
      const Point<3> on = x * (0.9 / x.norm());
      EXPECT_NEAR(tiled.value(on, 3), 0, 1e-9);
    }
  const double bytes = 8. * tiled.values().size() + std::pow(2. * n, 3) / 128.;
  std::cout << "stored " << tiled.values().size() << " of " << std::pow(2. * n, 3) << " nodes, "
            << bytes / 1e6 << " MB\n";
  EXPECT_LT(bytes, 5e8);
}
} // namespace
} // namespace scree
