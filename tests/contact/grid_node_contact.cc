// Contact at the nodes of the grid: which nodes, their normals, areas, gaps and jumps.
#include <gtest/gtest.h>

#include <scree/contact/grid_node_contact.h>
#include <scree/contact/multiplier_field.h>

#include <deal.II/base/mpi.h>

#include <cmath>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** Contact at the nodes of a model, the same law for all pairs. */
template <int dim>
ContactPoints<dim>
node_contact(const CutBodies<dim> &model, const GridNodeParameters &parameters = {},
             const std::string &law = "frictionless")
{
  const std::vector<ContactPair> pairs = pairs_with(model, law);
  return ContactPoints<dim>(
    model.bodies, pairs,
    grid_node_contact(*model.space, *model.level_set_nodes, model.bodies, pairs, parameters));
}

/** Cells of edge 1/16, the interface is a line through the box. */
void
check_plane(const double slope, const double gap)
{
  const CutBodies<2>     model(two_half_planes(slope, gap, 1));
  const ContactPoints<2> contact = node_contact(model);
  const double           norm    = std::sqrt(1. + slope * slope);
  const Tensor<1, 2>     normal({-slope / norm, 1. / norm});
  double                 length = 0.;
  for (const auto &point : contact.points())
    {
      length += point.weight;
      EXPECT_LE((point.normal - normal).norm(), 1e-6);
      EXPECT_NEAR(point.initial_gap, gap, 1e-6);
    }
  // Across a gap some nodes that one body hardly reaches are not reached by the other.
  EXPECT_NEAR(Utilities::MPI::sum(length, MPI_COMM_WORLD), 2. * norm, gap > 0. ? 0.02 : 1e-5);
}

TEST(GridNodeContact, AreasOfAPlaneAddUp)
{
  for (const double slope : {0., 0.3, 0.9})
    for (const double gap : {0., 0.02, -0.01})
      check_plane(slope, gap);
}

TEST(GridNodeContactMPI, AreasOfAPlaneAddUp)
{
  check_plane(0., 0.);
  check_plane(0.3, 0.02);
  // The layers below and above the cells with the interface, 33 nodes each.
  const CutBodies<2> model(two_half_planes(0., 0., 1));
  EXPECT_EQ(Utilities::MPI::sum(node_contact(model).points().size(), MPI_COMM_WORLD), 66u);
}

TEST(GridNodeContact, InterfaceOnGridLine)
{
  const CutBodies<2> model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                           + bodies_text({{"lower", half_space_text("0, 0.0625", "0, 1")},
                                          {"upper", half_space_text("0, 0.0625", "0, -1")}}));
  const auto         contact = node_contact(model);
  ASSERT_EQ(contact.points().size(), 33u);
  for (const auto &point : contact.points())
    {
      EXPECT_NEAR(point.weight, std::abs(point.position[0]) < 0.99 ? 0.0625 : 0.03125, 1e-9);
      EXPECT_NEAR(point.normal[1], 1., 1e-12);
      EXPECT_NEAR(point.position[1], 0.0625, 1e-12);
    }
}

TEST(GridNodeContact, Plane3D)
{
  const CutBodies<3> model(
    grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 1) + degree_text(1)
    + bodies_text({{"lower", half_space_text("0, 0, 0.013", "0.1, 0.2, 1")},
                   {"upper", half_space_text("0, 0, 0.013", "-0.1, -0.2, -1")}}));
  const auto         contact = node_contact(model);
  const double       norm    = std::sqrt(1.05);
  const Tensor<1, 3> normal({0.1 / norm, 0.2 / norm, 1. / norm});
  double             area = 0.;
  for (const auto &point : contact.points())
    {
      area += point.weight;
      EXPECT_LE((point.normal - normal).norm(), 1e-5);
    }
  EXPECT_NEAR(area, 4. * norm, 1e-4);
}

template <int dim>
void
check_jumps(const CutBodies<dim> &model)
{
  ContactPoints<dim> contact = node_contact(model);
  ASSERT_GT(Utilities::MPI::sum(contact.points().size(), MPI_COMM_WORLD), 8u);
  Tensor<1, dim> translation;
  for (unsigned int d = 0; d < dim; ++d)
    translation[d] = 0.01 * (d + 1.);
  const Vector u = displacement<dim>(model, contact, [&](const unsigned int body, const auto &x) {
    return body == 0 ? Tensor<1, dim>(0.1 * x) : Tensor<1, dim>(0.3 * x - translation);
  });
  contact.evaluate(u, contact.initial_history());
  unsigned int n_closed = 0;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto &point = contact.points()[i];
      EXPECT_LE((contact.jumps()[i] - (0.2 * point.position - translation)).norm(), 1e-13);
      n_closed += contact.responses()[i].pressure > 0.;
    }
  EXPECT_GT(Utilities::MPI::sum(n_closed, MPI_COMM_WORLD), 4u);
  // The forces on the nodes have no resultant.
  Vector forces(model.space->owned(), model.grid.communicator());
  contact.add_to_residual(forces);
  forces.compress(VectorOperation::add);
  Tensor<1, dim> resultant;
  double         size = 0.;
  for (const DofIndex index : model.space->owned())
    {
      resultant[index % dim] += forces(index);
      size += std::abs(forces(index));
    }
  for (unsigned int d = 0; d < dim; ++d)
    EXPECT_NEAR(Utilities::MPI::sum(resultant[d], MPI_COMM_WORLD), 0.,
                1e-12 * Utilities::MPI::sum(size, MPI_COMM_WORLD));
}

