// Energies and resultants: what the loads did is stored, and forces and moments balance.
#include <gtest/gtest.h>

#include <iostream>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** A disc clipped at the bottom under all kinds of linear conditions; loads grow with t. */
std::string
loaded_disc(const unsigned int degree, const std::string &refinement, const std::string &method)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 2, refinement) + degree_text(degree)
         + bodies_text(
           {{"disc",
             "set Body force = 3*t; -20*t*(1+x)\n" + ball_text("0.01, -0.3", 0.9123)
               + conditions_text(
                 {{"base", "set On = y-\nset Value = 0.01*t; 0.02*t*x"},
                  {"held", "set On = surface\nset Where = x > 0.5\nset Components = y\n"
                           "set Method = "
                             + method + "\nset Value = 0.03*t*(1+y)"},
                  {"pulled", "set Type = traction\nset On = surface\nset Where = y > 0.4\n"
                             "set Value = 5*t; 7*t*x"},
                  {"pressed", "set Type = pressure\nset On = surface\nset Where = x < -0.5\n"
                              "set Value = 4*t"},
                  {"sprung", "set Type = springs\nset On = surface\nset Where = y > 0\n"
                             "set Components = x\nset Value = 200"}})}})
         + solver_text(1e-12);
}

void
check_balance(const std::string &text, const unsigned int n_steps)
{
  EquilibriumModel<2> model(text);
  for (unsigned int i = 1; i <= n_steps; ++i)
    {
      const auto result = model.step(double(i) / n_steps);
      ASSERT_TRUE(result.converged()) << result.message;
    }
  const Energies &energies = model.equilibrium.energies();
  std::cout << "  work " << energies.external_work << ", strain " << energies.strain << ", ghost "
            << energies.ghost_penalty << ", boundary " << energies.boundary << ", error "
            << energies.balance_error() << "\n";
  EXPECT_GT(energies.strain, 0.);
  EXPECT_GT(std::abs(energies.boundary), 0.);
  EXPECT_LE(std::abs(energies.balance_error()), 1e-10 * energies.external_work);
}

TEST(Energy, LinearProblemsBalance)
{
  for (const unsigned int degree : {1, 2})
    for (const std::string &refinement :
         {std::string(), graded_text(1, "set Cell size limit = if(x > 0.1, 0.125, 1)\n")})
      check_balance(loaded_disc(degree, refinement, "nitsche"), 2);
}

TEST(Energy, PenaltyAndProportionalStepsBalance)
{
  check_balance(loaded_disc(1, "", "penalty"), 1);
  check_balance(loaded_disc(1, "", "penalty"), 3);
}

TEST(EnergyMPI, LinearProblemsBalance)
{
  check_balance(loaded_disc(2, "", "nitsche"), 2);
}

TEST(Energy, ConstantPrescribedValuesBalance)
{
  // Loads that are there from the first step on count as ramps from the unloaded state.
  std::string text = loaded_disc(1, "", "nitsche");
  for (std::size_t at = text.find("*t"); at != std::string::npos; at = text.find("*t"))
    text.replace(at, 2, "");
  check_balance(text, 1);
}

/** Two blocks pressed together and sheared along a path; energies after n steps. */
Energies
sheared_blocks(const std::string &law, const std::string &path, const unsigned int n_steps)
{
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
    + bodies_text(
      {{"lower", half_space_text("0, 0.01", "0.1, 1") + conditions_text({{"base", "set On = y-"}})},
       {"upper", half_space_text("0, 0.01", "-0.1, -1")
                   + conditions_text({{"top", "set On = y+\nset Value = " + path}})}})
    + contact_text(law) + solver_text(1e-12));
  double last_dissipation = 0.;
  for (unsigned int i = 1; i <= n_steps; ++i)
    {
      const auto result = model.step(double(i) / n_steps);
      EXPECT_TRUE(result.converged()) << result.message;
      // Never negative, up to round-off of works that cancel.
      EXPECT_GE(model.equilibrium.energies().dissipation,
                last_dissipation - 1e-12 * model.equilibrium.energies().external_work);
      last_dissipation = model.equilibrium.energies().dissipation;
    }
  return model.equilibrium.energies();
}

const char *const slippery = "set Law = coulomb\nset Friction coefficient = 0.2";

