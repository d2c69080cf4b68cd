// Displacements at the nodes of a lattice: every place has a value, even what is none; those that
// lack values are told.
#include <gtest/gtest.h>

#include <scree/level_set/extended_increment.h>

#include <cmath>
#include <limits>

namespace scree
{
namespace
{
using namespace dealii;

/** Of a lattice of 5 x 4 nodes from the origin, u = (x, 2 y). */
ExtendedIncrement<2>
stretch(const unsigned int n_values = 20)
{
  const Lattice<2> lattice(LatticeFrame<2>{{}, 0.5, {}}, {{0, 0}}, {{5, 4}});
  NodalVectors<2>  values;
  for (unsigned int i = 0; i < n_values; ++i)
    {
      values[0].push_back(0.5 * (i % 5));
      values[1].push_back(1. * (i / 5));
    }
  return {lattice, std::move(values)};
}

TEST(ExtendedIncrement, IsInterpolatedInsideAndConstantBeyond)
{
  const ExtendedIncrement<2> u = stretch();
  EXPECT_NEAR((u(Point<2>(0.7, 1.1)) - Tensor<1, 2>({0.7, 2.2})).norm(), 0., 1e-14);
  EXPECT_NEAR((u(Point<2>(2., 1.5)) - Tensor<1, 2>({2., 3.})).norm(), 0., 1e-14);
  EXPECT_NEAR((u(Point<2>(-9., 1e300)) - Tensor<1, 2>({0., 3.})).norm(), 0., 1e-14);
}

TEST(ExtendedIncrement, WhatIsNoPlaceHasAValue)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(stretch()(Point<2>(nan, nan)).norm()));
}

TEST(ExtendedIncrement, TellsMissingValues)
{
  const double far = 1e3;
  EXPECT_TRUE(ExtendedIncrement<2>().is_whole(far));
  EXPECT_TRUE(stretch().is_whole(far));
  EXPECT_FALSE(stretch().is_whole(1e-3));
  EXPECT_FALSE(stretch(19).is_whole(far));
  EXPECT_FALSE(stretch(25).is_whole(far));
}
} // namespace
} // namespace scree
