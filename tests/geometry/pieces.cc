// Smooth pieces: those near a box, their normals, and those active at faces, edges and corners.
#include <gtest/gtest.h>

#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/combined_shape.h>
#include <scree/geometry/ellipse.h>
#include <scree/geometry/expression_shape.h>
#include <scree/geometry/moved_shape.h>
#include <scree/geometry/polygon.h>
#include <scree/geometry/ring.h>
#include <scree/geometry/superellipse.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
unsigned int
n_active(const Shape<dim> &shape, const Point<dim> &x)
{
  return active_pieces(shape, x, 0.01).size();
}

TEST(Pieces, OfABoxAtFacesEdgesAndCorners)
{
  const Box<3> box(Point<3>(0., 0., 0.), Point<3>(1., 2., 3.));
  EXPECT_FALSE(box.is_smooth());
  EXPECT_EQ(n_active<3>(box, Point<3>(1., 1., 1.)), 1u);
  EXPECT_EQ(n_active<3>(box, Point<3>(1., 2., 1.)), 2u);
  EXPECT_EQ(n_active<3>(box, Point<3>(1., 2., 3.)), 3u);
  EXPECT_EQ(n_active<3>(box, Point<3>(.5, 1., 1.)), 0u);
  const auto face = active_pieces<3>(box, Point<3>(1., 1., 1.), 0.01);
  EXPECT_LE((face[0].normal(Point<3>(), 1e-3) - Point<3>(1., 0., 0.)).norm(), 1e-15);
  // A thin box: both sides of it.
  const Box<2> sheet(Point<2>(-1., 0.), Point<2>(1., 0.005));
  EXPECT_EQ(n_active<2>(sheet, Point<2>(0., 0.)), 2u);
}

TEST(Pieces, OfAPolygonInBothOrientations)
{
  std::vector<Point<2>> vertices = {{0., 0.}, {2., 0.}, {2., 2.}, {1., 0.5}, {0., 2.}};
  for (const bool is_reversed : {false, true})
    {
      if (is_reversed)
        std::reverse(vertices.begin(), vertices.end());
      const Polygon polygon(vertices);
      EXPECT_EQ(n_active<2>(polygon, Point<2>(1., 0.5)), 2u);
      EXPECT_EQ(n_active<2>(polygon, Point<2>(1., 0.)), 1u);
      EXPECT_EQ(n_active<2>(polygon, Point<2>(1., 1.)), 0u);
      for (const auto &piece : active_pieces<2>(polygon, Point<2>(2., 0.), 0.01))
        EXPECT_LT(piece.value(Point<2>(1.9, 0.1)), 0.);
    }
}

TEST(Pieces, OfComposedAndMovedShapes)
{
  std::vector<ShapePointer<2>> parts;
  parts.push_back(std::make_unique<Box<2>>(Point<2>(-1., -1.), Point<2>(1., 1.)));
  parts.push_back(std::make_unique<Ball<2>>(Point<2>(1., 0.), 0.5));
  auto notched = std::make_unique<CombinedShape<2>>(Combination::difference, std::move(parts));
  const double        angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  Tensor<2, 2>        R({{c, -s}, {s, c}});
  Tensor<1, 2>        shift({0.2, -0.1});
  const Point<2>      centre(0.4, 0.7);
  const MovedShape<2> shape(std::move(notched), R, centre, shift);
  const auto          moved = [&](const Point<2> &x) { return centre + R * (x - centre) + shift; };
  EXPECT_EQ(n_active<2>(shape, moved({1., 0.5})), 2u);
  EXPECT_EQ(n_active<2>(shape, moved({1., 0.7})), 1u);
  EXPECT_EQ(n_active<2>(shape, moved({1., 0.2})), 0u); // of the box, but cut away
  EXPECT_EQ(n_active<2>(shape, moved({1.5, 0.})), 0u); // of the ball, but outside
  const auto notch = active_pieces<2>(shape, moved({0.5, 0.}), 0.01);
  ASSERT_EQ(notch.size(), 1u);
  EXPECT_FALSE(notch[0].is_plane());
  const Point<2> x = moved({0.5, 0.});
  EXPECT_LE((notch[0].normal(x, 1e-4) - R * Point<2>(1., 0.)).norm(), 1e-6);
  EXPECT_LE(notch[0].foot(moved({0.45, 0.}), 1e-4).distance(x), 1e-9);
}

TEST(Pieces, OfExpressions)
{
  using Texts = std::vector<std::string>;
  EXPECT_EQ(extremum_arguments("max(x - 1, min(-y, (max(y, 2)) ))"),
            Texts({"x - 1", "-y", "y", "2"}));
  EXPECT_EQ(extremum_arguments("max(x, y) + max(x, 1)"), Texts({"max(x, y) + max(x, 1)"}));
  EXPECT_EQ(extremum_arguments(" x^2 + 1 "), Texts({"x^2 + 1"}));
  ShapeParameters<2> parameters;
  parameters.type                             = "expression";
  parameters.values["Expression"]             = std::string("max(100*(x - 1), -y)");
  parameters.values["Expression is distance"] = false;
  const auto shape                            = make_shape(parameters);
  EXPECT_FALSE(shape->is_smooth());
  EXPECT_EQ(n_active<2>(*shape, Point<2>(1., 0.)), 2u);
  EXPECT_EQ(n_active<2>(*shape, Point<2>(1., 1.)), 1u);
  parameters.values["Expression"] = std::string("x^2 + y^2 - 1");
  EXPECT_TRUE(make_shape(parameters)->is_smooth());
}

TEST(Pieces, OfRingsAndDiamonds)
{
  const Ring<2> ring(Point<2>(), 1., 1.005);
  EXPECT_EQ(n_active<2>(ring, Point<2>(1., 0.)), 2u);
  EXPECT_EQ(n_active<2>(Ring<2>(Point<2>(), 1., 2.), Point<2>(1., 0.)), 1u);
  const Superellipse<3> diamond(Point<3>(), Point<3>(1., 2., 3.), 1.);
  EXPECT_EQ(n_active<3>(diamond, Point<3>(1., 0., 0.)), 4u);
  EXPECT_EQ(n_active<3>(diamond, Point<3>(0.5, 1., 0.)), 2u);
  EXPECT_EQ(n_active<3>(diamond, Point<3>(0.25, 1., 0.75)), 1u);
  EXPECT_TRUE(Ellipse<2>(Point<2>(), Point<2>(1., 2.)).is_smooth());
  std::vector<SmoothPiece<2>> pieces;
  Ball<2>(Point<2>(), 1.).append_pieces(BoundingBox<2>({{2., 0.}, {3., 1.}}), pieces);
  EXPECT_TRUE(pieces.empty());
}
} // namespace
} // namespace scree