TEST(Energy, TiedBlocksBalance)
{
  const Energies energies = sheared_blocks("set Law = tied", "0.02*t; 0.01*t", 2);
  EXPECT_LE(std::abs(energies.balance_error()), 1e-10 * energies.external_work);
  EXPECT_LE(std::abs(energies.dissipation), 1e-12 * energies.external_work);
}

TEST(Energy, FrictionBalances)
{
  // Pressed first, then sheared until all points slip in one direction: no error of the steps.
  for (const unsigned int n_steps : {2, 8})
    {
      const Energies energies
        = sheared_blocks(slippery, "0.02*max(0, t - 0.5); -0.01*min(t, 0.5)", n_steps);
      EXPECT_GT(energies.dissipation, 0.3 * energies.external_work);
      EXPECT_LE(std::abs(energies.balance_error()), 1e-10 * energies.external_work);
    }
}

TEST(Energy, GrowingContactBalancesWithSmallSteps)
{
  double last = 0.;
  for (const unsigned int n_steps : {2, 8, 32})
    {
      EquilibriumModel<2> model(
        grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
        + bodies_text(
          {{"block", half_space_text("0, 0", "0, 1") + conditions_text({{"base", "set On = y-"}})},
           {"disc", ball_text("0, 1.2", 1.2)
                      + conditions_text({{"top", "set On = y+\nset Value = 0.02*t; -0.05*t"}})}})
        + contact_text(slippery) + solver_text(1e-12));
      for (unsigned int i = 1; i <= n_steps; ++i)
        ASSERT_TRUE(model.step(double(i) / n_steps).converged());
      const Energies &energies = model.equilibrium.energies();
      const double    error    = std::abs(energies.balance_error()) / energies.external_work;
      std::cout << "  " << n_steps << " steps: dissipation / work "
                << energies.dissipation / energies.external_work << ", balance error / work "
                << error << "\n";
      EXPECT_GT(energies.dissipation, 0.);
      if (n_steps > 2)
        {
          EXPECT_LE(error, 0.5 * last);
        }
      last = error;
    }
  EXPECT_LE(last, 1e-2);
}

/** Sum of the resultants on the body, with the body force of loaded_disc() at t = 1. */
template <int dim>
void
check_resultants(EquilibriumModel<dim> &model, const std::string &body_force)
{
  const auto result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  Tensor<1, dim> force;
  Tensor<1, 3>   moment;
  double         size       = 0.;
  const auto     resultants = model.equilibrium.resultants(model.state.displacement);
  ASSERT_EQ(resultants.size(), model.equilibrium.condition_names().size());
  for (unsigned int i = 0; i < resultants.size(); ++i)
    {
      force += resultants[i].force;
      moment += resultants[i].moment;
      size += resultants[i].force.norm();
    }
  const Expression<dim> density(body_force, dim, "body force");
  const auto           &space = *model.cut.space;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const auto &cell = model.cut.grid.cells()[space.cells()[a].grid_cell];
      const auto  add  = [&](const Point<dim> &unit, const double weight) {
        const Point<dim>     x = cell.lower + cell.size * Tensor<1, dim>(unit);
        const Tensor<1, dim> f = weight * density.vector(x, 1.);
        force += f;
        moment += moment_of<dim>(x, f);
      };
      if (space.cells()[a].is_cut)
        for (unsigned int q = model.quadrature.bulk.begin[a];
             q < model.quadrature.bulk.begin[a + 1]; ++q)
          add(model.quadrature.bulk.points[q], model.quadrature.bulk.weights[q]);
      const auto &surface = model.quadrature.surface;
      for (unsigned int q = surface.begin[a]; q < surface.begin[a + 1]; ++q)
        {
          const double width = model.quadrature.strip_widths[q];
          add(surface.points[q] + 0.5 * width / cell.size * surface.normals[q],
              width * surface.weights[q]);
        }
      if (!space.cells()[a].is_cut)
        for (unsigned int q = 0; q < model.quadrature.whole_cell.points.size(); ++q)
          add(model.quadrature.whole_cell.points[q],
              model.quadrature.whole_cell.weights[q] * std::pow(cell.size, dim));
    }
  std::cout << "  forces of size " << size << ": sum " << force.norm() << ", of moments "
            << moment.norm() << "\n";
  EXPECT_GT(size, 1.);
  EXPECT_LE(force.norm(), 1e-8 * size);
  EXPECT_LE(moment.norm(), 1e-8 * size);
}

