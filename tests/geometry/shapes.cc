#include <gtest/gtest.h>

#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/capsule.h>
#include <scree/geometry/combined_shape.h>
#include <scree/geometry/ellipse.h>
#include <scree/geometry/expression_shape.h>
#include <scree/geometry/half_space.h>
#include <scree/geometry/moved_shape.h>
#include <scree/geometry/polygon.h>
#include <scree/geometry/ring.h>
#include <scree/geometry/rounded_polygon.h>
#include <scree/geometry/superellipse.h>

#include <cmath>
#include <functional>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
using Boundary = std::vector<Point<dim>>;

// Points spread over a cube around the origin.
template <int dim>
std::vector<Point<dim>>
scattered_points(const unsigned int n, const double extent)
{
  std::vector<Point<dim>> points(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int d = 0; d < dim; ++d)
      points[i][d] = extent
                     * (2
                          * std::fmod((i + 1)
                                        * (d == 0   ? 0.754877666
                                           : d == 1 ? 0.569840291
                                                    : 0.362151),
                                      1.)
                        - 1);
  return points;
}

// The size of signed_distance() is the distance to a dense sampling of the boundary, its sign tells
// what is inside, and its gradient has length 1 (almost everywhere).
template <int dim>
void
check_shape(const Shape<dim> &shape, const Boundary<dim> &boundary, const double sampling_error,
            const std::function<bool(const Point<dim> &)> &inside)
{
  ASSERT_TRUE(shape.is_distance());
  unsigned int n_kinks = 0, n_inside = 0;
  const auto   points = scattered_points<dim>(dim == 2 ? 400 : 100, 2.5);
  for (const Point<dim> &x : points)
    {
      const double phi      = shape.signed_distance(x);
      double       distance = 1e10;
      for (const Point<dim> &y : boundary)
        distance = std::min(distance, x.distance_square(y));
      distance = std::sqrt(distance);
      EXPECT_LT(std::abs(phi), distance + 1e-12) << x;
      EXPECT_GT(std::abs(phi),
                distance - sampling_error * std::min(1., sampling_error / distance) - 1e-12)
        << x;
      EXPECT_EQ(phi < 0, inside(x)) << x;
      n_inside += phi < 0;

      Tensor<1, dim> gradient;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> forward = x, backward = x;
          forward[d] += 1e-5;
          backward[d] -= 1e-5;
          gradient[d] = (shape.signed_distance(forward) - shape.signed_distance(backward)) / 2e-5;
        }
      n_kinks += std::abs(gradient.norm() - 1) > 1e-6;
    }
  EXPECT_LE(n_kinks, points.size() / 100);
  EXPECT_GT(n_inside, 0u);
  for (const Point<dim> &y : boundary)
    {
      EXPECT_LT(std::abs(shape.signed_distance(y)), 1e-12);
      EXPECT_TRUE(shape.bounding_box().point_inside(y, 1e-9));
    }
}

Boundary<2>
curve(const unsigned int n, const std::function<Point<2>(double)> &at)
{
  Boundary<2> points;
  for (unsigned int i = 0; i < n; ++i)
    points.push_back(at(2 * M_PI * i / n));
  return points;
}

void
add_segment(Boundary<2> &points, const Point<2> &a, const Point<2> &b)
{
  for (unsigned int i = 0; i <= 1000; ++i)
    points.push_back(a + i / 1000. * (b - a));
}

TEST(Shapes, Disc)
{
  const Point<2> centre(0.3, -0.2);
  check_shape<2>(
    Ball<2>(centre, 1.3),
    curve(10000, [&](double t) { return centre + 1.3 * Point<2>(std::cos(t), std::sin(t)); }), 1e-3,
    [&](const Point<2> &x) { return x.distance(centre) < 1.3; });
}

TEST(Shapes, BoxAndPolygonAgree)
{
  const Point<2> lower(-0.4, -1.1), upper(1.3, 0.7);
  Boundary<2>    boundary;
  add_segment(boundary, lower, {upper[0], lower[1]});
  add_segment(boundary, lower, {lower[0], upper[1]});
  add_segment(boundary, upper, {upper[0], lower[1]});
  add_segment(boundary, upper, {lower[0], upper[1]});
  const auto inside = [&](const Point<2> &x) {
    return x[0] > lower[0] && x[1] > lower[1] && x[0] < upper[0] && x[1] < upper[1];
  };
  check_shape<2>(Box<2>(lower, upper), boundary, 1e-2, inside);
  check_shape<2>(Polygon({lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}}), boundary,
                 1e-2, inside);
  check_shape<2>(Polygon({lower, {lower[0], upper[1]}, upper, {upper[0], lower[1]}}), boundary,
                 1e-2, inside); // clockwise

  const Box<3> box(Point<3>(-1, -0.5, 0), Point<3>(1, 0.5, 2));
  EXPECT_NEAR(box.signed_distance({2, 1.5, 3}), std::sqrt(3.), 1e-14);
  EXPECT_NEAR(box.signed_distance({0.8, 0.1, 1}), -0.2, 1e-14);
  EXPECT_NEAR(box.signed_distance({1.5, 0.1, 1}), 0.5, 1e-14);
}

