// Three dimensions: order of cut elasticity, cuts at any offset, patch tests of contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>

#include "manufactured.h"

namespace scree
{
namespace
{
std::string
ball()
{
  return Manufactured<3>::body(ball_text("0.0123, -0.0345, 0.0234", 0.8123), {});
}

/** A box turned about the space diagonal. */
std::string
turned_box()
{
  return Manufactured<3>::body(shape_text("box",
                                          "set Lower corner = -0.5123, -0.6234, -0.4321\n"
                                          "set Upper corner = 0.5321, 0.4987, 0.6012\n"
                                          "set Rotation axis = 1, 1, 1\nset Rotation angle = 23"),
                               {});
}

/** A half-space with a boundary at angles to all axes, clipped by the box. */
std::string
angled_body()
{
  return Manufactured<3>::body(half_space_text("0.0123, 0.0345, 0.2345", "0.2, -0.3, 0.9327"),
                               {"x-", "x+", "y-", "y+", "z-"});
}

/** Relative L2 errors for h = 1/(2 * 2^level) on [-1, 1]^3. */
std::vector<double>
errors(const std::string &body, const unsigned int degree, const std::vector<unsigned int> &levels,
       const std::string &name)
{
  std::vector<double> result;
  for (const unsigned int level : levels)
    {
      EquilibriumModel<3> model(grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", level)
                                + degree_text(degree) + bodies_text({{"body", body}})
                                + solver_text(1e-9, degree == 1 ? "iterative" : "direct"));
      result.push_back(Manufactured<3>::solve(model));
      std::cout << "  " << name << ", Q" << degree << ", h = " << model.cut.grid.finest_size()
                << ": " << model.cut.space->n_dofs() << " unknowns, L2 error " << result.back()
                << ", " << model.linear_iterations << " linear iterations";
      if (result.size() > 1)
        std::cout << ", order " << std::log2(result[result.size() - 2] / result.back());
      std::cout << "\n";
    }
  return result;
}

double
last_order(const std::vector<double> &errors)
{
  return std::log2(errors[errors.size() - 2] / errors.back());
}

TEST(ReleaseThreeDimensions, OrderLinear)
{
  EXPECT_GT(last_order(errors(ball(), 1, {1, 2, 3}, "ball")), 1.85);
  EXPECT_GT(last_order(errors(turned_box(), 1, {1, 2, 3}, "turned box")), 1.85);
  EXPECT_GT(last_order(errors(angled_body(), 1, {1, 2}, "half-space")), 1.85);
}

TEST(ReleaseThreeDimensions, OrderQuadratic)
{
  EXPECT_GT(last_order(errors(ball(), 2, {0, 1}, "ball")), 2.8);
}

TEST(ReleaseThreeDimensions, HangingCutCells)
{
  // Half of the ball one level coarser: the order of the coarse part.
  double result[2];
  for (const unsigned int i : {0, 1})
    {
      const std::string limit = "set Cell size limit = if(x > 0.1, "
                                + std::to_string(0.125 / (1 << i)) + ", "
                                + std::to_string(0.25 / (1 << i)) + ")\n";
      EquilibriumModel<3> model(
        grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 2 + i, graded_text(1 + i, limit))
        + bodies_text({{"body", ball()}}) + solver_text(1e-9, "iterative"));
      EXPECT_TRUE(model.cut.grid.triangulation().has_hanging_nodes());
      result[i] = Manufactured<3>::solve(model);
    }
  std::cout << "  graded ball: L2 errors " << result[0] << ", " << result[1] << "\n";
  EXPECT_GT(std::log2(result[0] / result[1]), 1.8);
}

TEST(ReleaseThreeDimensions, CutsAtAnyOffset)
{
  const double              h = 0.125;
  std::vector<double>       found;
  std::vector<unsigned int> iterations;
  for (const double offset : {0., 1e-9, 1e-6, 1e-3, 0.1, 0.3, 0.5, 0.8, 1. - 1e-3})
    {
      std::ostringstream point;
      point.precision(17);
      point << "0, 0, " << 0.25 + offset * h;
      EquilibriumModel<3> model(
        grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 2)
        + bodies_text({{"body", Manufactured<3>::body(half_space_text(point.str(), "0, 0, 1"),
                                                      {"x-", "x+", "y-", "y+", "z-"})}})
        + solver_text(1e-8, "iterative"));
      found.push_back(Manufactured<3>::solve(model));
      iterations.push_back(model.linear_iterations);
    }
  const auto [least, most]   = std::minmax_element(found.begin(), found.end());
  const auto [fewest, count] = std::minmax_element(iterations.begin(), iterations.end());
  std::cout << "  L2 errors " << *least << " to " << *most << ", " << *fewest << " to " << *count
            << " linear iterations\n";
  EXPECT_LE(*most, 1.3 * *least);
  EXPECT_LE(*count, *fewest + 8);
}

