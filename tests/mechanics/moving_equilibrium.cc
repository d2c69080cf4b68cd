// The equilibrium of a step on a moving geometry: the fit of the displacement, the stresses and
// forces it leads to, and the tangent as the derivative of the residual.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/mechanics/boundary_coverage.h>
#include <scree/mechanics/material_update.h>

#include <iostream>
#include <random>

#include "started_step.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** A disc held by Nitsche's method on its left, under pressure on its right, on springs below. */
std::string
loaded_disc(const unsigned int degree, const std::string &more = "")
{
  return grid_text("-1.1, -1.1", "1.1, 1.1", "1, 1", 3, more) + degree_text(degree)
         + bodies_text(
           {{"disc",
             ball_text("0.01, 0.02", 0.9)
               + conditions_text(
                 {{"hold", "set On = surface\nset Where = x < -0.4\nset Value = 0.01*x; 0.02*y"},
                  {"press", "set Type = pressure\nset Where = x > 0.4\nset Value = 30*(1 + y)"},
                  {"bed", "set Type = springs\nset Where = y < -0.4\nset Value = 100; 200"}})}})
         + contact_text("set Law = frictionless");
}

/** Two bodies that overlap, with friction. */
std::string
pressed_bodies(const unsigned int degree, const std::string &more)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 2, more) + degree_text(degree)
         + bodies_text(
           {{"block",
             half_space_text("0, 0.013", "0.05, 1") + conditions_text({{"base", "set On = y-"}})},
            {"disc", ball_text("0, 1.2", 1.2) + conditions_text({{"top", "set On = y+"}})}})
         + contact_text("set Law = coulomb\nset Friction coefficient = 0.4");
}

Tensor<1, 2>
wavy(const Point<2> &x)
{
  return Tensor<1, 2>({0.05 * std::sin(2. * x[1]) + 0.1 * x[0], 0.04 * x[0] * x[1] - 0.03 * x[1]});
}

/** Largest |dr + K v| / |K v| for central differences of r along random directions. */
template <int dim>
double
tangent_error(StartedStep<dim> &step, const double size)
{
  auto                     &equilibrium = step.equilibrium;
  const ContactHistory<dim> history     = step.contact.initial_history();
  Vector                    u           = step.random(size, 1), r(u), plus(u), minus(u), product(u);
  equilibrium.set_time(0., r);
  equilibrium.residual(u, history, r);
  TrilinosWrappers::SparseMatrix tangent;
  tangent.copy_from(equilibrium.tangent());
  double largest = 0.;
  for (const unsigned int seed : {2u, 3u})
    {
      const double distance  = 1e-6;
      const Vector direction = step.random(1., seed);
      tangent.vmult(product, direction);
      Vector shifted = u;
      shifted.add(distance, direction);
      equilibrium.residual(shifted, history, plus);
      shifted.add(-2. * distance, direction);
      equilibrium.residual(shifted, history, minus);
      plus -= minus;
      plus.add(2. * distance, product);
      step.equilibrium.strong_supports().set_zero(plus);
      largest = std::max(largest, plus.l2_norm() / (2. * distance * product.l2_norm()));
    }
  return largest;
}
} // namespace

TEST(FitOfDisplacement, ReproducesPolynomialsOfTheDegree)
{
  for (const unsigned int degree : {1u, 2u})
    for (const std::string &refinement : {std::string(), graded_text(1)})
      {
        const Displacement<2> polynomial = [&](const Point<2> &x) {
          const double square = degree == 2 ? 0.07 * x[0] * x[0] - 0.03 * x[1] * x[1] : 0.;
          return Tensor<1, 2>(
            {0.1 + 0.3 * x[0] - 0.2 * x[1] + 0.05 * square, 0.4 * x[0] + 0.1 * x[1] - square});
        };
        StartedStep<2> step(loaded_disc(degree, refinement), "Hencky", polynomial);
        double         largest = 0., largest_gradient = 0.;
        for (std::size_t p = 0; p < step.points.size(); ++p)
          {
            const auto found = step.start.deformation(step.start.material_points()[p]);
            largest          = std::max(largest,
                                        (found.displacement - polynomial(step.points.position[p])).norm());
            // F = (I - grad u)^{-1} by differences of the polynomial, exact for degree 2
            Tensor<2, 2> inverse = Tensor<2, 2>(unit_symmetric_tensor<2>());
            for (unsigned int j = 0; j < 2; ++j)
              {
                Tensor<1, 2> offset;
                offset[j]        = 0.01;
                const auto slope = (polynomial(step.points.position[p] + offset)
                                    - polynomial(step.points.position[p] - offset))
                                   / 0.02;
                for (unsigned int i = 0; i < 2; ++i)
                  inverse[i][j] -= slope[i];
              }
            largest_gradient
              = std::max(largest_gradient, (found.gradient - invert(inverse)).norm());
          }
        std::cout << "degree " << degree << (refinement.empty() ? "" : ", graded")
                  << ": error of the fit " << largest << ", of F " << largest_gradient << std::endl;
        EXPECT_LT(largest, 1e-11);
        EXPECT_LT(largest_gradient, 1e-9);
      }
}

