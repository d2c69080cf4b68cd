#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/combined_shape.h>
#include <scree/geometry/expression_shape.h>
#include <scree/geometry/half_space.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/geometry/moved_shape.h>
#include <scree/geometry/superellipse.h>
#include <scree/level_set/node_search.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
LatticeFrame<dim>
frame(const double spacing, const double extent)
{
  LatticeFrame<dim> result;
  result.spacing = spacing;
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = -extent;
      upper[d] = extent;
    }
  result.origin = lower;
  result.box    = BoundingBox<dim>({lower, upper});
  return result;
}

// The area where the bilinear interpolant is negative, by midpoints of 4 x 4 parts per spacing.
double
area(const Lattice<2> &lattice)
{
  const double h      = lattice.spacing() / 4;
  const auto   corner = lattice.box().get_boundary_points().first;
  double       sum    = 0;
  for (int i = 0; i < 4 * (lattice.n_nodes()[0] - 1); ++i)
    for (int j = 0; j < 4 * (lattice.n_nodes()[1] - 1); ++j)
      {
        const Point<2> x(corner[0] + (i + 0.5) * h, corner[1] + (j + 0.5) * h);
        // A step smoothed over the part.
        sum += std::clamp(0.5 - lattice.value(x, 1) / h, 0., 1.) * h * h;
      }
  return sum;
}

// The lattice of a shape that the caller keeps.
template <int dim>
Lattice<dim>
lattice_of(const Shape<dim> &shape, const LatticeFrame<dim> &frame, const double margin,
           const std::string &where = "Shape", const double most_nodes = largest_dense_lattice)
{
  return make_lattice(std::shared_ptr<const Shape<dim>>(std::shared_ptr<void>(), &shape), frame,
                      margin, where, most_nodes);
}

TEST(LevelSetFromShape, CoversTheShapeWithMarginAndCompleteCells)
{
  const Ball<2> disc(Point<2>(0.13, 0.21), 0.35);
  const auto    lattice = lattice_of<2>(disc, frame<2>(0.05, 2), 0.4);
  for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(lattice.lower()[d] % 2, 0);
      EXPECT_EQ(lattice.n_nodes()[d] % 2, 1);
      EXPECT_LE(lattice.box().lower_bound(d), disc.bounding_box().lower_bound(d) - 0.4);
      EXPECT_GE(lattice.box().lower_bound(d), disc.bounding_box().lower_bound(d) - 0.5 - 1e-9);
      EXPECT_GE(lattice.box().upper_bound(d), disc.bounding_box().upper_bound(d) + 0.4);
    }
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    EXPECT_EQ(lattice.values()[i], disc.signed_distance(lattice.node(lattice.index(i))));
}

TEST(LevelSetFromShape, IsClippedByTheFrameButNotItsValues)
{
  const HalfSpace<3> shape(Point<3>(0, 0, 0.1), Tensor<1, 3>({0, 0, 1}));
  const auto         lattice = lattice_of<3>(shape, frame<3>(0.1, 0.5), 0);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(lattice.box().lower_bound(d), -1.1, 1e-12);
  EXPECT_NEAR(lattice.box().upper_bound(0), 1.1, 1e-12);
  EXPECT_NEAR(lattice.box().upper_bound(2), 0.7, 1e-12);
  EXPECT_NEAR(lattice.value({0.9, -0.9, 0.7}, 1), 0.6, 1e-12);
}

// Distances of a superellipse against its dense sampling, with order 2.
TEST(LevelSetFromShape, SuperellipseBecomesADistanceOfSecondOrder)
{
  const double          a = 0.8, b = 0.5, n = 4;
  std::vector<Point<2>> boundary;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const double t = 2 * M_PI * i / 20000, c = std::cos(t), s = std::sin(t);
      boundary.emplace_back(a * std::copysign(std::sqrt(std::abs(c)), c),
                            b * std::copysign(std::sqrt(std::abs(s)), s));
    }
  std::array<double, 2> error{};
  for (const int level : {0, 1})
    {
      const auto lattice = lattice_of<2>(Superellipse<2>(Point<2>(), Point<2>(a, b), n),
                                         frame<2>(0.05 / (1 << level), 2), 0.3);
      for (double x = -1; x <= 1; x += 0.1)
        for (double y = -0.7; y <= 0.7; y += 0.1)
          {
            if (std::abs(x) < 0.45 && std::abs(y) < 0.2)
              continue; // the medial axis
            double distance = 10;
            for (const Point<2> &p : boundary)
              distance = std::min(distance, p.distance_square(Point<2>(x, y)));
            distance           = std::sqrt(distance);
            const double value = std::abs(lattice.nodal_value({x, y}));
            if (distance > 0.02)
              error[level] = std::max(error[level], std::abs(value - distance));
          }
    }
  EXPECT_LT(error[1], 1.5e-3);
  EXPECT_GT(std::log2(error[0] / error[1]), 1.6);
}

