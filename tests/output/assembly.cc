// A packing as an assembly: numbers of a square lattice of discs, and the stress of bodies by
// fields and by forces.
#include <gtest/gtest.h>

#include <scree/output/assembly.h>

#include <cmath>

#include "../mechanics/equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** A closed contact that acts at one place. */
ContactSummary<2>
contact_at(const Point<2> &place, const Tensor<1, 2> &normal, const Tensor<1, 2> &force)
{
  ContactSummary<2> summary;
  summary.force        = force;
  summary.strength     = force.norm();
  summary.placed       = summary.strength * Tensor<1, 2>(place);
  summary.directed     = summary.strength * normal;
  summary.virial_a     = outer_product(force, Tensor<1, 2>(place));
  summary.virial_b     = summary.virial_a;
  summary.stick_points = 1.;
  return summary;
}

/** Four discs of diameter 1 in a square on a rigid floor, and one that touches the last. */
struct Square
{
  EquilibriumModel<2> model{
    grid_text("0, -1", "4, 3", "4, 4", 2) + degree_text(1)
    + bodies_text({{"g0", ball_text("0.5, 0.5", 0.5)},
                   {"g1", ball_text("1.5, 0.5", 0.5)},
                   {"g2", ball_text("0.5, 1.5", 0.5)},
                   {"g3", ball_text("1.5, 1.5", 0.5)},
                   {"loose", ball_text("2.5, 1.5", 0.5)},
                   {"floor", half_space_text("0, 0", "0, 1") + motion_text("")}})};
  std::vector<ContactPair>       pairs;
  std::vector<ContactSummary<2>> summaries;
  std::vector<MeanMotion<2>>     motions;
  std::vector<BodyStress<2>>     stresses;

  Square()
  {
    const Tensor<1, 2> x({1., 0.}), y({0., 1.});
    const auto         add
      = [&](const unsigned int a, const unsigned int b, const ContactSummary<2> &summary) {
          ContactPairParameters law;
          law.friction_coefficient = 0.5;
          pairs.push_back({a, b, "", law});
          summaries.push_back(summary);
        };
    add(0, 1, contact_at({1., 0.5}, x, x));
    add(2, 3, contact_at({1., 1.5}, x, x));
    for (const unsigned int i : {0u, 1u})
      {
        add(i, i + 2, contact_at({i + 0.5, 1.}, y, 2. * y + 0.2 * x));
        add(i, 5, contact_at({i + 0.5, 0.}, -y, -2. * y));
      }
    add(3, 4, contact_at({2., 1.5}, x, 1e-9 * x));
    motions.resize(6);
    stresses.resize(6);
    for (unsigned int i = 0; i < 5; ++i)
      {
        motions[i].position               = model.cut.bodies[i].box.center();
        stresses[i].integral.volume       = 0.75;
        stresses[i].integral.moved_volume = 0.7;
        stresses[i].integral.stress[0][0] = -0.3;
      }
  }

  Assembly<2> assembly() const
  {
    const auto &bodies = model.cut.bodies;
    return {AssemblyRegion<2>{4., Tensor<1, 2>({2., 2.})}, bodies, pairs, summaries,
            grain_states(bodies, pairs, summaries, motions, stresses, true)};
  }
};

TEST(Assembly, OfASquareLattice)
{
  const Assembly<2> assembly = Square().assembly();
  EXPECT_EQ(assembly.n_grains, 5u);
  EXPECT_EQ(assembly.n_contacts, 4u);
  EXPECT_EQ(assembly.n_wall_contacts, 2u);
  // The fifth disc and its contact carry nothing.
  EXPECT_EQ(assembly.n_rattlers, 1u);
  EXPECT_NEAR(assembly.coordination, 10. / 5., 1e-14);
  EXPECT_NEAR(assembly.mechanical_coordination, 10. / 4., 1e-14);
  EXPECT_NEAR(assembly.solid_fraction, 5. * 0.7 / 4., 1e-14);
  EXPECT_NEAR(assembly.stress[0][0], 5. * -0.3 / 4., 1e-14);
  // -1/4 of two forces along x over 1, two of (0.2, 2) along y over 1, two of 2 along y over 1/2
  EXPECT_NEAR(assembly.force_stress[0][0], -0.5, 1e-8);
  EXPECT_NEAR(assembly.force_stress[0][1], -0.05, 1e-14);
  EXPECT_NEAR(assembly.force_stress[1][1], -1.5, 1e-14);
  EXPECT_NEAR(assembly.p, 1., 1e-8);
  EXPECT_NEAR(assembly.q, std::hypot(0.5, 0.05), 1e-8);
  EXPECT_NEAR(assembly.fabric[0][0], 0.5, 1e-14);
  EXPECT_NEAR(assembly.fabric[1][1], 0.5, 1e-14);
  EXPECT_NEAR(assembly.force_fabric[0][0], 2. / 6., 1e-14);
  EXPECT_NEAR(assembly.force_fabric[1][1], 4. / 6., 1e-14);
  EXPECT_NEAR(assembly.mobilised_friction, 0.4 / (0.5 * 10.), 1e-14);
}