TEST(FitOfDisplacement, KeepsFieldsOfTheSpaceUpToTheirJumps)
{
  // A smooth field of the space, sampled at the points, comes back up to a small part of its jumps:
  // steps without load find the displacement that the step before left.
  for (const unsigned int degree : {1u, 2u})
    {
      StartedStep<2> plain(loaded_disc(degree), "Hencky",
                           [](const Point<2> &) { return Tensor<1, 2>(); });
      Vector         field = zero_displacement(*plain.cut.space);
      for (unsigned int a = 0; a < plain.cut.space->n_owned_cells(); ++a)
        {
          const auto &cell = plain.cut.grid.cells()[plain.cut.space->cells()[a].grid_cell];
          for (unsigned int i = 0; i < plain.cut.space->basis.n_nodes; ++i)
            {
              const auto value
                = wavy(cell.lower + cell.size * Tensor<1, 2>(plain.cut.space->basis.node(i)));
              for (unsigned int d = 0; d < 2; ++d)
                field(plain.cut.space->nodes(a)[i] + d) = value[d];
            }
        }
      field.compress(VectorOperation::insert);
      const auto ghosted = plain.equilibrium.at_points(field);
      auto       points  = plain.points;
      const auto cells   = locate_points(*plain.cut.space, plain.cut.bodies, points);
      for (std::size_t p = 0; p < points.size(); ++p)
        points.reference_position[p]
          -= plain.bulk.sample(cells[p].active_cell, cells[p].unit_point, ghosted).displacement;
      const Vector fit = fit_displacement(*plain.cut.space, plain.cut.bodies, points, cells);
      const auto   fit_ghosted = plain.equilibrium.at_points(fit);
      double       error = 0., norm = 0.;
      for (std::size_t p = 0; p < points.size(); ++p)
        {
          const auto &[cell, unit_point] = cells[p];
          const auto exact  = plain.bulk.sample(cell, unit_point, ghosted).displacement;
          const auto fitted = plain.bulk.sample(cell, unit_point, fit_ghosted).displacement;
          error += points.volume(p) * (fitted - exact).norm_square();
          norm += points.volume(p) * exact.norm_square();
        }
      std::cout << "degree " << degree << ": smooth field of the space, relative L2 error "
                << std::sqrt(error / norm) << std::endl;
      EXPECT_LT(std::sqrt(error / norm), degree == 1 ? 3e-3 : 5e-4);
    }
}

TEST(MovingEquilibrium, TangentIsDerivativeOfResidual)
{
  for (const std::string &law : increment_laws())
    for (const unsigned int degree : {1u, 2u})
      {
        StartedStep<2> disc(loaded_disc(degree), law, wavy);
        // Plastic laws have kinks at the yield surface: far beyond it.
        const double error = tangent_error(disc, is_plastic(law) ? 0.02 : 0.01);
        std::cout << law << ", degree " << degree << ": error of the tangent " << error
                  << std::endl;
        EXPECT_LT(error, 2e-7);
      }
}

TEST(MovingEquilibrium, TangentWithContactAndHangingNodes)
{
  for (const unsigned int degree : {1u, 2u})
    {
      StartedStep<2> step(pressed_bodies(degree, graded_text(1)), "neo-Hookean", wavy);
      const double   error = tangent_error(step, 0.005);
      std::cout << "degree " << degree << ": error of the tangent " << error << std::endl;
      EXPECT_LT(error, 1e-6);
    }
}

TEST(MovingEquilibrium, TangentInThreeDimensions)
{
  const std::string text
    = grid_text("-1.1, -1.1, -1.1", "1.1, 1.1, 1.1", "1, 1, 1", 2) + degree_text(1)
      + bodies_text(
        {{"ball",
          ball_text("0.01, 0.02, 0.03", 0.9)
            + conditions_text(
              {{"hold", "set On = surface\nset Where = x < -0.4\nset Value = 0.01*x; 0.02*y; 0"},
               {"press", "set Type = pressure\nset Where = x > 0.4\nset Value = 30*(1 + y)"}})}})
      + contact_text("set Law = frictionless");
  for (const std::string law : {"neo-Hookean", "J2"})
    {
      StartedStep<3> ball(text, law, [](const Point<3> &x) {
        return Tensor<1, 3>({0.1 * x[0] + 0.05 * x[1] * x[2], 0.05 * x[0], -0.04 * x[2]});
      });
      const double   error = tangent_error(ball, 0.02);
      std::cout << law << ": error of the tangent " << error << std::endl;
      EXPECT_LT(error, 2e-7);
    }
}