TEST(LevelSetFromShape, CombinationsKeepTheirArea)
{
  const auto parts = [] {
    std::vector<ShapePointer<2>> result;
    result.push_back(std::make_unique<Ball<2>>(Point<2>(-0.3, 0), 0.6));
    result.push_back(std::make_unique<Ball<2>>(Point<2>(0.3, 0), 0.6));
    return result;
  };
  const double r = 0.6, d = 0.6;
  const double lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
  const double disc = M_PI * r * r;
  for (const auto &[type, exact] : {std::make_pair(Combination::union_of, 2 * disc - lens),
                                    std::make_pair(Combination::intersection, lens),
                                    std::make_pair(Combination::difference, disc - lens)})
    {
      const auto lattice = lattice_of<2>(CombinedShape<2>(type, parts()), frame<2>(0.02, 2), 0.2);
      EXPECT_NEAR(area(lattice), exact, 3e-3 * exact);
    }
}

// An expression has no bounding box; its lattice covers what is negative.
TEST(LevelSetFromShape, ExpressionsAreTrimmedAndReinitialised)
{
  const ExpressionShape<2> shape(Expression<2>("(x - 1)^2 + y^2 - 0.25", 1, "Expression"), false);
  const auto               lattice = lattice_of<2>(shape, frame<2>(0.05, 4), 0.3);
  EXPECT_NEAR(lattice.box().lower_bound(0), 0.2, 0.11);
  EXPECT_NEAR(lattice.box().upper_bound(1), 0.8, 0.11);
  EXPECT_EQ(lattice.lower()[0] % 2, 0);
  EXPECT_EQ(lattice.n_nodes()[0] % 2, 1);
  EXPECT_NEAR(lattice.value({1.6, 0.4}, 3), std::hypot(0.6, 0.4) - 0.5, 1e-3);
  EXPECT_NEAR(lattice.value({1.5, 0}, 3), 0, 1e-5);
}

TEST(LevelSetFromShape, ShapesOutsideTheGridAreTold)
{
  const auto expect_error = [](const Shape<2> &shape, const std::string &part) {
    try
      {
        lattice_of<2>(shape, frame<2>(0.1, 1), 0, "Bodies/a/Shape");
        ADD_FAILURE() << "no error";
      }
    catch (const UserError &error)
      {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("Bodies/a/Shape"), std::string::npos);
      }
  };
  expect_error(Ball<2>(Point<2>(3, 0), 1), "outside the background grid");
  expect_error(Ball<2>(Point<2>(0.05, 0.05), 0.01), "contains no node");
  expect_error(ExpressionShape<2>(Expression<2>("x^2 + 1", 1, "Expression"), false),
               "contains no node");
}

// A body may fill the whole grid.
TEST(LevelSetFromShape, ABodyMayFillTheGrid)
{
  const auto lattice = lattice_of<2>(
    ExpressionShape<2>(Expression<2>("-1", 1, "Expression"), false), frame<2>(0.1, 1), 0);
  EXPECT_EQ(lattice.value({0.3, 0.4}, 2), -1);
}
TEST(LevelSetFromShape, ThicknessOfThinBodies)
{
  const double h = 0.1;
  for (const double angle : {0., 0.5})
    {
      const Tensor<2, 2> R(
        {{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}});
      const MovedShape<2> sheet(std::make_unique<Box<2>>(Point<2>(-0.7, 0.02), Point<2>(0.7, 0.17)),
                                R, Point<2>(), Tensor<1, 2>());
      EXPECT_NEAR(inscribed_radius(sheet, lattice_of<2>(sheet, frame<2>(h, 1), 0.3)), 0.075, 1e-6);
    }
  const ExpressionShape<2> scaled(Expression<2>("1000*max(-y, y - 0.12)", 1, "Expression"), false);
  EXPECT_NEAR(inscribed_radius(scaled, lattice_of<2>(scaled, frame<2>(h, 1), 0.3)), 0.06, 1e-4);
  // One spacing, between two lines of nodes.
  const Box<2> fitted(Point<2>(-0.5, 0.2), Point<2>(0.5, 0.3));
  EXPECT_NEAR(inscribed_radius(fitted, lattice_of<2>(fitted, frame<2>(h, 1), 0.3)), 0.05, 1e-6);
}

