// Error estimate by strain recovery: its size, its place, the same on any number of processes.
#include <gtest/gtest.h>

#include <scree/mechanics/error_indicator.h>

#include <iostream>
#include <numeric>

#include "manufactured.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Strain of Manufactured<2>::displacement(). */
SymmetricTensor<2, 2>
exact_strain(const Point<2> &p)
{
  const double          x = p[0], y = p[1];
  SymmetricTensor<2, 2> strain;
  strain[0][0] = 1.3 * std::cos(1.3 * x + 0.4) * std::cos(0.9 * y - 0.2);
  strain[1][1] = 1.1 * std::cos(0.8 * x + 0.3) * std::cos(1.1 * y + 0.5);
  strain[0][1] = -0.45 * std::sin(1.3 * x + 0.4) * std::sin(0.9 * y - 0.2)
                 - 0.4 * std::sin(0.8 * x + 0.3) * std::sin(1.1 * y + 0.5);
  return strain;
}

/** Estimated and true error in the energy norm. */
std::pair<double, double>
errors(EquilibriumModel<2> &model)
{
  EXPECT_LT(Manufactured<2>::solve(model), 0.1);
  const auto &space     = *model.cut.space;
  const auto  u         = model.equilibrium.with_ghosts(model.state.displacement);
  const auto  field     = model.equilibrium.at_points(model.state.displacement);
  const auto  estimated = recovery_errors(space, model.quadrature, model.cut.bodies, model.bulk, u);
  double      true_square = 0.;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const auto &cell = model.cut.grid.cells()[space.cells()[a].grid_cell];
      const auto  add  = [&](const Point<2> &unit, const double weight) {
        const auto difference = exact_strain(cell.lower + cell.size * Tensor<1, 2>(unit))
                                - model.bulk.sample(a, unit, field).strain;
        true_square += weight * (model.cut.bodies[0].material->stress(difference) * difference);
      };
      if (space.cells()[a].is_cut)
        for (unsigned int q = model.quadrature.bulk.begin[a];
             q < model.quadrature.bulk.begin[a + 1]; ++q)
          add(model.quadrature.bulk.points[q], model.quadrature.bulk.weights[q]);
      else
        for (unsigned int q = 0; q < model.quadrature.whole_cell.points.size(); ++q)
          add(model.quadrature.whole_cell.points[q],
              model.quadrature.whole_cell.weights[q] * cell.size * cell.size);
    }
  const MPI_Comm communicator = model.cut.grid.communicator();
  const double   sum          = std::accumulate(estimated.begin(), estimated.end(), 0.);
  return {std::sqrt(Utilities::MPI::sum(sum, communicator)),
          std::sqrt(Utilities::MPI::sum(true_square, communicator))};
}

std::string
disc_text(const unsigned int degree, const unsigned int level, const std::string &refinement = "")
{
  return grid_text("-1, -1", "1, 1", "4, 4", level, refinement) + degree_text(degree)
         + bodies_text({{"body", Manufactured<2>::body(ball_text("0.0123, -0.0345", 0.8123), {})}})
         + solver_text(1e-11);
}

TEST(ErrorIndicator, EstimatesTheError)
{
  for (const unsigned int degree : {1, 2})
    for (const unsigned int level : {2, 3})
      {
        EquilibriumModel<2> model(disc_text(degree, level));
        const auto [estimated, exact] = errors(model);
        std::cout << "  disc, Q" << degree << ", level " << level << ": energy error " << exact
                  << ", estimate/error " << estimated / exact << "\n";
        EXPECT_GT(estimated / exact, 0.85);
        EXPECT_LT(estimated / exact, 1.1);
      }
}

TEST(ErrorIndicatorMPI, EqualsOneProcess)
{
  for (const unsigned int degree : {1, 2})
    {
      const std::string text = disc_text(
        degree, 3, graded_text(2, "set Cell size limit = if(x > 0.1, 0.0625, 0.125)\n"));
      EquilibriumModel<2> together(text), alone(text, MPI_COMM_SELF);
      const double        expected = errors(alone).first;
      EXPECT_NEAR(errors(together).first, expected, 1e-7 * expected);
    }
}

TEST(ErrorIndicatorMPI, LargestShare)
{
  // 1 .. 10 on every process: 10, 9, ... until half of the sum is reached.
  std::vector<double> values(10);
  std::iota(values.begin(), values.end(), 1.);
  const auto         half    = largest_share(values, 0.5, MPI_COMM_WORLD);
  const unsigned int n_marks = std::count(half.begin(), half.end(), true);
  EXPECT_EQ(n_marks, 4u); // 10 + 9 + 8 = 27 < 27.5
  EXPECT_TRUE(half[9] && half[6] && !half[5]);
  const auto all = largest_share(values, 1., MPI_COMM_WORLD);
  EXPECT_EQ(std::count(all.begin(), all.end(), true), 10);
  const auto none = largest_share(values, 0., MPI_COMM_WORLD);
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
  const auto zeros = largest_share(std::vector<double>(5, 0.), 0.5, MPI_COMM_WORLD);
  EXPECT_EQ(std::count(zeros.begin(), zeros.end(), true), 0);
}
} // namespace
} // namespace scree
