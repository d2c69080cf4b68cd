// Level sets of rigid bodies at a pose.
#include <gtest/gtest.h>

#include <scree/bodies/rigid_placement.h>
#include <scree/level_set/closest_point.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <ctime>
#include <iostream>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
LatticeFrame<dim>
frame(const double spacing, const double edge)
{
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = edge;
  return {Point<dim>(), spacing, BoundingBox<dim>({Point<dim>(), upper})};
}

/** A rigid body with the given lines in section Shape; it turns about `hinge` if that is not empty.
 */
template <int dim>
Body<dim>
rigid_body(const std::string &shape, const std::string &hinge, const LatticeFrame<dim> &frame,
           const double margin)
{
  ParameterFile file = ParameterFile::from_string(
    "set Names = it\nsubsection it\nset Material = hard\nsubsection Shape\n" + shape + "\nend\n"
    + (hinge.empty() ? "" : "subsection Motion\nset Reference point = " + hinge + "\nend\n")
    + "end\n");
  ParameterSection section    = file.root();
  const auto       parameters = declare_bodies<dim>(section, {{"hard", {}}});
  file.check();
  MaterialParameters hard;
  hard.law = "rigid";
  std::map<std::string, std::shared_ptr<const Material<dim>>> materials;
  materials["hard"] = make_material<dim>(hard);
  return make_bodies<dim>(parameters, materials, frame, margin).front();
}

/** Turns a body away and back; the lattice must be that of the start, bit for bit. */
template <int dim>
void
check_return(Body<dim> body, const LatticeFrame<dim> &frame, const double margin)
{
  const Body<dim>                   start = body;
  typename RigidPose<dim>::Unknowns q;
  for (unsigned int m = 0; m < q.size(); ++m)
    q[m] = 0.03 * (m + 1.);
  place_rigid_body(body, q, frame, margin);
  EXPECT_EQ(body.pose.unknowns(), q);
  EXPECT_NE(body.level_set.values(), start.level_set.values());
  place_rigid_body(body, {}, frame, margin);
  EXPECT_EQ(body.pose.unknowns(), start.pose.unknowns());
  EXPECT_EQ(body.level_set.lower(), start.level_set.lower());
  EXPECT_EQ(body.level_set.n_nodes(), start.level_set.n_nodes());
  EXPECT_EQ(body.level_set.values(), start.level_set.values());
  EXPECT_TRUE(body.box == start.box);
}

const std::string box_2d
  = "set Type = box\nset Lower corner = 0.8, 0.9\nset Upper corner = 1.3, 1.2";
const std::string plate_2d = "set Type = half space\nset Point = 0, 0.4\nset Normal = 0.1, 1";
const std::string formula_2d
  = "set Type = expression\nset Expression = 2*(x-1)^2 + (y-0.9)^2 - 0.16 + 0.1*x*y";

TEST(RigidPlacement, ZeroPoseRestoresTheLattice)
{
  const auto plane = frame<2>(0.025, 2.);
  for (const std::string &shape : {box_2d, plate_2d, formula_2d})
    check_return(rigid_body<2>(shape, "0.3, 0.2", plane, 0.2), plane, 0.2);
  const auto space = frame<3>(0.05, 2.);
  check_return(
    rigid_body<3>("set Type = ball\nset Centre = 1, 1, 1.8\nset Radius = 0.4", "", space, 0.35),
    space, 0.35);
}

// A box that turns by 30 degrees about a hinge: distances of the turned box at all nodes.
TEST(RigidPlacement, ABoxTurnsAboutAHinge)
{
  const auto   plane = frame<2>(0.025, 2.);
  Body<2>      body  = rigid_body<2>(box_2d, "0.8, 0.9", plane, 0.2);
  const double angle = numbers::PI / 6.;
  place_rigid_body<2>(body, {{0.1, 0.05, angle * body.rigid->radius}}, plane, 0.2);
  const Point<2>     hinge(0.9, 0.95); // moved
  const Tensor<1, 2> along({std::cos(angle), std::sin(angle)}), across({-along[1], along[0]});
  double             largest = 0.;
  for (std::size_t i = 0; i < body.level_set.values().size(); ++i)
    {
      const Tensor<1, 2> r = body.level_set.node(body.level_set.index(i)) - hinge;
      const double a = std::abs(r * along - 0.25) - 0.25, b = std::abs(r * across - 0.15) - 0.15;
      const double exact
        = std::hypot(std::max(a, 0.), std::max(b, 0.)) + std::min(std::max(a, b), 0.);
      largest = std::max(largest, std::abs(body.level_set.values()[i] - exact));
    }
  std::cout << "largest error " << largest << '\n';
  EXPECT_LT(largest, 1e-12);
  EXPECT_NEAR(body.box.lower_bound(0), 0.9 - 0.3 * std::sin(angle), 1e-12);
  EXPECT_NEAR(body.box.upper_bound(1), 0.95 + 0.5 * std::sin(angle) + 0.3 * std::cos(angle), 1e-12);
  EXPECT_LE(body.level_set.box().lower_bound(0), body.box.lower_bound(0) - 0.2);
  EXPECT_GE(body.level_set.box().upper_bound(1), body.box.upper_bound(1) + 0.2);
}