TEST(Shapes, ConcavePolygon)
{
  // An arrow head with a re-entrant corner at the origin.
  const std::vector<Point<2>> vertices = {{-1.5, -1}, {0, 0}, {1.5, -1}, {0, 2}};
  Boundary<2>                 boundary;
  for (unsigned int i = 0; i < 4; ++i)
    add_segment(boundary, vertices[i], vertices[(i + 1) % 4]);
  check_shape<2>(Polygon(vertices), boundary, 1e-2, [](const Point<2> &x) {
    return x[1] > -std::abs(x[0]) * 2 / 3 && x[1] < 2 - 2 * std::abs(x[0]);
  });
}

// A star of many sides: distances by the tree are those of all sides, in a time that does not grow
// with their square.
void
add_arc(Boundary<2> &points, const Point<2> &centre, const double radius, const double from)
{
  for (unsigned int i = 0; i <= 1000; ++i)
    {
      const double t = from + 0.5 * M_PI * i / 1000.;
      points.push_back(centre + radius * Point<2>(std::cos(t), std::sin(t)));
    }
}

TEST(Shapes, RoundCorners)
{
  const double         r = 0.3;
  const Point<2>       lower(-0.4, -1.1), upper(1.3, 0.7);
  const Box<2>         box(lower, upper, r);
  const RoundedPolygon polygon({lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}}, r),
    clockwise({lower, {lower[0], upper[1]}, upper, {upper[0], lower[1]}}, r);
  for (const Point<2> &x : scattered_points<2>(400, 2.5))
    {
      EXPECT_NEAR(box.signed_distance(x), polygon.signed_distance(x), 1e-13) << x;
      EXPECT_NEAR(box.signed_distance(x), clockwise.signed_distance(x), 1e-13) << x;
    }
  EXPECT_NEAR(box.signed_distance({2.3, 1.7}), std::sqrt(2.) * 1.3 - 0.3, 1e-14);

  const Box<3> space(Point<3>(-1, -0.5, 0), Point<3>(1, 0.5, 2), 0.2);
  EXPECT_NEAR(space.signed_distance({2, 1.5, 3}), std::sqrt(3.) * 1.2 - 0.2, 1e-14);
  EXPECT_NEAR(space.signed_distance({2, 1.5, 1}), std::sqrt(2.) * 1.2 - 0.2, 1e-14);
  EXPECT_NEAR(space.signed_distance({0.9, 0.4, 1}), std::sqrt(0.02) - 0.2, 1e-14);
  EXPECT_NEAR(space.signed_distance({0.8, 0.1, 1}), -0.2, 1e-14);
  EXPECT_TRUE(space.is_smooth());
}

TEST(Shapes, RoundCornersOfConcavePolygon)
{
  // The letter L, its corners at (-1, -1), (1, -1), (1, 0), (0, 0), (0, 1), (-1, 1).
  const double                r        = 0.3;
  const std::vector<Point<2>> vertices = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
  Boundary<2>                 boundary;
  const std::vector<std::pair<Point<2>, double>> arcs
    = {{{-0.7, -0.7}, M_PI}, {{0.7, -0.7}, 1.5 * M_PI}, {{0.7, -0.3}, 0.},
       {{0.3, 0.3}, M_PI},   {{-0.3, 0.7}, 0.},         {{-0.7, 0.7}, 0.5 * M_PI}};
  for (const auto &[centre, from] : arcs)
    add_arc(boundary, centre, r, from);
  add_segment(boundary, {-0.7, -1}, {0.7, -1});
  add_segment(boundary, {1, -0.7}, {1, -0.3});
  add_segment(boundary, {0.7, 0}, {0.3, 0});
  add_segment(boundary, {0, 0.3}, {0, 0.7});
  add_segment(boundary, {-0.3, 1}, {-0.7, 1});
  add_segment(boundary, {-1, 0.7}, {-1, -0.7});
  const auto inside = [&](const Point<2> &x) {
    bool result = x[0] > -1 && x[1] > -1 && x[0] < 1 && x[1] < 1 && (x[0] < 0 || x[1] < 0);
    for (const auto &[centre, from] : arcs)
      {
        // Beyond the centre, as seen from the corner's quadrant.
        const Tensor<1, 2> ray = x - centre;
        const double       c = std::cos(from + 0.25 * M_PI), s = std::sin(from + 0.25 * M_PI);
        const bool         is_beyond
          = ray[0] * c > 0 && ray[1] * s > 0 && std::abs(ray[0]) < r && std::abs(ray[1]) < r;
        if (is_beyond)
          result = (ray.norm() < r) == (centre != Point<2>(0.3, 0.3));
      }
    return result;
  };
  ASSERT_EQ(RoundedPolygon::what_does_not_fit(vertices, r), "");
  check_shape<2>(RoundedPolygon(vertices, r), boundary, 1e-2, inside);
  EXPECT_NE(RoundedPolygon::what_does_not_fit(vertices, 0.6), "");
  // Straight angles stay, arcs may fill the sides: a disc.
  const RoundedPolygon disc({{-1, -1}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}}, 1.);
  for (const Point<2> &x : scattered_points<2>(100, 2.5))
    EXPECT_NEAR(disc.signed_distance(x), x.norm() - 1., 1e-13) << x;
}

