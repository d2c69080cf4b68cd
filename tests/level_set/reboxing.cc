#include <gtest/gtest.h>

#include <scree/level_set/advection.h>
#include <scree/level_set/reboxing.h>

#include <cmath>
#include <iostream>

namespace scree
{
namespace
{
using namespace dealii;

LatticeFrame<2>
frame(const double spacing)
{
  LatticeFrame<2> result;
  result.origin  = Point<2>(0.003, -0.001);
  result.spacing = spacing;
  return result;
}

TEST(Reboxing, KeepsWhatItHasAndExtrapolatesDistances)
{
  const double   h = 0.05, radius = 0.5;
  const Point<2> centre(0.31, 0.12);
  const auto     disc = [&](const Point<2> &x) { return x.distance(centre) - radius; };
  const auto     box  = node_box<2>(frame(h), Point<2>(-0.49, -0.68), Point<2>(1.11, 0.92));
  Lattice<2>     lattice(frame(h), box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = disc(lattice.node(lattice.index(i)));

  NodeBox<2> other = box;
  other.lower[0] += 6;
  other.lower[1] -= 4;
  other.n_nodes[0] += 10;
  const Lattice<2> moved = reboxed(lattice, other);
  for (std::size_t i = 0; i < moved.values().size(); ++i)
    {
      const auto   index = moved.index(i);
      const double exact = disc(moved.node(index));
      if (lattice.contains(index))
        EXPECT_EQ(moved.values()[i], lattice(index));
      else
        EXPECT_NEAR(moved.values()[i], exact, 1e-3 * h);
    }
  for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(moved.lower()[d] % 2, 0);
      EXPECT_EQ(moved.n_nodes()[d] % 2, 1);
    }
}

// A disc goes 50 spacings in steps of one, and its lattice goes with it.
TEST(Reboxing, FollowsADiscOver50Spacings)
{
  const double h = 0.05, radius = 0.5, margin = 8 * h;
  const auto   box = node_box<2>(frame(h), Point<2>(-1, -1), Point<2>(1, 1));
  Lattice<2>   lattice(frame(h), box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = lattice.node(lattice.index(i)).norm() - radius;
  const Tensor<1, 2> step({0.83 * h, -0.56 * h});
  unsigned int       n_boxes = 0;
  for (unsigned int i = 0; i < 50; ++i)
    {
      NodalVectors<2> du;
      for (unsigned int d = 0; d < 2; ++d)
        du[d].assign(lattice.values().size(), step[d]);
      advect_increment<2>(lattice, du);
      n_boxes += follow_body(lattice, margin);
      EXPECT_LE(lattice.values().size(), 61u * 61u);
    }
  const Point<2> centre(50. * step);
  double         error = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const double exact = lattice.node(lattice.index(i)).distance(centre) - radius;
      if (std::abs(exact) < 2 * h)
        error = std::max(error, std::abs(lattice.values()[i] - exact));
      EXPECT_NEAR(lattice.values()[i], exact, 4 * h); // the kink in the middle suffers most
    }
  for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_LE(lattice.box().lower_bound(d), centre[d] - radius - margin);
      EXPECT_GE(lattice.box().upper_bound(d), centre[d] + radius + margin);
    }
  std::cout << n_boxes << " boxes, error/h " << error / h << '\n';
  EXPECT_GT(n_boxes, 3u);
  EXPECT_LT(n_boxes, 25u);
  EXPECT_LT(error, 0.02 * h);
}

TEST(Reboxing, LeavesALatticeThatFits)
{
  const double h   = 0.05;
  const auto   box = node_box<2>(frame(h), Point<2>(-1, -1), Point<2>(1, 1));
  Lattice<2>   lattice(frame(h), box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = lattice.node(lattice.index(i)).norm() - 0.5;
  EXPECT_FALSE(follow_body(lattice, 8 * h));
  EXPECT_TRUE(follow_body(lattice, 2 * h));
  EXPECT_LT(lattice.box().upper_bound(0), 0.75);
}

// A half disc cut by the face x = 0 of a box grows in y: only that side of the lattice follows, and
// what is beyond the face does not count.
TEST(Reboxing, FollowsAClippedBody)
{
  const double         h = 0.05;
  const BoundingBox<2> box({Point<2>(0, -3), Point<2>(3, 3)});
  const auto           nodes = node_box<2>(frame(h), Point<2>(-0.4, -1), Point<2>(1, 1));
  Lattice<2>           lattice(frame(h), nodes.lower, nodes.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Point<2> x    = lattice.node(lattice.index(i));
      lattice.values()[i] = std::min(x.norm() - 0.5, x.distance(Point<2>(-0.3, 0.95)) - 0.1);
    }
  const Lattice<2> start = lattice;
  EXPECT_FALSE(follow_body(lattice, 8 * h, box));
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = lattice.node(lattice.index(i)).distance(Point<2>(0, 0.2)) - 0.5;
  EXPECT_TRUE(follow_body(lattice, 8 * h, box));
  EXPECT_EQ(lattice.lower()[0], start.lower()[0]);
  EXPECT_GE(lattice.box().upper_bound(1), 0.7 + 8 * h);
  EXPECT_GT(lattice.box().lower_bound(1), start.box().lower_bound(1));
}
} // namespace
} // namespace scree
