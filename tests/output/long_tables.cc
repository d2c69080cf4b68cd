// The tables with a row per contact and per body, the motions in them, and what they cost on many
// processes.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/mechanics/contact_groups.h>
#include <scree/output/long_tables.h>

#include <cmath>

#include "../mechanics/equilibrium_model.h"
#include "files.h"

namespace
{
unsigned int n_collectives = 0;
} // namespace

// The profiling interface of MPI: all reductions and broadcasts are counted. In parentheses, for
// PETSc has macros of these names.
extern "C" int(MPI_Allreduce)(const void *send, void *receive, int count, MPI_Datatype type,
                              MPI_Op operation, MPI_Comm communicator)
{
  ++n_collectives;
  return PMPI_Allreduce(send, receive, count, type, operation, communicator);
}

extern "C" int(MPI_Bcast)(void *buffer, int count, MPI_Datatype type, int root,
                          MPI_Comm communicator)
{
  ++n_collectives;
  return PMPI_Bcast(buffer, count, type, root, communicator);
}

namespace scree
{
namespace
{
using namespace dealii;

/** n^2 discs that nearly touch, on springs unless they are free. */
std::string
discs(const unsigned int n, const bool are_free = false)
{
  const std::string conditions
    = are_free ? ""
               : conditions_text({{"all", "set On = surface\nset Type = springs\nset Value = 1; 1"},
                                  {"right", "set On = surface\nset Type = traction\n"
                                            "set Where = x > 0\nset Value = 1; 0"}});
  std::vector<std::pair<std::string, std::string>> bodies;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      bodies.emplace_back("d" + std::to_string(i * n + j),
                          ball_text(std::to_string(i + 0.5) + ", " + std::to_string(j + 0.5), 0.49)
                            + conditions);
  const std::string size = std::to_string(n);
  return grid_text("0, 0", size + ", " + size, size + ", " + size, 3) + degree_text(1)
         + bodies_text(bodies) + contact_text("set Law = frictionless");
}

/** The number of collective calls of all tables of a packing. */
unsigned int
collectives_of_tables(const unsigned int n)
{
  EquilibriumModel<2> model(discs(n));
  const auto          u = model.equilibrium.with_ghosts(model.state.displacement);
  auto                r = model.state.displacement;
  model.equilibrium.residual(model.state.displacement, model.state.contact, r);
  n_collectives = 0;
  EXPECT_EQ(summarise_contact(model.contact, MPI_COMM_WORLD).size(), model.contact.pairs().size());
  EXPECT_EQ(model.boundary_terms.resultants({*model.cut.space, u}, 0.).size(), 2 * n * n);
  EXPECT_EQ(
    mean_motions<2>(*model.cut.space, model.cut.bodies, model.quadrature, model.kinematics, u)
      .size(),
    n * n);
  EXPECT_EQ(model.equilibrium.body_stresses(model.state.displacement).size(), n * n);
  EXPECT_GT(assembly_region<2>(*model.cut.space, *model.cut.level_set_nodes, model.cut.bodies,
                               model.quadrature, u)
              .volume,
            0.9 * n * n);
  return n_collectives;
}

TEST(LongTablesMPI, CollectiveCallsDoNotGrowWithTheBodies)
{
  const unsigned int n_of_nine = collectives_of_tables(3);
  EXPECT_EQ(n_of_nine, collectives_of_tables(6));
  // 20 of one process, 33 of two: most compare the maps of vectors that are added. deal.II's
  // assertions add another 20 of two.
#ifdef DEBUG
  EXPECT_LE(n_of_nine, 60u);
#else
  EXPECT_LE(n_of_nine, 40u);
#endif
}

/** The number of collective calls of an iteration of Newton's method on free discs, one of which
 * moves far. */
unsigned int
collectives_of_iteration(const unsigned int n)
{
  EquilibriumModel<2> model(discs(n, true));
  auto               &equilibrium = model.equilibrium;
  auto                u = model.state.displacement, r = u, du = u;
  EXPECT_EQ(equilibrium.free_bodies().size(), n * n);
  equilibrium.residual(u, model.state.contact, r);
  for (const auto unknown : equilibrium.free_motions().unknowns(0))
    du(unknown) = 1.;
  du.compress(dealii::VectorOperation::insert);
  n_collectives = 0;
  equilibrium.residual(u, model.state.contact, r);
  EXPECT_FALSE(equilibrium.balance_rigid_motions(u, model.state.contact));
  equilibrium.tangent();
  equilibrium.is_symmetric();
  equilibrium.force_scale();
  equilibrium.round_off();
  ContactGroups<2> groups(*model.cut.space, model.cut.bodies, model.contact);
  groups.add();
  groups.partition();
  equilibrium.shorten(du, 0.1);
  const unsigned int result = n_collectives;
  EXPECT_NEAR(du.linfty_norm(), 0.1, 1e-12);
  return result;
}

TEST(LongTablesMPI, CollectiveCallsOfAnIterationDoNotGrowWithTheBodies)
{
  EXPECT_EQ(collectives_of_iteration(3), collectives_of_iteration(10));
}

TEST(LongTablesMPI, MotionOfADisc)
{
  EquilibriumModel<2> model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                            + bodies_text({{"disc", ball_text("0.1, -0.05", 0.7)}}));
  // u = A x + b
  const Tensor<2, 2> A({{-0.1, -0.4}, {0.3, 0.05}});
  const Tensor<1, 2> b({0.02, -0.3});
  const auto        &space = *model.cut.space;
  auto               u     = model.state.displacement;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      {
        const auto        &cell = space.grid.cells()[space.cells()[a].grid_cell];
        const Tensor<1, 2> x    = cell.lower + cell.size * Tensor<1, 2>(space.basis.node(i));
        for (unsigned int c = 0; c < 2; ++c)
          if (space.owned().is_element(space.nodes(a)[i] + c))
            u(space.nodes(a)[i] + c) = (A * x + b)[c];
      }
  u.compress(VectorOperation::insert);
  const auto motion = mean_motions<2>(space, model.cut.bodies, model.quadrature, model.kinematics,
                                      model.equilibrium.with_ghosts(u))[0];
  // The polygon that approximates the disc is not quite symmetric.
  const Tensor<1, 2> centroid = motion.position - motion.displacement;
  EXPECT_NEAR((centroid - Point<2>(0.1, -0.05)).norm(), 0., 1e-4);
  EXPECT_NEAR((motion.displacement - A * centroid - b).norm(), 0., 1e-12);
  EXPECT_NEAR(motion.rotation[2], std::atan2(0.3 + 0.4, 2. - 0.1 + 0.05), 1e-4);
}

TEST(RotationVector, OfRotationTimesStretch)
{
  for (const double angle : {0., 1e-9, 0.3, 2., -3.})
    {
      const Tensor<2, 2> R(
        {{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}});
      const Tensor<2, 2> U({{1.2, 0.1}, {0.1, 0.7}});
      EXPECT_NEAR(rotation_vector<2>(R * U)[2], angle, 1e-14);
      // Rodrigues' formula about an axis.
      const Tensor<1, 3> axis({2. / 3., -1. / 3., 2. / 3.});
      Tensor<2, 3>       cross(
              {{0., -axis[2], axis[1]}, {axis[2], 0., -axis[0]}, {-axis[1], axis[0], 0.}});
      const Tensor<2, 3> identity(unit_symmetric_tensor<3>());
      const Tensor<2, 3> Q
        = identity + std::sin(angle) * cross + (1. - std::cos(angle)) * cross * cross;
      const Tensor<2, 3> V({{20., 1., 0.}, {1., 14., 2.}, {0., 2., 17.}});
      EXPECT_NEAR((rotation_vector<3>(Q * V) - angle * axis).norm(), 0., 1e-13);
    }
}

/** A step of two bodies that touch at (1, 0) or not; body b has moved to (2, 0). */
void
write_step(LongTables<2> &tables, const std::vector<Body<2>> &bodies, const unsigned int step,
           const bool is_closed)
{
  ContactSummary<2> summary;
  if (is_closed)
    {
      summary.force        = Tensor<1, 2>({3., 1.});
      summary.moment       = moment_of<2>(Point<2>(0.5, 0.), summary.force);
      summary.stick_points = 2.;
      summary.virial_a     = outer_product(summary.force, Tensor<1, 2>({1., 0.}));
      summary.virial_b     = summary.virial_a;
      summary.strength     = summary.force.norm();
      summary.placed       = summary.strength * Tensor<1, 2>({1., 0.});
      summary.directed     = summary.placed;
    }
  std::vector<MeanMotion<2>> motions(2);
  motions[1].position = Point<2>(2., 0.);
  std::vector<BodyStress<2>> stresses(2);
  for (auto &stress : stresses)
    stress.integral = {2., 2.5, SymmetricTensor<2, 2>({-3., 1., 0.})};
  const std::vector<ContactPair> pairs = {{0, 1, "a-b", {}}};
  StepRecord                     record;
  record.step  = step;
  record.time  = 0.5 * step;
  record.stage = 3;
  tables.gather(record, pairs, {summary},
                grain_states(bodies, pairs, {summary}, motions, stresses, true),
                AssemblyRegion<2>{8., Tensor<1, 2>({4., 2.})}, true, true);
  tables.add_transfers({{{0u, 1u}, Tensor<1, 2>({0.25, 0.})}});
  tables.write();
}

TEST(LongTables, RowsOfWhatIsOrWasClosedAlsoAfterAResume)
{
  const Directory     own;
  const std::string  &directory = own.path;
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 1) + degree_text(1)
    + bodies_text({{"a", ball_text("-0.5, 0", 0.4)}, {"b", ball_text("0.5, 0", 0.4)}}));
  const auto      &bodies = model.cut.bodies;
  LongTablesRecord record;
  {
    LongTables<2> tables(directory, bodies);
    write_step(tables, bodies, 1, false);
    write_step(tables, bodies, 2, true);
    record = tables.record();
    write_step(tables, bodies, 3, false);
  }
  EXPECT_EQ(record.n_contact_rows, 1u);
  EXPECT_EQ(record.n_body_rows, 4u);
  const std::string contacts = content(directory + "/contacts.csv");
  // The moments on a about (0, 0), on b about (2, 0).
  EXPECT_NE(contacts.find("\n2,1,a-b,a,b,3,1,0.5,"), std::string::npos) << contacts;
  EXPECT_NE(contacts.find(",0,2,0,-1,-1,1,0,1,0,3,1,2,0,0.25,0\n3,1.5,a-b,a,b,0,0,0,"),
            std::string::npos)
    << contacts;
  // The stress of a force of 3 along x over 2 in a volume of 8.
  const std::string assembly = content(directory + "/assembly.csv");
  EXPECT_NE(assembly.find("\n2,1,2,2,1,0,1,0,0.625,0.375,4,2,-0.75,0,0.25,-0.75,-0.125,0,"),
            std::string::npos)
    << assembly;
  const std::string grains = content(directory + "/grains.csv");
  EXPECT_NE(grains.find("\n2,1,a,0,0,0,0,0,-3,-1,-1,1,2.5,-1.5,0,0.5,-1.5,-0.25,0,0.75\n"
                        "2,1,b,2,0,0,0,0,3,1,-1,1,2.5,-1.5,0,0.5,-1.5,-0.25,0,0.75\n"),
            std::string::npos)
    << grains;
  {
    LongTables<2> tables(directory, bodies);
    tables.resume(record, true, true);
    write_step(tables, bodies, 3, false);
  }
  EXPECT_EQ(content(directory + "/contacts.csv"), contacts);
  EXPECT_EQ(content(directory + "/grains.csv"), grains);
  EXPECT_EQ(content(directory + "/assembly.csv"), assembly);
  {
    LongTables<2> tables(directory, bodies, true);
    write_step(tables, bodies, 1, true);
    EXPECT_EQ(tables.assembly_values().size(), Assembly<2>::columns().size());
    EXPECT_EQ(tables.assembly_values().front(), 2.);
  }
  EXPECT_EQ(content(directory + "/contacts.csv").find("step,time,stage,pair,"), 0u);
  EXPECT_NE(content(directory + "/grains.csv").find("\n1,0.5,3,a,"), std::string::npos);
  EXPECT_NE(content(directory + "/assembly.csv").find("\n1,0.5,3,2,2,1,"), std::string::npos);
}
} // namespace
} // namespace scree
