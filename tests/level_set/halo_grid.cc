#include <gtest/gtest.h>

#include <scree/level_set/advection.h>

#include <cmath>
#include <iostream>

#include "shapes.h"

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
  centre[0] = 0.05;
  return (x - centre).norm() - 0.5;
}

template <int dim>
NodalVectors<dim>
waves(const Lattice<dim> &lattice, const double amplitude)
{
  NodalVectors<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    for (std::size_t i = 0; i < lattice.values().size(); ++i)
      {
        const Point<dim> x = lattice.node(lattice.index(i));
        result[d].push_back(amplitude * (std::sin(2. * x[(d + 1) % dim] + d) + 0.5 * x[d]));
      }
  return result;
}

template <int dim>
std::vector<char>
members(const NodeSet<dim> &nodes, const std::size_t n_values)
{
  std::vector<char> result(n_values, 0);
  std::size_t       n_nodes = 0;
  for (const NodeRun &run : nodes.runs)
    {
      EXPECT_EQ(run.packed, n_nodes);
      n_nodes += run.n;
      for (int i = 0; i < run.n; ++i)
        result[run.node + i] = 1;
    }
  EXPECT_EQ(n_nodes, nodes.n_nodes);
  return result;
}

// All nodes up to the half width are there and none 8 spacings farther.
template <int dim>
void
check_members(const int n, const double half_width, const bool reaches_ends)
{
  const auto          lattice = sampled<dim>(1. / n, 1, ball<dim>);
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const auto         &phi       = lattice.values();
  const NodeSet<dim>  nodes     = nodes_near_contour<dim>(grid, phi, half_width);
  const auto          is_member = members(nodes, phi.size());
  for (std::size_t i = 0; i < phi.size(); ++i)
    {
      EXPECT_TRUE(is_member[i] || std::abs(phi[i]) > half_width);
      EXPECT_TRUE(!is_member[i] || std::abs(phi[i]) < half_width + 7.01 * lattice.spacing());
    }
  EXPECT_EQ(nodes.reaches_ends, reaches_ends);

  std::vector<double> with_halo(grid.size(), -7.), back(phi.size(), -7.), packed;
  nodes.load(phi, with_halo.data());
  nodes.store(with_halo.data(), back);
  nodes.pack(phi, packed);
  for (std::size_t i = 0; i < phi.size(); ++i)
    EXPECT_EQ(back[i], is_member[i] ? phi[i] : -7.);
  for (const NodeRun &run : nodes.runs)
    EXPECT_EQ(packed[run.packed + run.n - 1], phi[run.node + run.n - 1]);
}

TEST(NodeSet, HoldsTheNodesNearTheContour)
{
  check_members<2>(40, 0.1, false);
  check_members<2>(40, 0.45, true);
  check_members<3>(30, 0.1, false);
}

// Inside the band minus the reach of its stencils (9 nodes per step of three stages) the values are
// those of all nodes; outside the band nothing changes. `gap` counts nodes along the axes.
template <int dim>
void
check_band(const int n, const IncrementMotion motion, const double amplitude, const int gap)
{
  const auto      start = sampled<dim>(1. / n, 1, ball<dim>);
  auto            all = start, near = start;
  const auto      du = waves<dim>(start, amplitude * start.spacing());
  AdvectionScheme scheme;
  const auto      dense_count = advect_increment<dim>(all, du, motion, scheme);
  scheme.band                 = 12;
  const auto band_count       = advect_increment<dim>(near, du, motion, scheme);
  EXPECT_EQ(dense_count.n_nodes, start.values().size());
  EXPECT_LT(band_count.n_nodes, 0.8 * start.values().size());
  EXPECT_EQ(band_count.n_unconverged, 0u);

  double      difference = 0;
  std::size_t n_same = 0, n_compared = 0;
  for (std::size_t i = 0; i < start.values().size(); ++i)
    {
      n_same += near.values()[i] == start.values()[i];
      if (std::abs(start.values()[i]) < (12 - gap) * start.spacing())
        {
          ++n_compared;
          difference = std::max(difference, std::abs(near.values()[i] - all.values()[i]));
        }
    }
  std::cout << dim << "D: " << band_count.n_nodes << " of " << start.values().size()
            << " nodes, difference " << difference << " at " << n_compared << '\n';
  EXPECT_GE(n_same, start.values().size() - band_count.n_nodes);
  EXPECT_GT(n_compared, 0u);
  EXPECT_LT(difference, 1e-13);
}

TEST(NarrowBand, EqualsTheWholeLatticeNearTheContour)
{
  // one step each: the steps follow the largest velocity on the band and on the lattice
  for (const auto motion : {IncrementMotion::frozen_velocity, IncrementMotion::map_velocity})
    {
      check_band<2>(100, motion, 0.15, 9);
      check_band<3>(30, motion, 0.1, 9);
    }
  check_band<2>(100, IncrementMotion::semi_lagrangian, 2., 0);
  check_band<3>(30, IncrementMotion::semi_lagrangian, 2., 0);
}

// Ten increments on a band of 12 spacings: the frozen values outside do not reach the contour.
TEST(NarrowBand, MovesTheContourLikeTheWholeLattice)
{
  for (const auto motion : {IncrementMotion::map_velocity, IncrementMotion::semi_lagrangian})
    {
      auto            all = sampled<2>(1. / 100, 1, ball<2>), near = all;
      const auto      du = waves<2>(all, 0.3 * all.spacing());
      AdvectionScheme scheme;
      for (int step = 0; step < 10; ++step)
        {
          scheme.band = std::numeric_limits<double>::infinity();
          advect_increment<2>(all, du, motion, scheme);
          scheme.band = 12;
          advect_increment<2>(near, du, motion, scheme);
        }
      double difference = 0;
      for (std::size_t i = 0; i < all.values().size(); ++i)
        if (std::abs(all.values()[i]) < 2 * all.spacing())
          difference = std::max(difference, std::abs(near.values()[i] - all.values()[i]));
      std::cout << "difference/h " << difference / all.spacing() << '\n';
      EXPECT_LT(difference, 1e-4 * all.spacing());
    }
}
} // namespace
} // namespace scree
