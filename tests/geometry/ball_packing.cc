#include <gtest/gtest.h>

#include <scree/geometry/ball_packing.h>

#include <cmath>
#include <iostream>

namespace scree
{
namespace
{
using namespace dealii;

/** Checks a packing: in the box, without overlap, dense; most balls touch others. */
template <int dim>
void
check_packing(const PackingParameters<dim> &parameters, const double least_fraction)
{
  const auto balls = pack_balls(parameters);
  ASSERT_EQ(balls.size(), parameters.n);
  double       volume = 0., least_gap = 1e300, smallest = 1e300, largest = 0.;
  unsigned int n_touching = 0;
  for (const auto &ball : balls)
    {
      volume += (dim == 2 ? 1. : 4. / 3. * ball.radius) * ball.radius * ball.radius * numbers::PI;
      smallest = std::min(smallest, ball.radius);
      largest  = std::max(largest, ball.radius);
    }
  for (const auto &ball : balls)
    {
      double gap = 1e300;
      for (unsigned int d = 0; d < dim; ++d)
        gap = std::min({gap, ball.centre[d] - parameters.box.lower_bound(d) - ball.radius,
                        parameters.box.upper_bound(d) - ball.centre[d] - ball.radius});
      for (const auto &other : balls)
        if (&other != &ball)
          gap = std::min(gap, ball.centre.distance(other.centre) - ball.radius - other.radius);
      least_gap = std::min(least_gap, gap);
      n_touching += gap < 1e-2 * smallest;
    }
  const double fraction = volume / parameters.box.volume();
  std::cout << dim << "D: " << parameters.n << " balls fill " << fraction << ", " << n_touching
            << " touch\n";
  EXPECT_GT(fraction, least_fraction);
  EXPECT_NEAR(least_gap, 0., 1e-12);
  EXPECT_GT(n_touching, 0.8 * parameters.n);
  EXPECT_LE(largest / smallest, parameters.size_ratio * (1 + 1e-12));
}

TEST(BallPacking, GrowsUntilBallsTouch)
{
  check_packing<2>({200, BoundingBox<2>({Point<2>(-1, 2), Point<2>(3, 4)}), 1.5, 3}, 0.78);
  check_packing<2>({1, BoundingBox<2>({Point<2>(0, 0), Point<2>(1, 2)}), 1., 1}, 0.35);
  check_packing<2>({1000, BoundingBox<2>({Point<2>(0, 0), Point<2>(1, 1)}), 2., 1}, 0.78);
  check_packing<3>({150, BoundingBox<3>({Point<3>(0, 0, 0), Point<3>(1, 2, 1)}), 1.3, 2}, 0.5);
}

// What mt19937_64 and IEEE arithmetic give, on every machine.
TEST(BallPacking, IsTheSameEverywhere)
{
  const PackingParameters<2> parameters{20, BoundingBox<2>({Point<2>(0, 0), Point<2>(1, 1)}), 2.,
                                        5};
  const auto                 balls = pack_balls(parameters), again = pack_balls(parameters);
  for (unsigned int i = 0; i < 20; ++i)
    {
      EXPECT_EQ(balls[i].centre, again[i].centre);
      EXPECT_EQ(balls[i].radius, again[i].radius);
    }
  EXPECT_EQ(balls[7].centre, Point<2>(0.69132706209694361, 0.42343076526347778));
  EXPECT_EQ(balls[7].radius, 0.11544130952426229);
}
} // namespace
} // namespace scree