TEST(Assembly, OfDiscsApart)
{
  Square square;
  for (auto &summary : square.summaries)
    summary = {};
  const Assembly<2> assembly = square.assembly();
  EXPECT_EQ(assembly.n_rattlers, 5u);
  for (const double value : assembly.values())
    EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(assembly.values().size(), Assembly<2>::columns().size());
  EXPECT_EQ(assembly.p, 0.);
}

/** The region of the discs of Square without its floor, between `walls`. */
AssemblyRegion<2>
region_between(const std::vector<std::pair<std::string, std::string>> &walls)
{
  auto bodies = std::vector<std::pair<std::string, std::string>>(
    {{"g0", ball_text("0.5, 0.5", 0.5)}, {"loose", ball_text("2.5, 1.5", 0.5)}});
  bodies.insert(bodies.end(), walls.begin(), walls.end());
  EquilibriumModel<2> model(grid_text("-1, -1", "4, 3", "5, 4", 3) + degree_text(1)
                            + bodies_text(bodies)
                            + "subsection Contact\n set Names = none\n subsection none\n"
                              "  set Law = none\n end\nend\n");
  auto                u = model.state.displacement;
  model.equilibrium.set_time(1., u);
  return assembly_region<2>(*model.cut.space, *model.cut.level_set_nodes, model.cut.bodies,
                            model.quadrature, model.equilibrium.with_ghosts(u));
}

TEST(AssemblyRegion, EndsAtFlatWallsAndWithTheGrains)
{
  const std::string still = motion_text("");
  const auto        alone = region_between({});
  // Grains end at the outermost quadrature points of their surface, 0.003 inside.
  EXPECT_NEAR(alone.volume, 3. * 2., 0.04);
  EXPECT_NEAR(alone.lengths[0], 3., 0.01);
  // x > -0.2, y > 0, and x < 3.2 + 0.1 y; above there is no wall.
  const auto leaning = region_between({{"left", half_space_text("-0.2, 0", "1, 0") + still},
                                       {"floor", half_space_text("0, 0", "0, 2") + still},
                                       {"right", half_space_text("3.2, 0", "-1, 0.1") + still}});
  EXPECT_NEAR(leaning.volume, 3.4 * 2. + 0.1 * 2., 0.02);
  EXPECT_NEAR(leaning.lengths[0], 3.5, 0.001);
  EXPECT_NEAR(leaning.lengths[1], 2., 0.005);
  // Simple shear by sides that turn: the area stays.
  const std::string turn    = "set Rotation = -0.1*t\nset Reference point = ";
  const auto        sheared = region_between(
           {{"left", half_space_text("-0.2, -0.1", "1, 0") + motion_text(turn + "-0.2, -0.1")},
            {"right", half_space_text("3.2, -0.1", "-1, 0") + motion_text(turn + "3.2, -0.1")},
            {"floor", half_space_text("0, -0.1", "0, 1") + still},
            {"roof", half_space_text("0, 2.1", "0, -1") + still}});
  EXPECT_NEAR(sheared.volume, 3.4 * 2.2, 1e-10);
  EXPECT_NEAR(sheared.lengths[0], 3.4, 1e-10);
  EXPECT_NEAR(sheared.lengths[1], 2.2, 1e-10);
}

TEST(AssemblyRegion, ABodyAmongGrainsIsNoWall)
{
  const std::string box = box_text("1.2, -0.5", "1.6, 2.5") + motion_text("");
  EXPECT_NEAR(region_between({{"tool", box}}).volume, 3. * 2., 0.04);
}

TEST(GrainStates, StressByForces)
{
  const Square square;
  const auto   states = grain_states(square.model.cut.bodies, square.pairs, square.summaries,
                                     square.motions, square.stresses, true);
  // On the third disc: -1 along x at its right, (0.2, 2) at its foot.
  EXPECT_NEAR(states[0].stress[0][0], -0.3 / 0.75, 1e-14);
  EXPECT_NEAR(states[0].volume, 0.7, 1e-14);
  EXPECT_NEAR(states[2].force_stress[0][0], -1. * 0.5 / 0.75, 1e-14);
  EXPECT_NEAR(states[2].force_stress[0][1], 0.5 * 0.2 * -0.5 / 0.75, 1e-14);
  EXPECT_NEAR(states[2].force_stress[1][1], 2. * -0.5 / 0.75, 1e-14);
  EXPECT_TRUE(std::isnan(states[5].volume));
}
} // namespace
} // namespace scree
