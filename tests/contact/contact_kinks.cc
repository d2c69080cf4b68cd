// Normals where surfaces are smooth, the contact surface near edges and corners, gaps at the start.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

template <int dim>
ContactPoints<dim>
points_with(const CutBodies<dim> &model, const ContactPairParameters &law)
{
  std::vector<ContactPair> pairs;
  for (const auto &[a, b] : model.pairs)
    pairs.push_back({a, b, "pair", law});
  return ContactPoints<dim>(model.bodies, pairs,
                            level_set_surface(*model.space, *model.level_set_nodes, model.bodies,
                                              pairs,
                                              CutBodies<dim>::shift * model.grid.finest_size()));
}

/** Largest error of the normals around a disc of radius 1 in a hole. */
double
error_of_normals(const unsigned int level, const unsigned int degree, const bool with_shapes)
{
  CutBodies<2> model(
    grid_text("-2, -2", "2, 2", "1, 1", level) + degree_text(degree)
    + bodies_text({{"disc", shape_text("disc", "set Centre = 0.1, 0.03\nset Radius = 1")},
                   {"ring", shape_text("ring", "set Centre = 0.1, 0.03\nset Radius = 1.7\n"
                                               "set Inner radius = 1")}}));
  for (auto &body : model.bodies)
    if (!with_shapes)
      body.shape = nullptr;
  const auto contact = contact_points(model);
  double     error   = 0.;
  for (const auto &point : contact.points())
    {
      Tensor<1, 2> normal = point.position - Point<2>(0.1, 0.03);
      error               = std::max(error, (point.normal - normal / normal.norm()).norm());
    }
  return error;
}

TEST(ContactNormals, OfShapesAreExact)
{
  for (const unsigned int degree : {1, 2})
    EXPECT_LE(error_of_normals(4, degree, true), 1e-7);
}

TEST(ContactNormals, OfSmoothLatticesAreOfThirdOrder)
{
  for (const unsigned int degree : {1, 2})
    {
      const double coarse = error_of_normals(5, degree, false),
                   fine   = error_of_normals(6, degree, false);
      std::cout << "degree " << degree << ": " << coarse << ", " << fine << '\n';
      EXPECT_LE(coarse, 2e-3);
      EXPECT_LE(fine, coarse / 6.);
    }
}

TEST(ContactGaps, FlatFacesThatGoOverIntoArcsDoNotOverlapTheirFloor)
{
  const std::vector<std::string> shapes
    = {"set Lower corner = -0.43, -0.2\nset Upper corner = 0.37, 0.5\nset Corner radius = 0.1",
       "set First point = -0.31, 0.05\nset Second point = 0.29, 0.05\nset Radius = 0.25",
       "set Vertices = -0.4,-0.2; 0.4,-0.2; 0,0.5\nset Corner radius = 0.1"};
  const std::vector<std::string> types = {"box", "capsule", "polygon"};
  for (const unsigned int level : {3, 4})
    for (unsigned int i = 0; i < shapes.size(); ++i)
      {
        const CutBodies<2> model(grid_text("-1, -1", "1, 1", "2, 2", level) + degree_text(2)
                                 + bodies_text({{"floor", half_space_text("0, -0.2", "0, 1")},
                                                {"body", shape_text(types[i], shapes[i])}}));
        const auto         contact = contact_points(model);
        double             flat    = 0.;
        for (const auto &point : contact.points())
          {
            EXPECT_GE(point.initial_gap, -1e-12) << types[i] << " at " << point.position;
            if (point.initial_gap < 1e-12)
              flat += point.weight;
          }
        EXPECT_GT(flat, 0.3) << types[i];
      }
}