TEST(MovingEquilibrium, RotatedBodyIsFreeOfStress)
{
  const double          angle    = 0.7;
  const Displacement<2> rotation = [&](const Point<2> &x) {
    // x - R^T x
    return Tensor<1, 2>({x[0] - std::cos(angle) * x[0] - std::sin(angle) * x[1],
                         x[1] + std::sin(angle) * x[0] - std::cos(angle) * x[1]});
  };
  for (const std::string law : {"neo-Hookean", "Hencky", "Saint Venant-Kirchhoff", "J2"})
    {
      StartedStep<2> step(loaded_disc(2), law, rotation);
      const auto     zero    = step.equilibrium.at_points(zero_displacement(*step.cut.space));
      double         largest = 0.;
      for (const auto &point : step.start.material_points())
        largest = std::max(
          largest, step.bulk.sample(point.active_cell, point.unit_point, zero).stress.norm());
      std::cout << law << ": largest stress over E " << largest / 1000. << ", energy "
                << step.bulk.work(zero).energy << std::endl;
      EXPECT_LT(largest / 1000., 1e-9);
      EXPECT_LT(std::abs(step.bulk.work(zero).energy), 1e-9);
    }
}

TEST(MovingEquilibrium, PointsCarryTheProjectedVolume)
{
  // What flows has one change of volume in a cell of degree 1, though det(I + grad u) varies there.
  StartedStep<2> step(loaded_disc(1), "J2", [](const Point<2> &) { return Tensor<1, 2>(); });
  const auto     u     = step.equilibrium.at_points(step.random(0.01, 1));
  const auto    &cells = step.start.material_points();
  std::vector<PointHistory<2>> histories;
  for (std::size_t p = 0; p < step.points.size(); ++p)
    histories.push_back(step.start.history_of_material_point(p));
  const auto &bulk = dynamic_cast<const IncrementalBulk<2> &>(step.bulk);
  const auto after = moved_points<2>(step.points, cells, histories, step.cut.bodies, bulk, u, true);
  std::vector<double> ratio(step.cut.space->n_owned_cells(), 0.);
  double              scatter = 0., plain = 0.;
  for (std::size_t p = 0; p < after.size(); ++p)
    {
      const double found = determinant(after.deformation_gradient[p]);
      Tensor<2, 2> F_D   = u.evaluate(cells[p]).gradient;
      for (unsigned int d = 0; d < 2; ++d)
        F_D[d][d] += 1.;
      double &first = ratio[cells[p].active_cell];
      if (first == 0.)
        first = found;
      scatter = std::max(scatter, std::abs(found - first));
      plain   = std::max(plain, std::abs(determinant(F_D) - first));
    }
  std::cout << "det F scatters in the cells by " << scatter << ", det(I + grad u) by " << plain
            << std::endl;
  EXPECT_LT(scatter, 1e-12);
  EXPECT_GT(plain, 1e-3);
}

TEST(MovingEquilibrium, SecondAttemptTurnsInfinitesimally)
{
  StartedStep<2>  step(grid_text("-1.1, -1.1", "1.1, 1.1", "2, 2", 3) + degree_text(1)
                         + bodies_text({{"disc", ball_text("0.01, 0.02", 0.7)}}),
                       "neo-Hookean", [](const Point<2> &) { return Tensor<1, 2>(); });
  Equilibrium<2> &equilibrium = step.equilibrium;
  Vector          u           = zero_displacement(*step.cut.space), r(u);
  equilibrium.set_time(1., u);
  const auto                 history = step.contact.initial_history();
  FreeBodies<2>::Coordinates turn    = {0., 0., 0.1}; // the last one: times half the box
  const auto                 forces  = [&](const bool is_second) {
    Vector turned(u);
    equilibrium.free_motions().add(turn, turned, true);
    equilibrium.set_second_attempt(is_second);
    equilibrium.residual(turned, history, r);
    return r.linfty_norm();
  };
  // An infinitesimal turn stretches by half its square, but for the bulk of a second attempt.
  const double in_first = forces(false), in_second = forces(true);
  std::cout << "forces of an infinitesimal turn: " << in_first << ", in a second attempt "
            << in_second << std::endl;
  EXPECT_GT(in_first, 0.1);
  EXPECT_LT(in_second, 1e-9 * in_first);
  // It becomes a finite turn by as much.
  Vector turned(u), finite(u);
  equilibrium.free_motions().add(turn, turned, true);
  equilibrium.turn(turned);
  equilibrium.free_motions().add(turn, finite);
  finite -= turned;
  EXPECT_LT(finite.linfty_norm(), 1e-12);
}

