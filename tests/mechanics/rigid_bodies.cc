// Rigid bodies in contact: tangents, force control against displacement control, finite rotation,
// units, the iterative solver.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** The pose and load of the only rigid body. */
template <int dim>
RigidBodyState<dim>
rigid_state(const EquilibriumModel<dim> &model)
{
  return model.equilibrium.rigid_bodies()
    .states(model.equilibrium.with_ghosts(model.state.displacement))
    .front();
}

/** u with random entries, rigid rotations of about `angle`; zero where displacements are held. */
template <int dim>
Vector
random_state(const EquilibriumModel<dim> &model, const double size, const double angle,
             const unsigned int seed)
{
  const auto                            &space = *model.cut.space;
  Vector                                 u(space.owned(), MPI_COMM_WORLD);
  std::mt19937                           engine(seed);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (DofIndex index = 0; index < space.n_dofs(); ++index)
    {
      const double value = size * number(engine);
      if (space.owned().is_element(index))
        u(index) = value;
    }
  for (unsigned int b = 0; b < model.cut.bodies.size(); ++b)
    if (model.cut.bodies[b].is_rigid())
      for (unsigned int m = dim; m < n_rigid_components<dim>; ++m)
        {
          const DofIndex index = space.rigid_unknown(b) + m;
          if (space.owned().is_element(index))
            u(index) = u(index) + angle * model.cut.bodies[b].rigid->radius / (m - dim + 1.);
        }
  u.compress(VectorOperation::insert);
  model.equilibrium.set_prescribed(u);
  for (const auto &line : space.hanging_constraints().get_lines())
    if (space.owned().is_element(line.index))
      u(line.index) = 0.;
  u.compress(VectorOperation::insert);
  return u;
}

/** |dr + K v|/|K v| by central differences, at a state of `size` and rigid rotations of `angle`. */
template <int dim>
void
compare_tangent(const std::string &text, const double size, const double angle, const double step)
{
  EquilibriumModel<dim> model(text);
  auto                 &equilibrium = model.equilibrium;
  Vector u = random_state(model, size, angle, 2), r(u), plus(u), minus(u), product(u);
  equilibrium.set_time(1., u);
  equilibrium.residual(random_state(model, size, 0.9 * angle, 1), model.state.contact, r);
  const ContactHistory<dim> history = model.contact.current_history();
  for (const unsigned int seed : {3, 4})
    {
      const Vector v = random_state(model, 1., 1., seed);
      equilibrium.residual(u, history, r);
      equilibrium.tangent().vmult(product, v);
      // The artificial mass is no derivative.
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        {
          const DofIndex index = model.cut.space->rigid_unknown(1) + m;
          if (model.cut.space->owned().is_element(index))
            product(index)
              = product(index)
                - 1e-6 * equilibrium.rigid_bodies().stiffness_scales({1})[0] * v(index);
        }
      product.compress(VectorOperation::insert);
      Vector moved(u);
      moved.add(step, v);
      equilibrium.residual(moved, history, plus);
      moved.add(-2. * step, v);
      equilibrium.residual(moved, history, minus);
      plus -= minus;
      plus *= 0.5 / step;
      plus += product;
      std::cout << "  |dr + K v|/|K v| = " << plus.l2_norm() / product.l2_norm() << "\n";
      EXPECT_LE(plus.l2_norm(), 1e-7 * product.l2_norm());
    }
}

/** A block and a rigid disc that overlaps with it, all components free. */
std::string
block_and_rigid_disc(const std::string &law)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 2, graded_text(1)) + degree_text(2)
         + bodies_text(
           {{"block",
             half_space_text("0, 0.013", "0.05, 1") + conditions_text({{"base", "set On = y-"}})},
            {"disc", ball_text("0, 1.2", 1.2)
                       + motion_text("set Force x = 3\nset Force y = -20\nset Moment = 5")}})
         + contact_text(law);
}

/** The same in 3D. */
std::string
block_and_rigid_ball(const std::string &law)
{
  return grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 1) + degree_text(1)
         + bodies_text(
           {{"block", half_space_text("0, 0, 0.013", "0.05, 0.1, 1")
                        + conditions_text({{"base", "set On = z-"}})},
            {"ball",
             ball_text("0, 0, 1.1", 1.2)
               + motion_text("set Force x = 3\nset Force y = 2\nset Force z = -20\n"
                             "set Moment x = 500\nset Moment y = 200\nset Moment z = -300")}})
         + contact_text(law);
}