/** Two blocks divided by a plane through (0.5, 0.5, 1) with normal n, pressed down by 0.002. */
std::string
patch_text(const std::string &normal, const std::string &opposite, const std::string &law,
           const std::string &refinement)
{
  const std::string plane = "0.5, 0.5, 1";
  const std::string lower
    = half_space_text(plane, normal)
      + conditions_text({{"base", "set On = z-\nset Components = z"},
                         {"corner", "set Type = point support\nset Point = 0, 0, 0\n"
                                    "set Components = x, y"},
                         {"turn", "set Type = point support\nset Point = 1, 0, 0\n"
                                  "set Components = y"}});
  const std::string upper
    = half_space_text(plane, opposite)
      + conditions_text({{"top", "set On = z+\nset Components = z\nset Value = -0.002*t"}});
  return grid_text("0, 0, 0", "1, 1, 2", "1, 1, 2", 3, refinement)
         + bodies_text({{"lower", lower}, {"upper", upper}}) + contact_text(law)
         + solver_text(1e-11);
}

/** Uniform uniaxial stress s = 0.002/(2/E + n_z/eps), pressure s n_z^2 at every contact point. */
void
expect_uniform_pressure(EquilibriumModel<3> &model, const double n_z)
{
  const auto result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  const double h = model.cut.grid.finest_size(), young = 1000.;
  const double stress   = 0.002 / (2. / young + n_z / (10. * young / h));
  const double pressure = stress * n_z * n_z, shear = stress * n_z * std::sqrt(1. - n_z * n_z);
  double       area = 0., difference = 0.;
  for (unsigned int i = 0; i < model.contact.points().size(); ++i)
    {
      const auto &response = model.contact.responses()[i];
      area += model.contact.points()[i].weight;
      difference = std::max({difference, std::abs(response.pressure - pressure),
                             std::abs(response.tau.norm() - shear)});
    }
  const MPI_Comm communicator = model.cut.grid.communicator();
  difference                  = dealii::Utilities::MPI::max(difference, communicator);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    std::cout << "  n_z = " << n_z << ": " << model.cut.space->n_dofs() << " unknowns, "
              << result.iterations << " iterations, largest difference of tractions / stress "
              << difference / stress << "\n";
  EXPECT_NEAR(dealii::Utilities::MPI::sum(area, communicator), 1. / n_z, 1e-8);
  EXPECT_LT(difference, 1e-8 * stress);
}

const std::string stick   = "set Law = stick";
const std::string coulomb = "set Law = coulomb\nset Friction coefficient = 0.9";

/** Planes turned by 0, about one axis, and about two: tan^2 = n_x^2 + n_y^2 over n_z^2 < 0.9^2. */
struct Plane
{
  std::string normal, opposite;
  double      n_z;
};

std::vector<Plane>
planes()
{
  return {{"0, 0, 1", "0, 0, -1", 1.},
          {"0.3, 0, 1", "-0.3, 0, -1", 1. / std::sqrt(1.09)},
          {"-0.35, 0.2, 1", "0.35, -0.2, -1", 1. / std::sqrt(1.1625)}};
}

TEST(ReleaseThreeDimensions, PatchAtThreeAngles)
{
  for (const Plane &plane : planes())
    for (const auto &law : {stick, coulomb})
      {
        EquilibriumModel<3> model(patch_text(plane.normal, plane.opposite, law, ""));
        expect_uniform_pressure(model, plane.n_z);
      }
}

TEST(ReleaseThreeDimensions, PatchWithHangingNodes)
{
  for (const Plane &plane : planes())
    {
      EquilibriumModel<3> model(patch_text(plane.normal, plane.opposite, coulomb, graded_text(1)));
      EXPECT_TRUE(model.cut.grid.triangulation().has_hanging_nodes());
      expect_uniform_pressure(model, plane.n_z);
    }
}

TEST(ReleaseThreeDimensionsMPI, PatchAndOrder)
{
  const Plane         plane = planes()[2];
  EquilibriumModel<3> patch(patch_text(plane.normal, plane.opposite, coulomb, graded_text(1)));
  expect_uniform_pressure(patch, plane.n_z);

  const std::string limit = "set Cell size limit = if(x > 0.1, 0.25, 0.5)\n";
  const std::string text  = grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", 1, graded_text(0, limit))
                           + bodies_text({{"body", ball()}}) + solver_text(1e-11);
  EquilibriumModel<3> together(text), alone(text, MPI_COMM_SELF);
  EXPECT_EQ(together.cut.space->n_dofs(), alone.cut.space->n_dofs());
  const double error = Manufactured<3>::solve(alone);
  EXPECT_NEAR(Manufactured<3>::solve(together), error, 1e-9 * error);
  EXPECT_NEAR(together.equilibrium.energies().strain, alone.equilibrium.energies().strain,
              1e-9 * alone.equilibrium.energies().strain);
}
} // namespace
} // namespace scree