TEST(MovingEquilibrium, MaterialInsideOutIsTold)
{
  const auto mirrored = [](const Point<2> &x) { return Tensor<1, 2>({2. * x[0], 0.}); };
  try
    {
      StartedStep<2> step(loaded_disc(1), "Hencky", mirrored);
      FAIL() << "no error";
    }
  catch (const UserError &error)
    {
      EXPECT_NE(std::string(error.what()).find("Bodies/disc: its displacement"), std::string::npos)
        << error.what();
      EXPECT_NE(std::string(error.what()).find("det F = -1"), std::string::npos) << error.what();
    }
}

TEST(MovingEquilibrium, FormulasSeeReferencePositions)
{
  // The disc was moved by 0.3 to the right: its region x < -0.4 is now x < -0.1.
  StartedStep<2> step(loaded_disc(1), "Hencky", [](const Point<2> &) {
    return Tensor<1, 2>({0.3, 0.});
  });
  double         largest = -10., smallest_pressed = 10.;
  for (const auto &region : step.boundary_terms.regions())
    for (const auto &point : region.points)
      {
        if (region.condition->name == "hold")
          largest = std::max(largest, point.position[0]);
        if (region.condition->name == "press")
          smallest_pressed = std::min(smallest_pressed, point.position[0]);
        EXPECT_NEAR(point.area_ratio, 1., 1e-9);
        EXPECT_NEAR(point.start_displacement[0], 0.3, 1e-10);
      }
  EXPECT_NEAR(largest, -0.1, 0.2);
  EXPECT_LT(largest, -0.1);
  EXPECT_NEAR(smallest_pressed, 0.7, 0.2);
  EXPECT_GT(smallest_pressed, 0.7);
}

namespace
{
/**
 * A surface held in three regions, moved by 0.04 over cells of 1/2: of region r the cell i along x
 * is covered by covers[r][i].
 */
constexpr double covers[3][4] = {{0.72, 1., 1., 0.28}, {0., 0., 0., 0.4}, {0., 0., 0.24, 0.32}};

template <int dim>
void
check_edges_of_regions()
{
  const std::string hold = "set On = surface\nset Where = ";
  const std::string text
    = (dim == 2 ? grid_text("-1, -0.5", "1, 0.5", "4, 2", 0)
                : grid_text("-1, -0.5, -0.5", "1, 0.5, 0.5", "4, 2, 2", 0))
      + degree_text(1)
      + bodies_text({{"a", (dim == 2 ? half_space_text("0, 0.03", "0, 1")
                                     : half_space_text("0, 0, 0.03", "0, 0, 1"))
                             + conditions_text({{"wide", hold + "(x > -0.9) && (x < 0.6)"},
                                                {"narrow", hold + "(x > 0.54) && (x < 0.74)"},
                                                {"astride", hold + "(x > 0.34) && (x < 0.62)"}})}})
      + contact_text("set Law = frictionless");
  const auto moved = [](const Point<dim> &) { return 0.04 * Point<dim>::unit_vector(0); };
  const StartedStep<dim> elastic(text, "J2 small strain", moved);
  const StartedStep<dim> flows(text, "J2 small strain", moved, 0.05);
  for (unsigned int r = 0; r < 3; ++r)
    {
      const auto         &region = elastic.boundary_terms.regions()[r];
      std::vector<double> covered(elastic.cut.space->n_owned_cells(), 0.);
      set_coverage(*elastic.cut.space, *elastic.cut.level_set_nodes, elastic.cut.bodies[0], region,
                   elastic.kinematics, covered);
      const auto is_outer = outer_edge(*elastic.cut.space, covered);
      const auto along    = [&](const unsigned int a) {
        return std::lround(
             2. * (elastic.cut.grid.cells()[elastic.cut.space->cells()[a].grid_cell].lower[0] + 1.));
      };
      for (const auto &point : region.points)
        {
          const unsigned int a = point.active_cell;
          EXPECT_NEAR(covered[a], covers[r][along(a)], dim == 2 ? 2e-3 : 0.04);
          EXPECT_EQ(is_outer[a], r == 0 && along(a) == 3) << "region " << r << ", " << along(a);
        }
      // What flows is free there and only there.
      std::size_t n_free = 0;
      for (const auto &point : region.points)
        n_free += is_outer[point.active_cell];
      const auto &left = flows.boundary_terms.regions()[r].points;
      EXPECT_EQ(left.size() + n_free, region.points.size());
      for (const auto &point : left)
        EXPECT_FALSE(is_outer[point.active_cell]);
      n_free = Utilities::MPI::sum(n_free, MPI_COMM_WORLD);
      EXPECT_EQ(n_free > 0, r == 0);
    }
}
} // namespace

TEST(EdgesOfRegionsMPI, InTwoDimensions)
{
  check_edges_of_regions<2>();
}

TEST(EdgesOfRegionsMPI, InThreeDimensions)
{
  check_edges_of_regions<3>();
}
} // namespace scree