/** A box on a floor at z = -0.2, its corner somewhere in a cell. */
template <int dim>
std::string
box_on_floor(const double corner, const double floor, const unsigned int degree,
             const unsigned int level)
{
  const auto number = [](const double x) { return std::to_string(x); };
  if (dim == 2)
    return grid_text("-1, -1", "1, 1", "4, 4", level) + degree_text(degree)
           + bodies_text({{"floor", half_space_text("0, " + number(floor), "0, 1")},
                          {"block", box_text("-0.5, " + number(floor), number(corner) + ", 0.7")}});
  return grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", level) + degree_text(degree)
         + bodies_text(
           {{"floor", half_space_text("0, 0, " + number(floor), "0, 0, 1")},
            {"block", box_text("-0.5, -0.4, " + number(floor), number(corner) + ", 0.33, 0.7")}});
}

template <int dim>
void
check_end_of_face(const double corner, const double floor, const unsigned int degree,
                  const unsigned int level, const double tolerance)
{
  const CutBodies<dim> model(box_on_floor<dim>(corner, floor, degree, level));
  const auto           contact = contact_points(model);
  const double         h       = model.grid.finest_size();
  double               closed  = 0.;
  for (const auto &point : contact.points())
    {
      EXPECT_GE(point.initial_gap, -1e-12);
      if (point.initial_gap > 1e-9 * h)
        continue;
      closed += point.weight;
      EXPECT_NEAR(point.normal[dim - 1], 1., 1e-3) << point.position;
    }
  const double area = (corner + 0.5) * (dim == 3 ? 0.73 : 1.);
  EXPECT_NEAR(closed, area, tolerance * h * (dim == 3 ? 2. * (corner + 0.5 + 0.73) : 2.))
    << corner << " " << floor << " " << degree;
}

TEST(ContactKinks, FaceEndsAtTheCorner)
{
  for (const double floor : {-0.25, -0.2, -0.1871})
    for (const double corner : {0.5, 0.501, 0.53, 0.5625, 0.6049})
      for (const unsigned int degree : {1, 2})
        check_end_of_face<2>(corner, floor, degree, 2, 0.02);
}

TEST(ContactKinks, FaceEndsAtTheEdges3D)
{
  for (const double corner : {0.5, 0.53})
    check_end_of_face<3>(corner, -0.2, 1, 1, 0.06);
}

TEST(ContactKinks, CornerOnAFaceActsAlongItsNormal)
{
  // A square that stands on its corner.
  for (const unsigned int degree : {1, 2})
    {
      const CutBodies<2> model(
        grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(degree)
        + bodies_text(
          {{"floor", half_space_text("0, -0.2", "0.2, 1")},
           {"square", shape_text("polygon", "set Vertices = 0.0313, -0.20626; 0.5313, 0.29374; "
                                            "0.0313, 0.79374; -0.4687, 0.29374")}}));
      const auto   contact = contact_points(model);
      const double length  = std::sqrt(1.04);
      unsigned int n_near  = 0;
      for (const auto &point : contact.points())
        if (point.initial_gap < 0.1 * model.grid.finest_size())
          {
            ++n_near;
            EXPECT_LE((point.normal - Tensor<1, 2>({0.2 / length, 1. / length})).norm(), 1e-6)
              << point.position;
          }
      EXPECT_GE(n_near, 2u);
    }
}

/** Traction integrated over the points when the block moves by `motion`. */
Tensor<1, 2>
force(const CutBodies<2> &model, ContactPoints<2> &contact, const Tensor<1, 2> &motion)
{
  const Vector u = displacement<2>(model, contact, [&](const unsigned int body, const Point<2> &) {
    return body == 1 ? motion : Tensor<1, 2>();
  });
  contact.evaluate(u, contact.initial_history());
  Tensor<1, 2> result;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    result
      += contact.points()[i].weight * contact.responses()[i].traction(contact.points()[i].normal);
  return result;
}

