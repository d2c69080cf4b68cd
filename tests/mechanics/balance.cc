// What acts on each body adds up to zero in equilibrium, and only there; its rotation is found.
#include <gtest/gtest.h>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** A disc with all kinds of conditions between two blocks that it touches, on a grid of two sizes.
 */
std::string
text(const unsigned int degree, const std::string &law)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3,
                   graded_text(2, "set Cell size limit = if(x > 0.1, 0.125, 1)\n"))
         + degree_text(degree)
         + bodies_text(
           {{"floor",
             half_space_text("0, -0.5", "0, 1") + conditions_text({{"base", "set On = y-"}})},
            {"disc", "set Body force = 3*t; -20*t*(1+x)\n" + ball_text("0.01, 0.1", 0.603)
                       + conditions_text({{"held", "set On = surface\nset Where = y > 0.5\n"
                                                   "set Value = 0.002*t; -0.01*t"},
                                          {"pulled", "set Type = traction\nset On = surface\n"
                                                     "set Where = x > 0.4\nset Value = 5*t; 7*t*x"},
                                          {"pressed", "set Type = pressure\nset On = surface\n"
                                                      "set Where = x < -0.5\nset Value = 4*t"}})}})
         + "subsection Contact\nset Names = law\nsubsection law\nset Law = " + law
         + (law == "coulomb" ? "\nset Friction coefficient = 0.3" : "") + "\nend\nend\n"
         + solver_text(1e-12);
}

template <int dim>
void
expect_balance(EquilibriumModel<dim> &model, const double tolerance)
{
  const auto balances = model.equilibrium.balance(model.state.displacement);
  EXPECT_GT(balances.size(), 0u);
  for (const BodyBalance<dim> &balance : balances)
    {
      EXPECT_GT(balance.force_scale, 0.);
      EXPECT_LE(balance.force.norm(), tolerance * balance.force_scale) << balance.body;
      EXPECT_LE(balance.moment.norm(), tolerance * balance.force_scale * balance.radius)
        << balance.body;
    }
}

void
check(const unsigned int degree, const std::string &law)
{
  EquilibriumModel<2> model(text(degree, law));
  const auto          result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  expect_balance(model, 1e-9);

  // Twice the displacement is no equilibrium.
  auto u = model.state.displacement;
  u *= 2.;
  auto r = u;
  model.equilibrium.residual(u, model.contact.initial_history(), r);
  double worst = 0.;
  for (const auto &balance : model.equilibrium.balance(u))
    worst = std::max(worst, balance.force.norm() / balance.force_scale);
  EXPECT_GT(worst, 1e-2);
}

TEST(Balance, OfContactAndAllConditions)
{
  for (const unsigned int degree : {1, 2})
    for (const std::string law : {"coulomb", "frictionless", "tied"})
      check(degree, law);
}

TEST(BalanceMPI, OfContactAndAllConditions)
{
  check(2, "coulomb");
}

TEST(BalanceMPI, InThreeDimensions)
{
  EquilibriumModel<3> model(
    grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 0) + degree_text(1)
    + bodies_text({{"floor", half_space_text("0, 0, -0.3", "0, 0, 1")
                               + conditions_text({{"base", "set On = z-"}})},
                   {"top", half_space_text("0, 0, -0.3", "0.05, 0, -1")
                             + conditions_text(
                               {{"held", "set On = z+\nset Value = 0.01*t; 0.02*t*x; -0.1*t"}})}})
    + "subsection Contact\nset Names = law\nsubsection law\nset Law = stick\nend\nend\n"
    + solver_text(1e-12));
  const auto result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  expect_balance(model, 1e-9);
}

TEST(Balance, FindsTheRotationOfABody)
{
  EquilibriumModel<2> model(text(2, "frictionless"));
  auto                u = model.state.displacement;
  for (unsigned int a = 0; a < model.cut.space->n_owned_cells(); ++a)
    {
      const ActiveCell &cell     = model.cut.space->cells()[a];
      const auto       &geometry = model.cut.grid.cells()[cell.grid_cell];
      const double      angle    = cell.body == 0 ? 0.01 : -0.02;
      for (unsigned int i = 0; i < model.cut.space->basis.n_nodes; ++i)
        {
          const Point<2> x
            = geometry.lower + geometry.size * Tensor<1, 2>(model.cut.space->basis.node(i));
          u(model.cut.space->nodes(a)[i])     = 0.3 - angle * x[1];
          u(model.cut.space->nodes(a)[i] + 1) = -0.1 + angle * x[0];
        }
    }
  u.compress(VectorOperation::insert);
  auto r = u;
  model.equilibrium.residual(u, model.state.contact, r);
  const auto balances = model.equilibrium.balance(u);
  ASSERT_EQ(balances.size(), 2u);
  EXPECT_NEAR(balances[0].rotation, 0.01, 1e-12);
  EXPECT_NEAR(balances[1].rotation, 0.02, 1e-12);
}

// Round-off is that of the stiffness where the displacement is: a hard body at rest has none.
TEST(Balance, RoundOffOfEveryUnknownCounts)
{
  EquilibriumModel<2> model(text(1, "frictionless"));
  auto                u = model.state.displacement, r = u;
  model.equilibrium.residual(u, model.state.contact, r);
  EXPECT_EQ(model.equilibrium.round_off(), 0.);
  u = 1.;
  model.equilibrium.residual(u, model.state.contact, r);
  const double all = model.equilibrium.round_off();
  EXPECT_GT(all, 0.);
  u *= 1e-3;
  model.equilibrium.residual(u, model.state.contact, r);
  EXPECT_NEAR(model.equilibrium.round_off(), 1e-3 * all, 1e-12 * all);
}
} // namespace
} // namespace scree