const char *const friction = "set Law = coulomb\nset Friction coefficient = 0.4";

TEST(RigidTangent, EqualsFiniteDifferences)
{
  // Steps that cross no change of state.
  for (const auto &[law, step] :
       {std::make_pair(friction, 1e-8), std::make_pair("set Law = frictionless", 1e-7)})
    {
      compare_tangent<2>(block_and_rigid_disc(law), 0.02, 0.01, step);
      compare_tangent<3>(block_and_rigid_ball(law), 0.02, 0.01, step);
    }
}

TEST(RigidTangent, EqualsFiniteDifferencesAtLargeRotations)
{
  for (const double angle : {0.5, 1.5})
    {
      compare_tangent<2>(block_and_rigid_disc("set Law = tied"), 0.02, angle, 1e-6);
      compare_tangent<3>(block_and_rigid_ball("set Law = tied"), 0.02, angle, 1e-6);
    }
}

TEST(RigidTangentMPI, EqualsFiniteDifferences)
{
  compare_tangent<2>(block_and_rigid_disc("set Law = tied"), 0.02, 0.5, 1e-6);
}

/** Section Solver for bodies that a force drives into contact. */
std::string
work_text(const double relative_tolerance, const std::string &linear_type = "direct")
{
  std::string       text = solver_text(relative_tolerance, linear_type);
  const std::string key  = " subsection Newton\n";
  return text.insert(text.find(key) + key.size(), "  set Line search = work\n");
}

/** A rigid cylinder (radius 10) on an elastic block; lengths, moduli and forces times a factor. */
std::string
cylinder_on_block(const std::string &motion, const std::string &law, const double length = 1.,
                  const std::string &more = work_text(1e-11))
{
  const auto number = [&](const double x) {
    std::ostringstream text;
    text.precision(17);
    text << x * length;
    return text.str();
  };
  std::string text
    = grid_text(number(-4) + ", " + number(-4), number(4) + ", " + number(2), "8, 6", 4,
                graded_text(0))
      + degree_text(1)
      + bodies_text(
        {{"block", half_space_text("0, 0", "0, 1") + conditions_text({{"base", "set On = y-"}})},
         {"cylinder",
          shape_text("disc", "set Centre = 0, " + number(10) + "\nset Radius = " + number(10))
            + motion_text(motion)}})
      + contact_text(law) + more;
  return text;
}

