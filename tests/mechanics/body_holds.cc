// What holds single bodies in the tangent.
#include <gtest/gtest.h>

#include <scree/mechanics/body_holds.h>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using Vector = dealii::TrilinosWrappers::MPI::Vector;

/** A disc that hardly touches a held block, and one that touches nothing. */
std::string
loose_discs()
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
         + bodies_text(
           {{"block", box_text("-0.9, -1.1", "0.9, -0.5")
                        + conditions_text({{"base", " set Type = displacement\n set On = y-"}})},
            {"disc", ball_text("-0.4, -0.2", 0.299)},
            {"far", ball_text("0.4, 0.2", 0.3)}})
         + contact_text("set Law = frictionless");
}

/** The largest component of `du` on a free body. */
double
motion_of(const EquilibriumModel<2> &model, const unsigned int free_body, const Vector &du)
{
  double result = 0.;
  for (const DofIndex unknown : model.equilibrium.free_motions().unknowns(free_body))
    result = std::max(result, std::abs(du(unknown)));
  return dealii::Utilities::MPI::max(result, model.cut.grid.communicator());
}

void
check_holds()
{
  EquilibriumModel<2> model(loose_discs());
  Equilibrium<2>     &equilibrium = model.equilibrium;
  ASSERT_EQ(equilibrium.free_bodies().size(), 2u);
  Vector u = model.state.displacement, r = u, du = u;
  equilibrium.set_time(1., u);
  equilibrium.residual(u, model.state.contact, r);
  // Forces on the discs only, one ten times as large.
  r = 0.;
  for (const unsigned int i : {0u, 1u})
    for (const DofIndex unknown : equilibrium.free_motions().unknowns(i))
      r(unknown) = i == 0 ? 1e-4 : 1e-3;
  r.compress(dealii::VectorOperation::insert);
  const auto solve = [&]() {
    model.linear_solver.solve(equilibrium.tangent(), du, r, equilibrium.is_symmetric());
  };
  const double length = 0.01;

  solve();
  const double before[] = {motion_of(model, 0, du), motion_of(model, 1, du)};
  EXPECT_GT(before[0], 100. * length);
  EXPECT_FALSE(equilibrium.body_holds().are_any());
  unsigned int n = 0;
  for (; n < 6 && equilibrium.adapt_holds(du, length); ++n)
    solve();
  EXPECT_LT(n, 6u);
  EXPECT_TRUE(equilibrium.body_holds().are_any());
  for (const unsigned int i : {0u, 1u})
    {
      const double held = motion_of(model, i, du);
      EXPECT_LT(held, 1.5 * length);
      EXPECT_GT(held, 0.05 * length);
    }
  // The force is the same, so that motions are as the inverse of the factors.
  EXPECT_GT(before[1], 5. * before[0]);

  // Of what hardly moves any more nothing is left, in the end.
  du = 0.;
  for (unsigned int k = 0; k < 40; ++k)
    EXPECT_FALSE(equilibrium.adapt_holds(du, length));
  EXPECT_FALSE(equilibrium.body_holds().are_any());
  solve();
  EXPECT_NEAR(motion_of(model, 0, du), before[0], 1e-6 * before[0]);

  EXPECT_TRUE(equilibrium.adapt_holds(du, length));
  equilibrium.body_holds().release();
  EXPECT_FALSE(equilibrium.body_holds().are_any());
}

TEST(BodyHolds, BodiesGoALittleWay)
{
  check_holds();
}

TEST(BodyHoldsMPI, BodiesGoALittleWay)
{
  check_holds();
}
} // namespace
} // namespace scree
