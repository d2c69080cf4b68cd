// The intermediate surface between two bodies: where it is, gaps, normals, jumps.
#include <gtest/gtest.h>

#include <deal.II/base/mpi.h>

#include <cmath>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

void
check_plane(const double slope, const unsigned int degree, const std::string &refinement = "")
{
  constexpr double       gap = 0.02;
  const CutBodies<2>     model(two_half_planes(slope, gap, degree, refinement));
  const ContactPoints<2> contact = contact_points(model);
  const Tensor<1, 2>     normal(
        {-slope / std::sqrt(1. + slope * slope), 1. / std::sqrt(1. + slope * slope)});
  double length = 0.;
  for (const auto &point : contact.points())
    {
      length += point.weight;
      EXPECT_LE((point.normal - normal).norm(), 1e-6);
      EXPECT_NEAR(point.initial_gap, gap, 2e-6);
      EXPECT_NEAR(point.position[1],
                  0.013 + slope * point.position[0] + 0.5 * gap * std::sqrt(1. + slope * slope),
                  2e-6);
    }
  // The plane leaves the box through x = +-1.
  EXPECT_NEAR(Utilities::MPI::sum(length, MPI_COMM_WORLD), 2. * std::sqrt(1. + slope * slope),
              1e-5);
}

TEST(ContactPoints, PlaneBetweenHalfPlanes)
{
  for (const unsigned int degree : {1, 2})
    for (const double slope : {0., 0.3})
      check_plane(slope, degree);
}

TEST(ContactPoints, PlaneOnGradedGrid)
{
  check_plane(0.3, 1, graded_text(0));
  check_plane(0.3, 2, graded_text(1));
}

// The penalties belong to the secant moduli of both sides, of at least a tenth of E.
TEST(ContactPoints, PenaltiesFollowFlow)
{
  const CutBodies<2>       model(two_half_planes(0.3, 0.02, 2));
  const auto               elastic = contact_points(model);
  const IndexSet           owned   = model.space->owned();
  std::vector<ContactPair> pairs   = elastic.pairs();
  for (const double ratio : {1., 0.4, 0.01})
    {
      Vector ratios(owned, model.grid.communicator());
      for (const auto i : owned)
        ratios(i) = ratio;
      ratios.compress(VectorOperation::insert);
      const ContactPoints<2> contact(
        model.bodies, pairs,
        level_set_surface(*model.space, *model.level_set_nodes, model.bodies, pairs,
                          CutBodies<2>::shift * model.grid.finest_size(), {}, nullptr, &ratios));
      ASSERT_EQ(contact.points().size(), elastic.points().size());
      for (unsigned int i = 0; i < contact.points().size(); ++i)
        {
          const double factor = std::max(ratio, 0.1);
          EXPECT_NEAR(contact.enforcement().stiffness()[i].normal,
                      factor * elastic.enforcement().stiffness()[i].normal,
                      1e-10 * elastic.enforcement().stiffness()[i].normal);
          EXPECT_NEAR(contact.enforcement().stiffness()[i].tangential,
                      factor * elastic.enforcement().stiffness()[i].tangential,
                      1e-10 * elastic.enforcement().stiffness()[i].tangential);
        }
    }
}

template <int dim>
void
check_jumps(const CutBodies<dim> &model)
{
  ContactPoints<dim> contact = contact_points(model);
  ASSERT_GT(Utilities::MPI::sum(contact.points().size(), MPI_COMM_WORLD), 8u);
  // u_b - u_a at the projected points, which lie half the gap beside the contact point.
  Tensor<1, dim> translation;
  for (unsigned int d = 0; d < dim; ++d)
    translation[d] = 0.1 * (d + 1.);
  const Vector u = displacement<dim>(model, contact, [&](const unsigned int body, const auto &x) {
    return body == 0 ? Tensor<1, dim>(x) : Tensor<1, dim>(3. * x + translation);
  });
  contact.evaluate(u, contact.initial_history());
  unsigned int n_checked = 0;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto          &point = contact.points()[i];
      const Tensor<1, dim> foot_a(point.position - 0.5 * point.initial_gap * point.normal);
      const Tensor<1, dim> foot_b(point.position + 0.5 * point.initial_gap * point.normal);
      // Feet outside the box, where it clips the bodies, are moved to its faces.
      if (!model.grid.box().point_inside(Point<dim>(foot_a))
          || !model.grid.box().point_inside(Point<dim>(foot_b)))
        continue;
      ++n_checked;
      EXPECT_LE((contact.jumps()[i] - (3. * foot_b + translation - foot_a)).norm(), 1e-5);
      EXPECT_NEAR(contact.gap(i), point.initial_gap + point.normal * contact.jumps()[i], 1e-14);
    }
  EXPECT_GT(n_checked, contact.points().size() / 2);
}

