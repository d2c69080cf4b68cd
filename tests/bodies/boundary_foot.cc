// Distances to the boundaries of deformed bodies: an affine map of a polygon is a polygon.
#include <gtest/gtest.h>

#include <scree/bodies/boundary_foot.h>
#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/geometry/polygon.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

constexpr double spacing = 0.125;

/** A body that x = F X has deformed. */
template <int dim>
Body<dim>
deformed_body(const std::shared_ptr<const Shape<dim>> &shape, const Tensor<2, dim> &F)
{
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = -2.;
      upper[d] = 2.;
    }
  const BoundingBox<dim>    box({lower, upper});
  const BodyDefinition<dim> definition{
    "body",
    "Bodies/body",
    nullptr,
    nullptr,
    Expression<dim>(dim == 2 ? "0; 0" : "0; 0; 0", dim, "Body force"),
    {},
    0.,
    Expression<dim>(dim == 2 ? "0; 0" : "0; 0; 0", dim, "Gravity"),
    Expression<dim>(dim == 2 ? "0; 0" : "0; 0; 0", dim, "Initial velocity"),
    {}};
  Body<dim> body(definition,
                 {make_lattice<dim>(shape, {lower, spacing, box}, 6. * spacing, "Shape"), box});
  body.shape = shape;
  NodalVectors<dim> u;
  for (std::size_t i = 0; i < body.level_set.values().size(); ++i)
    {
      const Point<dim>     x = body.level_set.node(body.level_set.index(i));
      const Tensor<1, dim> v = x - invert(F) * x;
      for (unsigned int d = 0; d < dim; ++d)
        u[d].push_back(v[d]);
    }
  body.displacement = ExtendedIncrement<dim>(body.level_set, std::move(u));
  return body;
}

/** Compares distances with those of the moved shape at places around a point of its boundary. */
template <int dim>
void
compare(const Body<dim> &body, const Shape<dim> &moved, const Point<dim> &middle)
{
  for (unsigned int i = 0; i < 60; ++i)
    {
      Point<dim> x = middle;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.3 * std::sin(1. + 2.3 * i + 1.7 * d * (i + 1));
      const auto foot = foot_on_boundary(body, x);
      ASSERT_TRUE(foot.has_value()) << x;
      EXPECT_NEAR(foot->distance, moved.signed_distance(x), 1e-6) << x;
      EXPECT_NEAR(moved.signed_distance(foot->point), 0., 1e-6) << x;
      EXPECT_NEAR(foot->normal.norm(), 1., 1e-12);
      EXPECT_LE((x - foot->point - foot->distance * foot->normal).norm(), 1e-5) << x;
    }
}

TEST(BoundaryFoot, CornersOfPolygonsThatAreShearedAndPressed)
{
  const Tensor<2, 2> F({{1.3, 0.4}, {-0.1, 0.6}});
  // An L: five convex corners, a re-entrant one at (0.1, 0.2).
  const std::vector<Point<2>> vertices
    = {{-0.9, -0.8}, {0.8, -0.8}, {0.8, 0.2}, {0.1, 0.2}, {0.1, 0.9}, {-0.9, 0.9}};
  std::vector<Point<2>> moved;
  for (const auto &vertex : vertices)
    moved.emplace_back(F * vertex);
  const Polygon there(moved);
  const auto    body = deformed_body<2>(std::make_shared<Polygon>(vertices), F);
  for (const auto &vertex : moved)
    compare<2>(body, there, vertex);
}

TEST(BoundaryFoot, EdgesAndCornersOfAStretchedBox)
{
  Tensor<2, 3> F;
  F[0][0] = 1.2;
  F[1][1] = 0.7;
  F[2][2] = 0.9;
  const Point<3> lower(-0.7, -0.6, -0.8), upper(0.5, 0.7, 0.6);
  const auto     body = deformed_body<3>(std::make_shared<Box<3>>(lower, upper), F);
  const Box<3>   there(Point<3>(F * lower), Point<3>(F * upper));
  compare<3>(body, there, Point<3>(F * upper));
  compare<3>(body, there, Point<3>(F * Point<3>(0.5, 0.7, 0.)));
}

TEST(BoundaryFoot, LevelSetsOfPressedBoxesAreDistances)
{
  Tensor<2, 2> F;
  F[0][0] = 1.3;
  F[1][1] = 0.5;
  const Point<2>   lower(-0.7, -0.9), upper(0.6, 0.8);
  auto             body = deformed_body<2>(std::make_shared<Box<2>>(lower, upper), F);
  const Box<2>     there(Point<2>(F * lower), Point<2>(F * upper));
  constexpr double reach = 4. * spacing;
  set_moved_distances(body, reach);
  for (std::size_t i = 0; i < body.level_set.values().size(); ++i)
    {
      const Point<2> x        = body.level_set.node(body.level_set.index(i));
      const double   distance = there.signed_distance(x);
      if (std::abs(distance) < reach)
        EXPECT_NEAR(body.level_set.values()[i], distance, 1e-6) << x;
      else
        EXPECT_GE(body.level_set.values()[i] / distance, 0.7) << x;
    }
}

TEST(BoundaryFoot, AStretchedCircle)
{
  // The nearest point of an ellipse on its axis, and on its boundary.
  Tensor<2, 2> F;
  F[0][0]         = 1.2;
  F[1][1]         = 0.8;
  const auto body = deformed_body<2>(std::make_shared<Ball<2>>(Point<2>(), 0.9), F);
  for (const double distance : {-0.1, 0., 0.2})
    {
      const auto foot = foot_on_boundary(body, Point<2>(1.08 + distance, 0.));
      ASSERT_TRUE(foot.has_value());
      EXPECT_NEAR(foot->distance, distance, 1e-6);
      EXPECT_LE((foot->normal - Tensor<1, 2>({1., 0.})).norm(), 1e-6);
    }
}
} // namespace
} // namespace scree