TEST(Shapes, RoundCornersThatMeetOtherSidesAreRecognised)
{
  // A notch reaches close to the corner at (2, 0).
  const std::vector<Point<2>> vertices
    = {{0, 0}, {2, 0}, {2, 2}, {1.9, 2}, {1.9, 0.1}, {1.8, 2}, {0, 2}};
  EXPECT_EQ(RoundedPolygon::what_does_not_fit(vertices, 0.001), "");
  EXPECT_NE(RoundedPolygon::what_does_not_fit(vertices, 0.6), "");
}

TEST(Shapes, PolygonOfManySides)
{
  const auto star = [](const unsigned int n) {
    std::vector<Point<2>> vertices;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double angle = 2. * M_PI * i / n, r = 1. + 0.3 * std::sin(5. * angle) + 0.1 * (i % 2);
        vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
      }
    return vertices;
  };
  const auto    vertices = star(57);
  const Polygon polygon(vertices);
  for (unsigned int k = 0; k < 2000; ++k)
    {
      const Point<2> x(1.6 * std::sin(1.3 * k), 1.6 * std::cos(2.9 * k));
      double         distance = 1e300, winding = 0.;
      for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          const Point<2> &a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
          const double    s    = std::clamp((x - a) * (b - a) / (b - a).norm_square(), 0., 1.);
          distance             = std::min(distance, x.distance(a + s * (b - a)));
          const Tensor<1, 2> p = a - x, q = b - x;
          winding += std::atan2(p[0] * q[1] - p[1] * q[0], p * q);
        }
      EXPECT_NEAR(polygon.signed_distance(x), std::abs(winding) > 1. ? -distance : distance, 1e-14);
    }
  const auto many = star(20000);
  EXPECT_FALSE(Polygon::crosses_itself(many));
  auto crossed = many;
  std::swap(crossed[100], crossed[15000]);
  EXPECT_TRUE(Polygon::crosses_itself(crossed));
  const Polygon fine(many);
  double        sum = 0.;
  for (unsigned int k = 0; k < 100000; ++k)
    sum += fine.signed_distance(Point<2>(1.6 * std::sin(1.3 * k), 1.6 * std::cos(2.9 * k)));
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(Shapes, PolygonsThatCrossThemselvesAreRecognised)
{
  EXPECT_FALSE(Polygon::crosses_itself({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_TRUE(Polygon::crosses_itself({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));         // bow tie
  EXPECT_TRUE(Polygon::crosses_itself({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));         // repeated
  EXPECT_TRUE(Polygon::crosses_itself({{0, 0}, {2, 0}, {1, 0}, {1, 1}}));         // folded back
  EXPECT_TRUE(Polygon::crosses_itself({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}})); // vertex on side
  EXPECT_FALSE(Polygon::crosses_itself({{0, 0}, {1, 0}, {2, 0}, {2, 1}}));        // straight angle
}

TEST(Shapes, HalfSpace)
{
  const HalfSpace<2> shape(Point<2>(1, 1), Tensor<1, 2>({3, 4}));
  EXPECT_NEAR(shape.signed_distance({1.6, 1.8}), 1, 1e-14);
  EXPECT_NEAR(shape.signed_distance({1 - 0.6 - 4, 1 - 0.8 + 3}), -1, 1e-14);
  EXPECT_GT(shape.bounding_box().upper_bound(0), 1e200);
  const auto box = HalfSpace<2>(Point<2>(1, -0.5), Tensor<1, 2>({0, 2})).bounding_box();
  EXPECT_EQ(box.upper_bound(1), -0.5);
  EXPECT_LT(box.lower_bound(1), -1e200);
}

TEST(Shapes, Ellipse)
{
  for (const Point<2> &axes : {Point<2>(2, 0.5), Point<2>(0.7, 1.9), Point<2>(1.2, 1.2)})
    check_shape<2>(
      Ellipse<2>(Point<2>(0.1, 0), axes),
      curve(20000,
            [&](double t) { return Point<2>(0.1 + axes[0] * std::cos(t), axes[1] * std::sin(t)); }),
      1e-3, [&](const Point<2> &x) {
        return std::pow((x[0] - 0.1) / axes[0], 2) + std::pow(x[1] / axes[1], 2) < 1;
      });
}

// Points on the axes and in the centre, where the equation degenerates, and next to them.
TEST(Shapes, EllipseOnItsAxes)
{
  const Ellipse<2> ellipse(Point<2>(), Point<2>(2, 1));
  EXPECT_NEAR(ellipse.signed_distance({0, 0}), -1, 1e-14);
  EXPECT_NEAR(ellipse.signed_distance({0, 3}), 2, 1e-14);
  EXPECT_NEAR(ellipse.signed_distance({3, 0}), 1, 1e-14);
  EXPECT_NEAR(ellipse.signed_distance({1.8, 0}), -0.2, 1e-14); // beyond the centre of curvature
  // (1, 0): the foot is at (4/3, sqrt(5)/3).
  EXPECT_NEAR(ellipse.signed_distance({1, 0}), -std::sqrt(6.) / 3, 1e-14);
  for (const double tiny : {1e-20, 1e-16, 1e-12, 1e-8})
    EXPECT_NEAR(ellipse.signed_distance({1, tiny}), -std::sqrt(6.) / 3, 2 * tiny + 1e-12);

  const Ellipse<3> ellipsoid(Point<3>(), Point<3>(3, 2, 1));
  EXPECT_NEAR(ellipsoid.signed_distance({0, 0, 0}), -1, 1e-14);
  EXPECT_NEAR(ellipsoid.signed_distance({4, 0, 0}), 1, 1e-14);
  EXPECT_NEAR(ellipsoid.signed_distance({2.9, 0, 0}), -0.1, 1e-14);
  EXPECT_NEAR(ellipsoid.signed_distance({0, -2.5, 0}), 0.5, 1e-14);
}

TEST(Shapes, Ellipsoid)
{
  const Point<3> axes(1.7, 0.6, 1.1);
  Boundary<3>    boundary;
  for (unsigned int i = 0; i <= 300; ++i)
    for (unsigned int j = 0; j < 600; ++j)
      {
        const double s = M_PI * i / 300, t = 2 * M_PI * j / 600;
        boundary.emplace_back(axes[0] * std::sin(s) * std::cos(t),
                              axes[1] * std::sin(s) * std::sin(t), axes[2] * std::cos(s));
      }
  check_shape<3>(Ellipse<3>(Point<3>(), axes), boundary, 2e-2, [&](const Point<3> &x) {
    double level = 0;
    for (unsigned int d = 0; d < 3; ++d)
      level += std::pow(x[d] / axes[d], 2);
    return level < 1;
  });
}

TEST(Shapes, Ring)
{
  Boundary<2> boundary;
  for (const double r : {0.6, 1.4})
    for (const Point<2> &x :
         curve(8000, [&](double t) { return Point<2>(r * std::cos(t), r * std::sin(t)); }))
      boundary.push_back(x);
  check_shape<2>(Ring<2>(Point<2>(), 0.6, 1.4), boundary, 2e-3,
                 [](const Point<2> &x) { return x.norm() > 0.6 && x.norm() < 1.4; });
}

TEST(Shapes, Capsule)
{
  const Point<2>     a(-1, -0.5), b(0.8, 0.4);
  const Tensor<1, 2> along = (b - a) / (b - a).norm(), across({-along[1], along[0]});
  Boundary<2>        boundary;
  add_segment(boundary, a + 0.5 * across, b + 0.5 * across);
  add_segment(boundary, a - 0.5 * across, b - 0.5 * across);
  for (unsigned int i = 0; i <= 2000; ++i)
    {
      const double t = M_PI * i / 2000;
      boundary.push_back(b + 0.5 * (std::sin(t) * along + std::cos(t) * across));
      boundary.push_back(a + 0.5 * (-std::sin(t) * along + std::cos(t) * across));
    }
  check_shape<2>(Capsule<2>(a, b, 0.5), boundary, 3e-3, [&](const Point<2> &x) {
    const double s = (x - a) * along;
    return s < 0               ? x.distance(a) < 0.5
           : s > a.distance(b) ? x.distance(b) < 0.5
                               : std::abs((x - a) * across) < 0.5;
  });
  for (const double mirror : {1., -1.})
    {
      const Point<2> p(a[0], mirror * a[1]), q(b[0], mirror * b[1]);
      for (const auto &capsule : {Capsule<2>(p, q, 0.5), Capsule<2>(q, p, 0.5)})
        for (const Point<2> &y : boundary)
          EXPECT_TRUE(capsule.bounding_box().point_inside({y[0], mirror * y[1]}, 1e-12)) << y;
    }
  EXPECT_NEAR(
    Capsule<3>(Point<3>(0, 0, -1), Point<3>(0, 0, 1), 0.25).signed_distance({0.3, 0.4, 0.7}), 0.25,
    1e-14);
}

TEST(Shapes, SuperellipseIsALevelSetOfItsFormula)
{
  const Superellipse<2> shape(Point<2>(0.1, 0.2), Point<2>(2, 0.5), 4);
  EXPECT_FALSE(shape.is_distance());
  EXPECT_NEAR(
    shape.signed_distance({0.1 + 2 * std::pow(0.5, 0.25), 0.2 - 0.5 * std::pow(0.5, 0.25)}), 0,
    1e-14);
  EXPECT_NEAR(shape.signed_distance({4.1, 0.2}), 0.5, 1e-14);
  EXPECT_LT(shape.signed_distance({0.1, 0.2}), 0);
}

TEST(Shapes, MovedShapesTurnCounterClockwiseAboutTheirCentre)
{
  Tensor<2, 2> quarter;
  quarter[0][1] = -1;
  quarter[1][0] = 1;
  const MovedShape<2> shape(std::make_unique<Box<2>>(Point<2>(1, 0), Point<2>(3, 1)), quarter,
                            Point<2>(1, 0), Tensor<1, 2>({10, 20}));
  EXPECT_TRUE(shape.is_distance());
  const auto [lower, upper] = shape.bounding_box().get_boundary_points();
  EXPECT_LT(lower.distance(Point<2>(10, 20)), 1e-12);
  EXPECT_LT(upper.distance(Point<2>(11, 22)), 1e-12);
  EXPECT_NEAR(shape.signed_distance({10.5, 21.75}), -0.25, 1e-12);
  EXPECT_NEAR(shape.signed_distance({10.5, 23}), 1, 1e-12);
}

TEST(Shapes, CombinationsFollowSetAlgebra)
{
  const auto parts = [] {
    std::vector<ShapePointer<2>> result;
    result.push_back(std::make_unique<Ball<2>>(Point<2>(0, 0), 1));
    result.push_back(std::make_unique<Ball<2>>(Point<2>(0.8, 0), 0.7));
    return result;
  };
  const CombinedShape<2> both(Combination::union_of, parts()),
    common(Combination::intersection, parts()), rest(Combination::difference, parts());
  const auto both_parts = parts();
  for (const Point<2> &x : scattered_points<2>(2000, 1.6))
    {
      const bool a = both_parts[0]->signed_distance(x) < 0,
                 b = both_parts[1]->signed_distance(x) < 0;
      EXPECT_EQ(both.signed_distance(x) < 0, a || b);
      EXPECT_EQ(common.signed_distance(x) < 0, a && b);
      EXPECT_EQ(rest.signed_distance(x) < 0, a && !b);
    }
  EXPECT_EQ(both.bounding_box().upper_bound(0), 1.5);
  EXPECT_NEAR(common.bounding_box().lower_bound(0), 0.1, 1e-14);
  EXPECT_EQ(common.bounding_box().upper_bound(0), 1);
  EXPECT_EQ(rest.bounding_box().upper_bound(0), 1);
  EXPECT_FALSE(both.is_distance());
}

TEST(Shapes, Expression)
{
  const ExpressionShape<3> shape(Expression<3>("max(x - 1, y + z)", 1, "Expression"), false);
  EXPECT_NEAR(shape.signed_distance({3, 1, 0.5}), 2, 1e-14);
  EXPECT_NEAR(shape.signed_distance({0, -2, 1.5}), -0.5, 1e-14);
  EXPECT_FALSE(shape.is_distance());
}
} // namespace
} // namespace scree
