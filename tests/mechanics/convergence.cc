// Cut-cell elasticity with a manufactured field: order k + 1 in L2.
#include <gtest/gtest.h>

#include <iostream>

#include "manufactured.h"

namespace scree
{
namespace
{
/** The smallest order between successive grids, with a table. */
double
smallest_order(const std::string &body, const unsigned int degree, const std::string &refinement,
               const std::string &name)
{
  double smallest = 10., last = 0.;
  for (unsigned int level = 1; level < 4; ++level)
    {
      EquilibriumModel<2> model(grid_text("-1, -1", "1, 1", "4, 4", level, refinement)
                                + degree_text(degree) + bodies_text({{"body", body}})
                                + solver_text(1e-11));
      const double        error = Manufactured<2>::solve(model);
      const double        order = std::log2(last / error);
      std::cout << "  " << name << ", Q" << degree << ", h = " << model.cut.grid.finest_size()
                << ": L2 error " << error;
      if (level > 1)
        {
          std::cout << ", order " << order;
          smallest = std::min(smallest, order);
        }
      std::cout << "\n";
      last = error;
    }
  return smallest;
}

std::string
angled_body()
{
  return Manufactured<2>::body(half_space_text("0.0123, 0.2345", "0.2923717, 0.9563048"),
                               {"x-", "x+", "y-"});
}

std::string
disc()
{
  return Manufactured<2>::body(ball_text("0.0123, -0.0345", 0.8123), {});
}

TEST(Convergence, HalfPlaneAtAnAngle)
{
  EXPECT_GT(smallest_order(angled_body(), 1, "", "angle"), 1.85);
  EXPECT_GT(smallest_order(angled_body(), 2, "", "angle"), 2.8);
}

TEST(Convergence, Disc)
{
  EXPECT_GT(smallest_order(disc(), 1, "", "disc"), 1.85);
  EXPECT_GT(smallest_order(disc(), 2, "", "disc"), 2.8);
}

TEST(Convergence, HangingCutCells)
{
  // Half of the disc one level coarser: the order of the coarse part.
  const auto graded = [](const unsigned int degree) {
    double errors[2];
    for (const unsigned int i : {0, 1})
      {
        const std::string limit = "set Cell size limit = if(x > 0.1, "
                                  + std::to_string(0.125 / (1 << i)) + ", "
                                  + std::to_string(0.25 / (1 << i)) + ")\n";
        EquilibriumModel<2> model(
          grid_text("-1, -1", "1, 1", "4, 4", 2 + i, graded_text(1 + i, limit))
          + degree_text(degree) + bodies_text({{"body", disc()}}) + solver_text(1e-11));
        EXPECT_TRUE(model.cut.grid.triangulation().has_hanging_nodes());
        errors[i] = Manufactured<2>::solve(model);
      }
    std::cout << "  graded disc, Q" << degree << ": L2 errors " << errors[0] << ", " << errors[1]
              << "\n";
    return std::log2(errors[0] / errors[1]);
  };
  EXPECT_GT(graded(1), 1.8);
  EXPECT_GT(graded(2), 2.7);
}

TEST(ConvergenceMPI, EqualsOneProcess)
{
  for (const unsigned int degree : {1, 2})
    {
      const std::string limit = "set Cell size limit = if(x > 0.1, 0.125, 0.25)\n";
      const std::string text  = grid_text("-1, -1", "1, 1", "4, 4", 2, graded_text(1, limit))
                               + degree_text(degree) + bodies_text({{"body", angled_body()}})
                               + solver_text(1e-11);
      EquilibriumModel<2> together(text), alone(text, MPI_COMM_SELF);
      EXPECT_EQ(together.cut.space->n_dofs(), alone.cut.space->n_dofs());
      const double error = Manufactured<2>::solve(alone);
      EXPECT_NEAR(Manufactured<2>::solve(together), error, 1e-9 * error);
      const auto &energies = together.equilibrium.energies(),
                 &others   = alone.equilibrium.energies();
      EXPECT_NEAR(energies.strain, others.strain, 1e-9 * others.strain);
      EXPECT_NEAR(energies.external_work, others.external_work, 1e-9 * others.strain);
      EXPECT_NEAR(energies.ghost_penalty, others.ghost_penalty, 1e-9 * others.strain);
      EXPECT_NEAR(energies.boundary, others.boundary, 1e-9 * others.strain);
    }
}
} // namespace
} // namespace scree