std::string
text_of(const double value)
{
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/** A formula with the values `first` at t = 1/2 and `second` at t = 1, linear in between. */
std::string
ramp(const double first, const double second)
{
  return text_of(first) + "*min(1, 2*t) + (" + text_of(second - first) + ")*max(0, 2*t - 1)";
}

/**
 * Presses the cylinder by a motion, then moves and turns it; applies reactions instead, and
 * compares. Either the moment or the force in x: with both given the cylinder could roll anywhere.
 */
void
compare_controls(const std::string &law, const bool turns)
{
  const std::string x        = "set Displacement x = " + ramp(0., 0.01) + "\n",
                    rotation = "set Rotation = " + ramp(0., -0.0004) + "\n";
  EquilibriumModel<2> by_motion(
    cylinder_on_block(x + rotation + "set Displacement y = " + ramp(-0.03, -0.04), law));
  std::vector<RigidBodyState<2>> prescribed;
  unsigned int                   of_motion = 0, of_force = 0;
  for (const double time : {0.5, 1.})
    {
      const auto result = by_motion.step(time);
      ASSERT_TRUE(result.converged()) << result.message;
      of_motion += result.iterations;
      prescribed.push_back(rigid_state(by_motion));
    }
  const auto &first = prescribed[0], &second = prescribed[1];
  EXPECT_NEAR(second.displacement[1], -0.04, 1e-15);
  EXPECT_LT(second.force[1], -1.);

  EquilibriumModel<2> by_force(cylinder_on_block(
    "set Force y = " + ramp(first.force[1], second.force[1]) + "\n"
      + (turns ? x + "set Moment = " + ramp(first.moment[2], second.moment[2])
               : rotation + "set Force x = " + ramp(first.force[0], second.force[0])),
    law));
  for (const double time : {0.5, 1.})
    {
      const auto result = by_force.step(time);
      ASSERT_TRUE(result.converged()) << result.message;
      of_force += result.iterations;
    }
  const auto   found = rigid_state(by_force);
  const double shift = (found.displacement - second.displacement).norm() / 0.04,
               turn  = (found.rotation - second.rotation).norm() / 0.0004,
               force = (found.force - second.force).norm() / second.force.norm();
  std::cout << "  iterations " << of_motion << " by motion, " << of_force
            << " by force; F = " << second.force << ", M = " << second.moment[2] << "; differences "
            << shift << ", " << turn << ", force " << force << "\n";
  EXPECT_LE(shift, 1e-8);
  EXPECT_LE(turn, 1e-8);
  EXPECT_LE(force, 1e-9);
}

TEST(ForceControl, ReproducesDisplacementControl)
{
  for (const std::string law : {friction, "set Law = stick"})
    for (const bool turns : {false, true})
      compare_controls(law, turns);
}

TEST(ForceControlMPI, ReproducesDisplacementControl)
{
  compare_controls(friction, false);
}

TEST(ForceControl, IterationsDoNotDependOnUnits)
{
  // The same in mm and MPa, and in m and MPa: forces per length are 1e3 times smaller.
  for (const std::string type : {"direct", "iterative"})
    {
      std::vector<std::array<unsigned int, 2>> iterations;
      std::vector<double>                      angles;
      for (const double length : {1., 1e-3})
        {
          const std::string   factor = text_of(length);
          EquilibriumModel<2> model(cylinder_on_block(
            "set Displacement x = " + factor + "*(" + ramp(0., 0.01) + ")\nset Force y = " + factor
              + "*(" + ramp(-20., -20.) + ")\nset Moment = 0",
            friction, length, work_text(1e-10, type)));
          iterations.push_back({{0, 0}});
          for (const double time : {0.5, 1.})
            {
              const auto result = model.step(time);
              ASSERT_TRUE(result.converged()) << result.message;
              iterations.back()[0] += result.iterations;
              iterations.back()[1] = model.linear_iterations;
            }
          angles.push_back(rigid_state(model).rotation[2]);
        }
      std::cout << "  " << type << ": iterations " << iterations[0][0] << ", " << iterations[1][0]
                << "; of the last system " << iterations[0][1] << ", " << iterations[1][1]
                << "; rotation " << angles[0] << "\n";
      EXPECT_EQ(iterations[0][0], iterations[1][0]);
      EXPECT_LE(std::abs(int(iterations[0][1]) - int(iterations[1][1])), 1);
      EXPECT_NEAR(angles[0], angles[1], 1e-7 * std::abs(angles[0]));
    }
}

/** A rigid ball (radius 4) on an elastic block. */
std::string
ball_on_block(const std::string &motion, const std::string &law, const std::string &type)
{
  return grid_text("-1, -1, -1", "1, 1, 0.25", "8, 8, 5", 1, graded_text(0)) + degree_text(1)
         + bodies_text({{"block", half_space_text("0, 0, 0", "0, 0, 1")
                                    + conditions_text({{"base", "set On = z-"}})},
                        {"ball", ball_text("0, 0, 4", 4.) + motion_text(motion)}})
         + contact_text(law) + work_text(1e-10, type);
}

TEST(ForceControl, BallIn3D)
{
  EquilibriumModel<3> by_motion(ball_on_block(
    "set Displacement z = -0.05*t\nset Displacement x = 0.01*t", friction, "iterative"));
  const auto          of_motion = by_motion.step(1.);
  ASSERT_TRUE(of_motion.converged()) << of_motion.message;
  const auto  prescribed = rigid_state(by_motion);
  std::string forces;
  for (unsigned int d = 0; d < 3; ++d)
    forces += std::string("set Force ") + "xyz"[d] + " = t*" + text_of(prescribed.force[d]) + "\n";
  for (const std::string type : {"iterative", "direct"})
    {
      EquilibriumModel<3> by_force(ball_on_block(forces, friction, type));
      const auto          of_force = by_force.step(1.);
      ASSERT_TRUE(of_force.converged()) << of_force.message;
      const auto found = rigid_state(by_force);
      std::cout << "  " << by_force.cut.space->n_dofs() << " unknowns, " << type
                << ": Newton iterations " << of_motion.iterations << " by motion, "
                << of_force.iterations << " by force; linear iterations "
                << by_motion.linear_iterations << ", " << by_force.linear_iterations
                << "; difference " << (found.displacement - prescribed.displacement).norm() / 0.05
                << "\n";
      EXPECT_LE((found.displacement - prescribed.displacement).norm(), 1e-8 * 0.05);
      EXPECT_LE(by_force.linear_iterations, 2 * by_motion.linear_iterations);
    }
}

TEST(FiniteRotation, GluedDiscTurnsARing)
{
  // A rigid disc of radius a is glued into an elastic ring that is held at radius b. It turns by
  // theta: the elastic field is u_r = A r + B/r, u_t = C r + D/r with the tractions of the glue,
  // eps (jump), at r = a.
  constexpr double    a = 0.5, b = 1., theta = numbers::PI / 6., E = 1000., nu = 0.3;
  EquilibriumModel<2> model(
    grid_text("-1.2, -1.2", "1.2, 1.2", "4, 4", 4) + degree_text(2)
    + bodies_text({{"ring", shape_text("ring", "set Centre = 0, 0\nset Inner radius = 0.5\n"
                                               "set Radius = 1")
                              + conditions_text({{"rim", "set Where = x*x + y*y > 0.6"}})},
                   {"disc", ball_text("0, 0", a) + motion_text("set Rotation = t*pi/6")}})
    + contact_text("set Law = tied") + solver_text(1e-10));
  const auto result = model.step(1.);
  ASSERT_TRUE(result.converged()) << result.message;
  const auto   found = rigid_state(model);
  const double mu = E / (2. * (1. + nu)), lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
  const double eps    = 10. * 2. * E / model.cut.grid.finest_size();
  const double radial = (std::cos(theta) - 1.) * a, tangential = std::sin(theta) * a;
  // u(r) = c (r - b^2/r); u(a) + t(a)/eps = motion of the disc, t the traction on the ring.
  const double g        = a - b * b / a;
  const double stress_r = 2. * (lambda + mu) + 2. * mu * b * b / (a * a); // per c
  const double stress_t = 2. * mu * b * b / (a * a);                      // per c
  const double c_r = radial / (g - stress_r / eps), c_t = tangential / (g - stress_t / eps);
  // Traction of the ring on the disc (sigma n, n = e_r), at the turned arm a (cos, sin).
  const double t_r = stress_r * c_r, t_t = stress_t * c_t;
  const double moment = -2. * numbers::PI * a * a * (std::cos(theta) * t_t - std::sin(theta) * t_r);
  std::cout << "  moment " << found.moment[2] << ", formula " << moment << "\n";
  EXPECT_NEAR(found.moment[2], moment, 2e-3 * std::abs(moment));
  EXPECT_LE(found.force.norm(), 1e-6 * std::abs(moment));
  const auto u     = model.equilibrium.at_points(model.state.displacement);
  double     error = 0.;
  for (unsigned int q = 0; q < 12; ++q)
    {
      const double   angle = 0.3 + q * numbers::PI / 6., r = 0.75;
      const Point<2> point(r * std::cos(angle), r * std::sin(angle));
      const int      cell   = model.cut.space->nearest_active_cell(point, 0);
      const auto     sample = model.bulk.sample(cell, model.cut.space->unit_point(cell, point), u);
      const double   u_r = c_r * (r - b * b / r), u_t = c_t * (r - b * b / r);
      const Tensor<1, 2> exact({u_r * std::cos(angle) - u_t * std::sin(angle),
                                u_r * std::sin(angle) + u_t * std::cos(angle)});
      error = std::max(error, (sample.displacement - exact).norm());
    }
  std::cout << "  largest error of u at r = 0.75: " << error << " of " << tangential << "\n";
  EXPECT_LE(error, 2e-3 * tangential);
}
} // namespace
} // namespace scree