TEST(TiedContact, GluesWhatTouchesAtTheStart)
{
  const CutBodies<2>    model(box_on_floor<2>(0.53, -0.2, 1, 3));
  ContactPairParameters law;
  law.kind                 = &contact_law("tied");
  ContactPoints<2> contact = points_with(model, law);
  const double     h       = model.grid.finest_size();
  for (const double sign : {-1., 1.})
    {
      const double       small = 1e-4, stiffness = 10. * 1000. / h * 1.03;
      const Tensor<1, 2> normal  = force(model, contact, Tensor<1, 2>({0., sign * small}));
      const Tensor<1, 2> tangent = force(model, contact, Tensor<1, 2>({sign * small, 0.}));
      EXPECT_NEAR(normal[1] / (-sign * small * stiffness), 1., 0.2 * h);
      EXPECT_NEAR(tangent[0] / (-sign * small * stiffness), 1., 0.2 * h);
    }
  law.where                 = "x > 0.03";
  ContactPoints<2> half     = points_with(model, law);
  const double     expected = 10. * 1000. / h * 1e-4 * 0.5;
  EXPECT_NEAR(force(model, half, Tensor<1, 2>({0., -1e-4}))[1] / expected, 1., h);
}

TEST(TiedContact, GluesAcrossGapsThatTheLawAllows)
{
  const CutBodies<2>    model(two_half_planes(0.3, 0.02, 1));
  ContactPairParameters law;
  law.kind                = &contact_law("tied");
  const auto n_glued_with = [&](const double gap) {
    law.tied_gap        = gap;
    const auto contact  = points_with(model, law);
    const auto is_glued = [](const ContactPoint<2> &point) { return point.is_glued; };
    return std::count_if(contact.points().begin(), contact.points().end(), is_glued)
           / double(contact.points().size());
  };
  EXPECT_EQ(n_glued_with(0.019), 0.);
  EXPECT_EQ(n_glued_with(0.021), 1.);
  EXPECT_THROW(n_glued_with(100.), UserError);
}

TEST(AdjustedContact, StartsWithoutGap)
{
  for (const double gap : {0.02, -0.02})
    {
      const CutBodies<2>    model(two_half_planes(0.3, gap, 2));
      ContactPairParameters law;
      law.kind               = &contact_law("frictionless");
      law.adjust             = 0.021;
      const auto with_larger = points_with(model, law);
      for (const auto &point : with_larger.points())
        EXPECT_NEAR(point.initial_gap, 0., 1e-15);
      law.adjust              = 0.019;
      const auto with_smaller = points_with(model, law);
      for (const auto &point : with_smaller.points())
        EXPECT_NEAR(point.initial_gap, gap, 1e-5);
    }
}

// A disc that lies 0.02 deep in a half plane, or 0.02 above it.
TEST(AdjustedContact, KeepsCurvatureOrMakesSurfacesFit)
{
  for (const double gap : {0.02, -0.02})
    {
      const CutBodies<2> model(
        grid_text("-2, -2", "2, 2", "1, 1", 5) + degree_text(1)
        + bodies_text(
          {{"disc",
            shape_text("disc", "set Radius = 1\nset Centre = 0.03, " + std::to_string(1. + gap))},
           {"floor", shape_text("half space", "set Point = 0, 0\nset Normal = 0, 1")}}));
      ContactPairParameters law;
      law.kind        = &contact_law("frictionless");
      const auto gaps = [](const ContactPoints<2> &contact) {
        std::vector<double> result;
        for (const auto &point : contact.points())
          result.push_back(point.initial_gap);
        return result;
      };
      const auto before = gaps(points_with(model, law));
      const auto least  = *std::min_element(before.begin(), before.end());
      EXPECT_NEAR(least, gap, 2e-3);
      law.adjust           = 0.05;
      const auto by_pairs  = gaps(points_with(model, law));
      law.adjust_by        = AdjustBy::points;
      const auto by_points = gaps(points_with(model, law));
      law.adjust_by        = AdjustBy::pairs;
      law.adjust           = 0.01;
      EXPECT_EQ(gaps(points_with(model, law)), before);
      ASSERT_EQ(by_pairs.size(), before.size());
      unsigned int n_flat = 0;
      for (unsigned int i = 0; i < before.size(); ++i)
        {
          EXPECT_NEAR(by_pairs[i], before[i] - least, 1e-14);
          const bool is_near = std::abs(before[i]) <= 0.05;
          EXPECT_NEAR(by_points[i], is_near ? 0. : before[i], 1e-14);
          n_flat += is_near;
        }
      EXPECT_GT(n_flat, 4u);
    }
}

