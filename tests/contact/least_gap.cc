// The point of least gap of contacts narrower than a cell.
#include <gtest/gtest.h>

#include <scree/contact/least_gap.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;

constexpr double gap = 0.004, radius = 1.3;

std::string
text(const double x)
{
  std::ostringstream stream;
  stream.precision(17);
  stream << x;
  return stream.str();
}

/** A disc or ball over a floor at height 0, nearest to it at `foot`; cells of size 0.5. */
template <int dim>
CutBodies<dim>
round_over_floor(const Point<dim> &foot, const unsigned int degree)
{
  std::string centre, lower, upper, cells;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::string separator = d == 0 ? "" : ", ";
      centre += separator + text(foot[d] + (d == dim - 1 ? radius + gap : 0.));
      lower += separator + (d == dim - 1 ? "-0.7" : "-1.5");
      upper += separator + (d == dim - 1 ? "2.3" : "1.5");
      cells += separator + "6";
    }
  return CutBodies<dim>(
    grid_text(lower, upper, cells, 0) + degree_text(degree)
    + bodies_text(
      {{"floor", half_space_text(dim == 2 ? "0, 0" : "0, 0, 0", dim == 2 ? "0, 1" : "0, 0, 1")},
       {"round", shape_text(dim == 2 ? "disc" : "ball",
                            "set Centre = " + centre + "\nset Radius = " + text(radius))}}));
}

template <int dim>
double
least_gap_of_points(const CutBodies<dim> &model)
{
  const ContactPoints<dim> contact = contact_points(model);
  double                   result  = 1.;
  for (const auto &point : contact.points())
    result = std::min(result, point.initial_gap);
  return result;
}

TEST(LeastGap, IsThatOfTheBodiesOnCoarseCells)
{
  for (const double x : {0., 1e-9, 0.013, 0.25, 0.49, 0.5})
    for (const unsigned int degree : {1, 2})
      {
        auto model = round_over_floor(Point<2>(x, 0.), degree);
        EXPECT_NEAR(least_gap_of_points(model), gap, 1e-6 * radius) << x << ' ' << degree;
        for (auto &body : model.bodies)
          body.shape = nullptr; // known on the lattice only
        EXPECT_NEAR(least_gap_of_points(model), gap, degree == 1 ? 6e-3 : 1e-3)
          << x << ' ' << degree;
      }
}

TEST(LeastGap, IsThatOfTheBodiesOnCoarseCells3D)
{
  for (const double x : {0., 0.17})
    EXPECT_NEAR(least_gap_of_points(round_over_floor(Point<3>(x, 0.31, 0.), 1)), gap,
                1e-6 * radius);
}

/** Gauss points of degree 1 in the cell [0, h]^(dim-1) at height `height`. */
template <int dim>
std::vector<ContactPoint<dim>>
gauss_points(const double h, const double height)
{
  std::vector<ContactPoint<dim>> points;
  for (unsigned int q = 0; q < 1u << (dim - 1); ++q)
    {
      ContactPoint<dim> point{0, {}, {}, std::pow(h / 2., dim - 1), 0., h};
      for (unsigned int d = 0; d < dim - 1; ++d)
        point.position[d] = h * (0.5 + ((q >> d & 1) ? 1. : -1.) * std::sqrt(1. / 12.));
      point.position[dim - 1] = height;
      point.normal[dim - 1]   = 1.;
      points.push_back(point);
    }
  return points;
}

/** Sums of w, w x_d over points. */
template <int dim>
std::vector<double>
moments(const std::vector<ContactPoint<dim>> &points)
{
  std::vector<double> result(dim);
  for (const auto &point : points)
    {
      result[0] += point.weight;
      for (unsigned int d = 0; d < dim - 1; ++d)
        result[1 + d] += point.weight * point.position[d];
    }
  return result;
}

template <int dim>
void
expect_equal_moments(const Point<dim> &foot)
{
  constexpr double          h     = 0.5;
  const auto                model = round_over_floor(foot, 1);
  const ExactDistances<dim> distances(model.bodies, h);
  const ContactPair         pair{0, 1, "floor-round", {}};
  auto                      points = gauss_points<dim>(h, 0.5 * gap);
  for (auto &point : points)
    point.initial_gap = distances.value(0, point.position) + distances.value(1, point.position);
  GridCell<dim> cell = model.grid.cells().front();
  cell.lower         = Point<dim>();
  cell.lower[dim - 1] -= 0.2;
  cell.size           = h;
  const auto before   = moments(points);
  const auto n_before = points.size();
  LeastGap<dim>(distances, model.bodies, pair).add_point(cell, points);
  ASSERT_EQ(points.size(), n_before + 1);
  EXPECT_NEAR(points.back().initial_gap, gap, 1e-9);
  for (unsigned int d = 0; d < dim - 1; ++d)
    EXPECT_NEAR(points.back().position[d], foot[d], 1e-6 * h);
  const auto after = moments(points);
  for (unsigned int i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], before[i], 1e-9 * before[0]);
  for (const auto &point : points)
    EXPECT_GT(point.weight, 0.05 * before[0] / n_before);
}

TEST(LeastGap, IntegratesLinearFunctionsAsBefore)
{
  for (const double x : {0., 0.09, 0.25, 0.41, 0.5})
    {
      expect_equal_moments(Point<2>(x, 0.));
      expect_equal_moments(Point<3>(x, 0.2, 0.));
    }
}

TEST(LeastGap, HasNoPointBetweenPlanesOrInOtherCells)
{
  constexpr double        h     = 0.5;
  const auto              model = round_over_floor(Point<2>(0.7, 0.), 1);
  const ExactDistances<2> distances(model.bodies, h);
  const ContactPair       pair{0, 1, "floor-round", {}};
  GridCell<2>             cell = model.grid.cells().front();
  cell.lower                   = Point<2>(0., -0.2);
  cell.size                    = h;
  auto points                  = gauss_points<2>(h, 0.1);
  LeastGap<2>(distances, model.bodies, pair).add_point(cell, points);
  EXPECT_EQ(points.size(), 2u);

  const CutBodies<2>      planes(grid_text("-1, -1", "1, 1", "4, 4", 0)
                                 + bodies_text({{"floor", half_space_text("0, 0.05", "0.1, 1")},
                                                {"roof", half_space_text("0, 0.06", "-0.1, -1")}}));
  const ExactDistances<2> of_planes(planes.bodies, h);
  LeastGap<2>(of_planes, planes.bodies, pair).add_point(cell, points);
  EXPECT_EQ(points.size(), 2u);
}
} // namespace
} // namespace scree