TEST(ContactPoints, JumpOfLinearFields)
{
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0.02, 1)));
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0.02, 2, graded_text(1))));
  // A gap of several cells: the projections leave the cell of the contact point.
  check_jumps(CutBodies<2>(two_half_planes(0.1, 0.3, 1)));
}

TEST(ContactPointsMPI, JumpOfLinearFields)
{
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0.02, 1)));
  check_jumps(CutBodies<2>(two_half_planes(0.1, 0.3, 2, graded_text(1))));
  check_plane(0.3, 2, graded_text(1));
}

TEST(ContactPoints, JumpOfLinearFields3D)
{
  check_jumps(
    CutBodies<3>(grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 1) + degree_text(1)
                 + bodies_text({{"lower", half_space_text("0, 0, 0.013", "0.1, 0.2, 1")},
                                {"upper", half_space_text("0, 0, 0.063", "-0.1, -0.2, -1")}})));
}

/** What happens at most when a disc turns in a hole of its size. */
struct TurnedDisc
{
  double gap_change = 0.;
  double normal     = 0.; //!< error of the normals of the places where points meet
};

TurnedDisc
turned_disc(const unsigned int level, const double angle, const bool is_predicted)
{
  const CutBodies<2> model(
    grid_text("-2, -2", "2, 2", "1, 1", level) + degree_text(2)
    + bodies_text({{"disc", shape_text("disc", "set Centre = 0, 0\nset Radius = 1")},
                   {"ring", shape_text("ring", "set Centre = 0, 0\nset Radius = 1.7\nset Inner "
                                               "radius = 1.001")}}));
  const auto turn = [&](const unsigned int body, const Point<2> &x) {
    const double c = body == 0 ? std::cos(angle) - 1. : 0., s = body == 0 ? std::sin(angle) : 0.;
    return Tensor<1, 2>({c * x[0] - s * x[1], s * x[0] + c * x[1]});
  };
  ContactPoints<2> contact = contact_points<2>(
    model, "frictionless", is_predicted ? IncrementPrediction<2>(turn) : IncrementPrediction<2>());
  contact.evaluate(displacement<2>(model, contact, turn), contact.initial_history());
  TurnedDisc result;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto         &point = contact.points()[i];
      const Tensor<1, 2> &n     = point.start_normal;
      const double        c = std::cos(angle / 2.), s = std::sin(angle / 2.);
      const Tensor<1, 2>  at_end({c * n[0] - s * n[1], s * n[0] + c * n[1]});
      result.gap_change = std::max(result.gap_change, std::abs(contact.gap(i) - 0.001));
      result.normal     = std::max(result.normal, (point.normal - at_end).norm());
    }
  return result;
}

TEST(ContactPoints, SlidingOfCurvedSurfacesKeepsTheGap)
{
  // Surfaces that touch all along slide by s on a radius 1: the gap stays, n.[[u]] is s^2/2.
  // They meet half way, where the normal has turned by s/2.
  const double     s     = 0.04;
  const TurnedDisc plain = turned_disc(6, s, false), predicted = turned_disc(6, s, true);
  std::cout << "change of the gap: " << plain.gap_change << ", predicted " << predicted.gap_change
            << "; error of the normal: " << plain.normal << ", predicted " << predicted.normal
            << '\n';
  EXPECT_NEAR(plain.gap_change, s * s / 2., 0.1 * s * s);
  EXPECT_LT(predicted.gap_change, 0.05 * plain.gap_change);
  EXPECT_NEAR(plain.normal, s / 2., 1e-4);
  EXPECT_LT(predicted.normal, 0.01 * plain.normal);
}

TEST(ContactPoints, SurfaceOnGridLineIsCountedOnce)
{
  // The bodies touch on a grid line: the surface belongs to the cells of one side.
  for (const unsigned int degree : {1, 2})
    {
      const CutBodies<2> model(grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(degree)
                               + bodies_text({{"lower", half_space_text("0, 0", "0, 1")},
                                              {"upper", half_space_text("0, 0", "0, -1")}}));
      double             length  = 0.;
      const auto         surface = contact_points(model);
      for (const auto &point : surface.points())
        length += point.weight;
      EXPECT_NEAR(length, 2., 1e-12);
    }
}