// A shape without a formula for its distance: marched on the new lattice, the contour is exact.
TEST(RigidPlacement, AFormulaMoves)
{
  const auto                   plane = frame<2>(0.025, 2.);
  Body<2>                      body  = rigid_body<2>(formula_2d, "1, 1", plane, 0.2);
  const RigidPose<2>::Unknowns q{{0.21, 0.13, 0.4}};
  place_rigid_body<2>(body, q, plane, 0.2);
  const RigidPose<2> pose(*body.rigid, q);
  double             largest = 0.;
  for (std::size_t i = 0; i < body.level_set.values().size(); ++i)
    if (std::abs(body.level_set.values()[i]) < 0.025)
      {
        const Point<2> x
          = project(body.level_set, body.level_set.node(body.level_set.index(i)), 3).point;
        largest = std::max(largest,
                           std::abs(body.rigid->shape->signed_distance(pose.initial_position(x))));
      }
  std::cout << "the formula on the contour, over h: " << largest / 0.025 << '\n';
  EXPECT_GT(largest, 0.);
  EXPECT_LT(largest, 1e-3 * 0.025);
}

TEST(RigidPlacement, ABodyThatLeavesStaysAway)
{
  const auto plane = frame<2>(0.025, 2.);
  Body<2>    body  = rigid_body<2>(box_2d, "", plane, 0.2);
  for (const double x : {-9., 5., 1.})
    {
      place_rigid_body<2>(body, {{x, 0.3, 0.2}}, plane, 0.2);
      for (const double value : body.level_set.values())
        ASSERT_TRUE(std::isfinite(value));
      double nearest = 10.;
      for (double y = 0.; y <= 2.; y += 0.1)
        for (double z = 0.; z <= 2.; z += 0.1)
          nearest = std::min(nearest, body.level_set.value(Point<2>(y, z), 1));
      if (x != 1.)
        {
          EXPECT_GE(nearest, 0.2);
          EXPECT_LE(body.level_set.values().size(), 49u);
        }
      else
        EXPECT_LT(nearest, -0.05);
    }
}

TEST(RigidPlacement, TheInitialPositionIsTheInverse)
{
  const auto         space = frame<3>(0.05, 2.);
  const Body<3>      body = rigid_body<3>("set Type = ball\nset Centre = 1, 1, 1\nset Radius = 0.4",
                                     "0.3, 0.2, 0.1", space, 0.35);
  const RigidPose<3> pose(*body.rigid, {{0.1, 0.2, -0.3, 0.4, -0.5, 0.6}});
  const Point<3>     X(0.7, -0.2, 1.1);
  EXPECT_LE(pose.initial_position(X + pose.displacement(X)).distance(X), 1e-14);
}

// A plate across 1000 cells.
TEST(ReleaseRigidPlacement, ABigPlateCostsItsSurface)
{
  const auto plane = frame<2>(0.001, 1.);
  Body<2>    body  = rigid_body<2>("set Type = half space\nset Point = 0, 0.5\nset Normal = 0, 1",
                               "0, 0.5", plane, 0.006);
  const std::clock_t start = std::clock();
  place_rigid_body<2>(body, {{0., 0.01, 0.01}}, plane, 0.006);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const auto   n       = body.level_set.n_nodes()[0];
  std::cout << n << " nodes across in " << 1e3 * seconds << " ms\n";
  EXPECT_LT(seconds, 5e-6 * n);
  EXPECT_TRUE(body.level_set.values().empty());
}
} // namespace
} // namespace scree