// What was found at the start counts later, when bodies are elsewhere.
TEST(AdjustedContact, RemembersTheStart)
{
  const CutBodies<2>    model(two_half_planes(0.3, 0.02, 1));
  ContactPairParameters law;
  law.kind   = &contact_law("frictionless");
  law.adjust = 0.05;
  std::vector<ContactPair> pairs;
  for (const auto &[a, b] : model.pairs)
    pairs.push_back({a, b, "pair", law});
  const auto least_with = [&](StartGaps &start_gaps) {
    const auto contact = level_set_surface(*model.space, *model.level_set_nodes, model.bodies,
                                           pairs, CutBodies<2>::shift * model.grid.finest_size(),
                                           {}, nullptr, nullptr, &start_gaps);
    double     least   = 1.;
    for (const auto &point : contact.points)
      least = std::min(least, point.initial_gap);
    return least;
  };
  StartGaps start_gaps;
  EXPECT_NEAR(least_with(start_gaps), 0., 1e-14);
  ASSERT_EQ(start_gaps.of_bodies.size(), 1u);
  EXPECT_NEAR(start_gaps.of_bodies.begin()->second, 0.02, 1e-5);
  start_gaps.of_bodies.begin()->second = 0.015;
  EXPECT_NEAR(least_with(start_gaps), 0.005, 1e-5);
  start_gaps.of_bodies.clear();
  EXPECT_NEAR(least_with(start_gaps), 0.02, 1e-5);
}

TEST(ContactReach, BodiesThatCoincideOrLieInsideAreRefused)
{
  const auto message = [](const std::string &first, const std::string &second) -> std::string {
    const CutBodies<2>       model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                                   + bodies_text({{"first", first}, {"second", second}}));
    std::vector<ContactPair> pairs;
    for (const auto &[a, b] : model.pairs)
      pairs.push_back({a, b, "pair", {}});
    try
      {
        require_distinct(model.bodies, pairs);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  };
  const std::string box = box_text("-0.5, -0.5", "0.5, 0.9");
  EXPECT_NE(message(box, box).find("coincide"), std::string::npos);
  EXPECT_NE(message(box, box_text("-0.2, -0.2", "0.3, 0.3")).find("coincide"), std::string::npos);
  EXPECT_NE(message(box_text("-0.2, -0.2", "0.3, 0.3"), box).find("coincide"), std::string::npos);
  EXPECT_EQ(message(box, box_text("-0.5, -1.1", "0.5, -0.3")), "");
  EXPECT_EQ(message(shape_text("ring", "set Centre = 0, 0\nset Radius = 0.55\n"
                                       "set Inner radius = 0.3"),
                    shape_text("ring", "set Centre = 0, 0\nset Radius = 0.8\n"
                                       "set Inner radius = 0.5")),
            "");
}

TEST(ContactReach, ContactsAtFewPointsAreUnderResolved)
{
  const CutBodies<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
    + bodies_text({{"floor", half_space_text("0, -0.2", "0, 1")},
                   {"disc", shape_text("disc", "set Centre = 0, 0.2\nset Radius = 0.4")}}));
  ContactPoints<2> contact = contact_points(model);
  force(model, contact, Tensor<1, 2>());
  EXPECT_TRUE(under_resolved_pairs(contact, MPI_COMM_WORLD).empty());
  force(model, contact, Tensor<1, 2>({0., -0.002}));
  EXPECT_EQ(under_resolved_pairs(contact, MPI_COMM_WORLD).size(), 1u);
  force(model, contact, Tensor<1, 2>({0., -0.1}));
  EXPECT_TRUE(under_resolved_pairs(contact, MPI_COMM_WORLD).empty());
}
} // namespace
} // namespace scree