TEST(GridNodeContact, JumpsAndForces)
{
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0., 1)));
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0., 1, graded_text(1))));
}

TEST(GridNodeContactMPI, JumpsAndForces)
{
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0., 1)));
  check_jumps(CutBodies<2>(two_half_planes(0.3, 0., 1, graded_text(1))));
}

std::string
disc_on_block(const std::string &block)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
         + bodies_text({{"block", half_space_text("0, 0.013", "0, 1") + block},
                        {"disc", ball_text("0, 0.513", 0.5)}});
}

/** The sine of the largest angle between normals and the y axis. */
double
largest_slope(const ContactPoints<2> &contact)
{
  double result = 0.;
  for (const auto &point : contact.points())
    result = std::max(result, std::abs(point.normal[0]));
  return result;
}

// The heavier body makes the normals.
TEST(GridNodeContact, NormalsByMass)
{
  CutBodies<2>       model(disc_on_block(""));
  GridNodeParameters by_mass;
  by_mass.normal = NodeNormal::mass_gradient;
  EXPECT_THROW(node_contact(model, by_mass), UserError);
  GridNodeParameters of_volumes;
  of_volumes.normal       = NodeNormal::volume_gradient;
  const double by_volume  = largest_slope(node_contact(model, of_volumes));
  model.bodies[0].density = model.bodies[1].density = 3.;
  EXPECT_NEAR(largest_slope(node_contact(model, by_mass)), by_volume, 1e-12);
  model.bodies[0].density = 3e6;
  EXPECT_LT(largest_slope(node_contact(model, by_mass)), 1e-5);
  EXPECT_GT(by_volume, 0.1);
}

// Beyond the edge of a block the plane below it has the normal; gradients of volume lean.
TEST(GridNodeContact, NormalsAtAnEdge)
{
  const CutBodies<2> model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                           + bodies_text({{"floor", half_space_text("0, 0.013", "0, 1")},
                                          {"block", box_text("-0.43, 0.013", "0.37, 0.7")}}));
  GridNodeParameters of_volumes;
  of_volumes.normal = NodeNormal::volume_gradient;
  EXPECT_GT(largest_slope(node_contact(model, of_volumes)), 0.3);
  EXPECT_LT(largest_slope(node_contact(model)), 0.01);
}

TEST(GridNodeContact, EarlyContact)
{
  const CutBodies<2> model(two_half_planes(0., 0.02, 1));
  GridNodeParameters early;
  early.has_gaps = false;
  for (const bool has_gaps : {true, false})
    {
      early.has_gaps           = has_gaps;
      ContactPoints<2> contact = node_contact(model, early);
      contact.evaluate(displacement<2>(model, contact,
                                       [](const unsigned int body, const Point<2> &) {
                                         return Tensor<1, 2>({0., body == 0 ? 0. : -0.01});
                                       }),
                       contact.initial_history());
      for (unsigned int i = 0; i < contact.points().size(); ++i)
        {
          EXPECT_NEAR(contact.gap(i), has_gaps ? 0.01 : -0.01, 1e-6);
          EXPECT_EQ(contact.responses()[i].pressure > 0., !has_gaps);
        }
    }
}

// A disc that slides over a block: gap and normal at the nodes are those of the disc where it will
// be.
TEST(GridNodeContact, ExpectedMotion)
{
  const CutBodies<2>             model(disc_on_block(""));
  const Tensor<1, 2>             d({0.07, -0.001});
  const std::vector<ContactPair> pairs = {{0, 1, "block-disc", {}}};
  const auto                     moved = grid_node_contact<2>(
    *model.space, *model.level_set_nodes, model.bodies, pairs, {},
    [&](const unsigned int body, const Point<2> &) { return body == 0 ? Tensor<1, 2>() : d; });
  unsigned int n_turned = 0;
  for (const auto &point : moved.points)
    {
      const Tensor<1, 2> before = point.position - Point<2>(0., 0.513), after = before - d;
      const double       at_end = point.position[1] - 0.013 + after.norm() - 0.5;
      EXPECT_NEAR(point.initial_gap + point.normal * d, at_end, 1e-4 + 2e-3 * at_end);
      const Tensor<1, 2> n_before = before / before.norm(), n_after = after / after.norm();
      const double cosine = -std::max(n_before * point.start_normal, n_after * point.start_normal);
      if (std::abs(cosine - 0.9) < 0.01)
        continue;
      // Where the disc turns away from the node nothing is known of its face.
      Tensor<1, 2> normal = point.start_normal;
      if (cosine > 0.9)
        {
          normal += 0.5 * (n_before - n_after);
          ++n_turned;
        }
      EXPECT_LE((point.normal - normal / normal.norm()).norm(), 3e-3);
    }
  EXPECT_GT(n_turned, 4u);
}