// A distance gives the same numbers whether all nodes are stored at once or none.
template <int dim>
void
expect_same(const Shape<dim> &shape, const double h)
{
  const auto dense = lattice_of<dim>(shape, frame<dim>(h, 1), 6 * h),
             asked = lattice_of<dim>(shape, frame<dim>(h, 1), 6 * h, "Shape", 0.);
  EXPECT_FALSE(dense.is_tiled());
  EXPECT_TRUE(asked.is_tiled());
  EXPECT_TRUE(asked.values().empty());
  EXPECT_EQ(asked.lower(), dense.lower());
  EXPECT_EQ(asked.n_nodes(), dense.n_nodes());
  EXPECT_EQ(inscribed_radius(shape, asked), inscribed_radius(shape, dense));
  for (std::size_t i = 0; i < dense.values().size(); ++i)
    {
      EXPECT_EQ(std::as_const(asked)(dense.index(i)), dense.values()[i]);
      EXPECT_EQ(dense.values()[i], shape.signed_distance(dense.node(dense.index(i))));
    }
}

TEST(LevelSetFromShape, IsTheSameWhereItIsAsked)
{
  expect_same<2>(Ball<2>(Point<2>(0.13, 0.21), 0.35), 0.02);
  expect_same<2>(HalfSpace<2>(Point<2>(0, 0.1), Tensor<1, 2>({0.6, 0.8})), 0.02);
  expect_same<2>(Box<2>(Point<2>(-0.5, 0.1), Point<2>(0.7, 0.3)), 0.02);
  expect_same<3>(Ball<3>(Point<3>(0.13, 0.21, 0.1), 0.35), 0.05);
  expect_same<3>(ExpressionShape<3>(
                   Expression<3>("sqrt((x - 0.3)^2 + y^2) + abs(z) - 0.5", 1, "Expression"), true),
                 0.05);
}

// The box of a body is found without a look at all of its nodes.
TEST(LevelSetFromShape, SearchesTheNodesOfTheSurface)
{
  const double     h       = 1. / 512;
  const NodeBox<3> box     = node_box(frame<3>(h, 1), Point<3>(-1, -1, -1), Point<3>(1, 1, 1));
  unsigned int     n_asked = 0;
  const auto       found   = box_of_negative_nodes<3>(frame<3>(h, 1), box, [&](const Point<3> &x) {
    ++n_asked;
    return x.norm() - 0.7;
  });
  ASSERT_TRUE(found.has_value());
  for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_EQ(found->n_nodes[d], 2 * static_cast<int>(0.7 / h) + 1);
      EXPECT_EQ(2 * found->lower[d] + found->n_nodes[d], 2 * box.lower[d] + box.n_nodes[d]);
    }
  std::cout << n_asked << " of " << std::pow(1025., 3) << " nodes\n";
  EXPECT_LT(n_asked, 4 * numbers::PI * std::pow(0.7 / h, 2));
}

// A ball of 320 spacings: more nodes than a dense lattice may have.
TEST(LevelSetFromShape, StoresTilesOfABigBody)
{
  const double  h = 1. / 320;
  const Ball<3> ball(Point<3>(0.1, 0, 0), 0.5);
  const auto    lattice = lattice_of<3>(ball, frame<3>(h, 2), 6 * h);
  EXPECT_TRUE(lattice.is_tiled());
  for (unsigned int i = 0; i < 1000; ++i)
    {
      Tensor<1, 3> ray({std::sin(0.3 + 7.1 * i), std::cos(2.2 * i), std::sin(3.3 * i)});
      ray /= ray.norm();
      const Point<3> x = Point<3>(0.1, 0, 0) + (0.5 + 5 * h * std::sin(1.7 * i)) * ray;
      EXPECT_NEAR(lattice.value(x, 3), ball.signed_distance(x), 1e-4 * h);
    }
  EXPECT_LT(lattice.values().size(), 1e6);
  EXPECT_NEAR(lattice.value(Point<3>(0.1, 0.02, 0), 2), -0.48, 1e-3 * h);
}
} // namespace
} // namespace scree
