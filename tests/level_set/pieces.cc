// Connected pieces.
#include <gtest/gtest.h>

#include <scree/level_set/pieces.h>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
void
check_two_balls()
{
  Point<dim> left, right;
  left[0]          = -0.5;
  right[0]         = 0.45;
  const auto   phi = sampled<dim>(0.1, 1, [&](const Point<dim> &x) {
    return std::min(x.distance(left) - 0.3, x.distance(right) - 0.4);
  });
  const Pieces two = negative_pieces(phi);
  EXPECT_EQ(two.n, 2u);
  for (std::size_t i = 0; i < phi.values().size(); ++i)
    EXPECT_EQ(two.of_node[i], phi.values()[i] >= 0             ? 0u
                              : phi.node(phi.index(i))[0] < 0. ? two.of_node[phi.offset({{-5}})]
                                                               : two.of_node[phi.offset({{4}})]);
  EXPECT_NE(two.of_node[phi.offset({{-5}})], two.of_node[phi.offset({{4}})]);
  const auto joined
    = sampled<dim>(0.1, 1, [&](const Point<dim> &x) { return std::abs(x[1]) - 0.05; });
  EXPECT_EQ(negative_pieces(joined).n, 1u);
}

TEST(Pieces, OfTwoBalls)
{
  check_two_balls<2>();
  check_two_balls<3>();
}
} // namespace
} // namespace scree