// Where a body deforms much its increment lets nothing expect.
TEST(GridNodeContact, NoExpectationOfLargeStrains)
{
  const CutBodies<2>             model(disc_on_block(""));
  const std::vector<ContactPair> pairs = {{0, 1, "block-disc", {}}};
  const auto                     moved = grid_node_contact<2>(
    *model.space, *model.level_set_nodes, model.bodies, pairs, {},
    [](const unsigned int, const Point<2> &x) { return 0.1 * Tensor<1, 2>(x); });
  ASSERT_GT(moved.points.size(), 4u);
  for (const auto &point : moved.points)
    {
      EXPECT_EQ(point.initial_gap, point.start_gap);
      EXPECT_EQ(point.normal, point.start_normal);
    }
}

// A slope other than one makes no gap at nodes beside a closed contact.
TEST(GridNodeContact, GapsOfStretchedLevelSets)
{
  CutBodies<2> model(two_half_planes(0.3, 0., 1));
  for (double &value : model.bodies[0].level_set.values())
    value *= 1.1;
  for (const auto &point : node_contact(model).points())
    EXPECT_NEAR(point.initial_gap, 0., 1e-9);
}

// Nodes with the normal of the far side of a plate are no nearer than they are.
TEST(GridNodeContact, GapsOfAThinPlate)
{
  const CutBodies<2> model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                           + bodies_text({{"plate", box_text("-2, -0.1", "2, 0")},
                                          {"block", half_space_text("0, -0.001", "0, -1")}}));
  GridNodeParameters of_volumes;
  of_volumes.normal          = NodeNormal::volume_gradient;
  unsigned int n_of_far_side = 0;
  for (const auto &point : node_contact(model, of_volumes).points())
    {
      const bool is_of_far_side = point.normal[1] < 0.;
      n_of_far_side += is_of_far_side;
      EXPECT_NEAR(point.initial_gap, is_of_far_side ? 0.024 : -0.001, 1e-6);
    }
  EXPECT_GT(n_of_far_side, 20u);
}

// A rigid body moves nodes as if they were part of it.
TEST(GridNodeContact, RigidBody)
{
  const CutBodies<2> model(disc_on_block(motion_text("   set Displacement y = 0.001*t")));
  ContactPoints<2>   contact = node_contact(model);
  ASSERT_GT(contact.points().size(), 4u);
  Vector         owned(model.space->owned(), model.grid.communicator());
  const DofIndex first = model.space->rigid_unknown(0);
  owned(first + 1)     = 0.001;
  owned.compress(VectorOperation::insert);
  IndexSet relevant = model.space->relevant();
  Vector   u(model.space->owned(), relevant, model.grid.communicator());
  u = owned;
  contact.evaluate(u, contact.initial_history());
  for (const auto &jump : contact.jumps())
    EXPECT_LE((jump - Tensor<1, 2>({0., -0.001})).norm(), 1e-15);
}

// Each node has its own multiplier.
TEST(GridNodeContact, Multipliers)
{
  const CutBodies<2>        model(two_half_planes(0.3, 0., 1));
  ContactPoints<2>          contact = node_contact(model);
  MultiplierField<2>        field(contact.points(), MPI_COMM_WORLD);
  std::vector<Tensor<1, 2>> values;
  std::vector<bool>         closed;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      values.push_back(Tensor<1, 2>({1. * i, std::sin(10. * i)}));
      closed.push_back(i % 3 != 0);
    }
  field.add_fit(values, closed);
  double largest = 0.;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      EXPECT_LE((field(i) - (closed[i] ? values[i] : Tensor<1, 2>())).norm(),
                1e-12 * values.size());
      const ContactPoint<2> &point = contact.points()[i];
      if (closed[i] && point.weight >= MultiplierField<2>::smallest_part * point.cell_size)
        largest = std::max(largest, values[i].norm());
    }
  EXPECT_NEAR(field.largest_mean(values, closed), largest, 1e-12 * largest);
}
} // namespace
} // namespace scree