TEST(ContactPoints, OverlapIsNegativeGap)
{
  const CutBodies<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(2)
    + bodies_text({{"left", ball_text("-0.4, 0", 0.41)}, {"right", ball_text("0.4, 0", 0.42)}}));
  const auto contact  = contact_points(model);
  double     smallest = 1.;
  for (const auto &point : contact.points())
    smallest = std::min(smallest, point.initial_gap);
  EXPECT_NEAR(smallest, -0.03, 5e-4);
}

TEST(ContactPoints, HistoryIsWhatWasEvaluated)
{
  const CutBodies<2> model(two_half_planes(0., 0.0004, 1));
  ContactPoints<2>   contact = contact_points(model, "stick");
  const Vector       u = displacement<2>(model, contact, [](const unsigned int body, const auto &) {
    return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({0.01, -0.02});
  });
  contact.evaluate(u, contact.initial_history());
  const auto history = contact.current_history();
  ASSERT_FALSE(history.tau.empty());
  const double eps_t = 10. * 1000. / model.grid.finest_size();
  EXPECT_NEAR(contact.enforcement().stiffness()[0].tangential, eps_t, 1e-9 * eps_t);
  for (unsigned int i = 0; i < history.tau.size(); ++i)
    {
      // Only the motion after closing causes friction.
      const double gap = contact.points()[i].initial_gap;
      EXPECT_NEAR(history.tau[i][0], -0.01 * eps_t * (0.02 - gap) / 0.02, 1e-8 * eps_t);
      EXPECT_NEAR(history.jump[i][1], -0.02, 1e-12);
    }
}

// Freezing the bounds of friction changes no traction at the displacement where that is done, also
// where all points are made to stick.
TEST(ContactPoints, FrozenBoundsKeepTractions)
{
  const CutBodies<2> model(two_half_planes(0., 0.01, 1));
  auto               pairs          = pairs_with(model, "coulomb");
  pairs[0].law.friction_coefficient = 0.5;
  ContactPoints<2> contact(model.bodies, pairs,
                           level_set_surface(*model.space, *model.level_set_nodes, model.bodies,
                                             pairs,
                                             CutBodies<2>::shift * model.grid.finest_size()));
  const auto       history = contact.initial_history();
  const Vector u = displacement<2>(model, contact, [](const unsigned int body, const Point<2> &x) {
    return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({0.002 * (1. + x[0]), -0.02});
  });
  for (const bool sticks : {false, true})
    {
      contact.laws().set_sticks(sticks);
      contact.evaluate(u, history);
      const auto before = contact.responses();
      contact.laws().freeze(contact.points(), before);
      contact.evaluate(u, history);
      double largest = 0.;
      for (unsigned int i = 0; i < contact.points().size(); ++i)
        {
          EXPECT_NEAR((contact.responses()[i].tau - before[i].tau).norm(), 0., 1e-12);
          EXPECT_EQ(contact.responses()[i].pressure, before[i].pressure);
          largest = std::max(largest, before[i].tau.norm());
        }
      EXPECT_GT(largest, 0.);
      contact.laws().unfreeze();
    }
}

TEST(ContactPoints, CellsAroundContactHaveOneLevel)
{
  const CutBodies<2> model(
    grid_text("-1, -1", "1, 1", "2, 2", 6, graded_text(1)) + degree_text(1)
    + bodies_text({{"left", ball_text("-0.4, 0.01", 0.4)}, {"right", ball_text("0.4, 0", 0.4)}}));
  EXPECT_TRUE(model.grid.triangulation().has_hanging_nodes());
  const double h       = model.grid.finest_size();
  const auto   contact = contact_points(model);
  for (const auto &point : contact.points())
    {
      if (point.initial_gap > 2. * h)
        continue;
      for (const double dx : {-h, 0., h})
        for (const double dy : {-h, 0., h})
          {
            const auto here = model.grid.locate(point.position + Tensor<1, 2>({dx, dy}));
            EXPECT_EQ(model.grid.cells()[here.local_cell].size, h);
          }
    }
}
} // namespace
} // namespace scree