TEST(Resultants, AllConditionsBalance)
{
  for (const unsigned int degree : {1, 2})
    for (const std::string method : {"nitsche", "nonsymmetric nitsche", "penalty"})
      {
        EquilibriumModel<2> model(loaded_disc(
          degree, graded_text(1, "set Cell size limit = if(x > 0.1, 0.125, 1)\n"), method));
        check_resultants(model, "3*t; -20*t*(1+x)");
      }
}

TEST(Resultants, MeanSupportsBalance)
{
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
    + bodies_text(
      {{"disc", "set Body force = 3*t; -20*t*(1+x)\n" + ball_text("0.01, -0.3", 0.6)
                  + conditions_text({{"mean", "set Type = mean support\nset Where = x < 0.3\n"
                                              "set Components = x, y, rotation\n"
                                              "set Value = 0; 0; 0"}})}})
    + solver_text(1e-12));
  check_resultants(model, "3*t; -20*t*(1+x)");
}

TEST(Energy, MeanSupportsThatMoveBalance)
{
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
    + bodies_text(
      {{"disc", ball_text("0.01, -0.3", 0.6)
                  + conditions_text({{"mean", "set Type = mean support\nset Where = x < 0\n"
                                              "set Components = x, y, rotation\n"
                                              "set Value = 0; 0; 0"},
                                     {"moved", "set Type = mean support\nset Where = x > 0.3\n"
                                               "set Components = x\nset Value = 0.01*t"}})}})
    + solver_text(1e-12));
  ASSERT_TRUE(model.step(1.).converged());
  const Energies &energies = model.equilibrium.energies();
  EXPECT_GT(energies.strain, 0.);
  EXPECT_LE(std::abs(energies.balance_error()), 1e-10 * energies.strain);
}

TEST(Resultants, Balance3D)
{
  EquilibriumModel<3> model(
    grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 1) + degree_text(1)
    + bodies_text(
      {{"ball", "set Body force = 3*t; -20*t*(1+x); y*t\n" + ball_text("0.01, 0.02, -0.3", 0.9123)
                  + conditions_text(
                    {{"base", "set On = z-\nset Value = 0.01*t; 0.02*t*x; 0"},
                     {"held", "set On = surface\nset Where = x > 0.5\nset Components = y\n"
                              "set Value = 0.03*t*(1+y)"},
                     {"pulled", "set Type = traction\nset On = surface\nset Where = z > 0.4\n"
                                "set Value = 5*t; 7*t*x; 1*t"}})}})
    + solver_text(1e-12));
  check_resultants(model, "3*t; -20*t*(1+x); y*t");
}

TEST(Resultants, ContactBalances)
{
  // Each body alone: its conditions against the tractions of the contact surface.
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(1)
    + bodies_text(
      {{"block", half_space_text("0, 0", "0, 1") + conditions_text({{"base", "set On = y-"}})},
       {"disc", ball_text("0, 0.8", 0.8)
                  + conditions_text({{"top", "set On = y+\nset Value = 0.01*t; -0.02*t"}})}})
    + contact_text("set Law = coulomb\nset Friction coefficient = 0.4") + solver_text(1e-12));
  const auto result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  Tensor<1, 2> on_disc;
  for (unsigned int i = 0; i < model.contact.points().size(); ++i)
    on_disc += model.contact.points()[i].weight
               * model.contact.responses()[i].traction(model.contact.points()[i].normal);
  const auto resultants = model.equilibrium.resultants(model.state.displacement);
  ASSERT_EQ(model.equilibrium.condition_names(),
            (std::vector<std::string>{"block.base", "disc.top"}));
  EXPECT_GT(on_disc[1], 0.1);
  EXPECT_LE((resultants[0].force - on_disc).norm(), 1e-8 * on_disc.norm());
  EXPECT_LE((resultants[1].force + on_disc).norm(), 1e-8 * on_disc.norm());
  // Closed by a trapezoidal rule of one step: the contact energy is of the balance's size.
  const Energies &energies = model.equilibrium.energies();
  EXPECT_GT(energies.contact, 0.);
  EXPECT_GE(energies.dissipation, 0.);
}
} // namespace
} // namespace scree
