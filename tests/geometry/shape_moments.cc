// Moments of shapes against formulas.
#include <gtest/gtest.h>

#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/shape_moments.h>

#include <cmath>

using namespace scree;
using namespace dealii;

namespace
{
/** A dense lattice around a box whose surface lies anywhere between its nodes. */
template <int dim>
ShapeMoments<dim>
moments(const Shape<dim> &shape, const double spacing)
{
  Point<dim>                   lower, upper;
  typename Lattice<dim>::Index first, n_nodes;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d]   = -2. + 0.013 * d;
      upper[d]   = 2.;
      first[d]   = 0;
      n_nodes[d] = static_cast<int>(4. / spacing) + 1;
    }
  Lattice<dim> lattice({lower, spacing, BoundingBox<dim>({lower, upper})}, first, n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = shape.signed_distance(lattice.node(lattice.index(i)));
  return moments_of(shape, lattice);
}
} // namespace

TEST(ShapeMoments, Disc)
{
  const Point<2> centre(0.31, -0.17);
  const double   r = 1.1, area = numbers::PI * r * r;
  const auto     m = moments<2>(Ball<2>(centre, r), 0.05);
  EXPECT_NEAR(m.volume, area, 5e-5 * area);
  EXPECT_NEAR(m.centre.distance(centre), 0., 1e-5);
  EXPECT_NEAR(m.second[0][0], 0.25 * area * r * r, 1e-4);
  EXPECT_NEAR(m.second[1][1], 0.25 * area * r * r, 1e-4);
  EXPECT_NEAR(m.second[0][1], 0., 1e-5);
}

TEST(ShapeMoments, Box)
{
  const Point<3> lower(-0.73, -0.41, -0.22), upper(0.81, 0.66, 0.37);
  const auto     m      = moments<3>(Box<3>(lower, upper), 0.1);
  double         volume = 1.;
  for (unsigned int d = 0; d < 3; ++d)
    volume *= upper[d] - lower[d];
  EXPECT_NEAR(m.volume, volume, 5e-5 * volume);
  for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_NEAR(m.centre[d], 0.5 * (lower[d] + upper[d]), 5e-5);
      EXPECT_NEAR(m.second[d][d], volume * std::pow(upper[d] - lower[d], 2) / 12., 2e-4 * volume);
      EXPECT_NEAR(m.second[d][(d + 1) % 3], 0., 1e-5);
    }
}
