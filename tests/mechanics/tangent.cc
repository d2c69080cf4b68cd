// The tangent of the equilibrium is the derivative of its residual; Newton converges quadratically.
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

const char *const friction = "set Law = coulomb\nset Friction coefficient = 0.4";

/** A half space held below and a disc held above that overlaps with it. */
std::string
overlapping_bodies(const unsigned int degree, const std::string &refinement,
                   const std::string &law = friction, const std::string &surface = "level sets")
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3, refinement) + degree_text(degree)
         + bodies_text(
           {{"block",
             half_space_text("0, 0.013", "0.05, 1") + conditions_text({{"base", "set On = y-"}})},
            {"disc", ball_text("0, 1.2", 1.2) + conditions_text({{"top", "set On = y+"}})}})
         + contact_text(law, surface);
}

/** u with random entries that satisfies the constraints; zero where displacements are held. */
template <int dim>
Vector
random_displacement(const EquilibriumModel<dim> &model, const double size, const unsigned int seed)
{
  Vector                                 u(model.cut.space->owned(), MPI_COMM_WORLD);
  std::mt19937                           engine(seed);
  std::uniform_real_distribution<double> number(-size, size);
  for (const DofIndex index : model.cut.space->owned())
    u(index) = number(engine);
  u.compress(VectorOperation::insert);
  model.equilibrium.strong_supports().set_zero(u);
  for (const auto &line : model.cut.space->hanging_constraints().get_lines())
    if (model.cut.space->owned().is_element(line.index))
      u(line.index) = 0.;
  u.compress(VectorOperation::insert);
  return u;
}

/** Open, sticking and slipping points of the last evaluation. */
template <int dim>
std::vector<ContactStatus>
states(const EquilibriumModel<dim> &model)
{
  std::vector<ContactStatus> result;
  for (const auto &response : model.contact.responses())
    result.push_back(response.status);
  return result;
}

/** |dr + K v| / |K v| for central differences of r along random directions. */
template <int dim>
void
compare_tangent(EquilibriumModel<dim> &model, const double size, const double step)
{
  auto        &equilibrium = model.equilibrium;
  const Vector start       = random_displacement(model, size, 1);
  Vector       u = random_displacement(model, size, 2), r(u), plus(u), minus(u), product(u);
  // A history with tractions: that of a first random state.
  equilibrium.set_time(0., u);
  equilibrium.residual(start, model.state.contact, r);
  const ContactHistory<dim> history = model.contact.current_history();

  equilibrium.residual(u, history, r);
  const auto before = states(model);
  for (const ContactStatus status :
       {ContactStatus::open, ContactStatus::stick, ContactStatus::slip})
    EXPECT_GE(std::count(before.begin(), before.end(), status), 4)
      << name_of(contact_status_names, status);
  auto &tangent = equilibrium.tangent();
  for (const unsigned int seed : {3, 4, 5})
    {
      const Vector v = random_displacement(model, 1., seed);
      tangent.vmult(product, v);
      Vector moved(u);
      moved.add(step, v);
      equilibrium.residual(moved, history, plus);
      const auto after = states(model);
      moved.add(-2. * step, v);
      equilibrium.residual(moved, history, minus);
      // Central differences mean nothing across a change of state.
      EXPECT_EQ(before, after);
      EXPECT_EQ(before, states(model));
      plus -= minus;
      plus *= 0.5 / step;
      plus += product;
      EXPECT_LE(plus.l2_norm(), 1e-6 * product.l2_norm());
      std::cout << "  |dr + K v|/|K v| = " << plus.l2_norm() / product.l2_norm() << "\n";
    }
}

TEST(Tangent, EqualsFiniteDifferences2D)
{
  for (const unsigned int degree : {1, 2})
    for (const std::string &refinement : {std::string(), graded_text(1)})
      {
        EquilibriumModel<2> model(overlapping_bodies(degree, refinement));
        EXPECT_EQ(model.cut.grid.triangulation().has_hanging_nodes(), !refinement.empty());
        compare_tangent(model, 0.02, 1e-8);
      }
}

std::string
overlapping_bodies_3d(const unsigned int degree, const std::string &surface = "level sets")
{
  return grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 1) + degree_text(degree)
         + bodies_text({{"block", half_space_text("0, 0, 0.013", "0.05, 0.1, 1")
                                    + conditions_text({{"base", "set On = z-"}})},
                        {"cap", half_space_text("0, 0, -0.007", "0.1, 0.05, -1")
                                  + conditions_text({{"top", "set On = z+"}})}})
         + contact_text(friction, surface);
}

TEST(Tangent, EqualsFiniteDifferences3D)
{
  for (const unsigned int degree : {1, 2})
    {
      EquilibriumModel<3> model(overlapping_bodies_3d(degree));
      compare_tangent(model, 0.05, 1e-7);
    }
}

TEST(Tangent, EqualsFiniteDifferencesAtGridNodes)
{
  for (const std::string &refinement : {std::string(), graded_text(1)})
    {
      EquilibriumModel<2> model(overlapping_bodies(1, refinement, friction, "grid nodes"));
      compare_tangent(model, 0.02, 1e-8);
    }
  EquilibriumModel<3> model(overlapping_bodies_3d(1, "grid nodes"));
  compare_tangent(model, 0.05, 1e-7);
}

/** The same from a state without history. */
void
compare_unloaded_tangent(const std::string &law)
{
  EquilibriumModel<2> model(overlapping_bodies(2, graded_text(1), law));
  Vector              u = random_displacement(model, 0.02, 2), r(u), plus(u), minus(u), product(u);
  const Vector        v = random_displacement(model, 1e-8, 3);
  model.equilibrium.set_time(0., u);
  model.equilibrium.residual(u, model.state.contact, r);
  model.equilibrium.tangent().vmult(product, v);
  Vector moved(u);
  moved += v;
  model.equilibrium.residual(moved, model.state.contact, plus);
  moved.add(-2., v);
  model.equilibrium.residual(moved, model.state.contact, minus);
  plus -= minus;
  plus *= 0.5;
  plus += product;
  EXPECT_LE(plus.l2_norm(), 1e-6 * product.l2_norm()) << law;
}

TEST(Tangent, EqualsFiniteDifferencesOfOtherLaws)
{
  for (const std::string law : {"set Law = frictionless", "set Law = stick", "set Law = tied"})
    compare_unloaded_tangent(law);
}

TEST(TangentMPI, EqualsFiniteDifferences)
{
  compare_unloaded_tangent(friction);
}

/** Prints the residuals and checks that the last ones fall quadratically. */
void
check_last_phase(const NewtonResult &result, const double force, const double factor)
{
  ASSERT_TRUE(result.converged()) << result.message;
  const auto &r = result.residuals;
  std::cout << "  residuals:";
  for (const double residual : r)
    std::cout << " " << residual;
  std::cout << "\n";
  // |r_k| <= factor |r_(k-1)|^2 / force in the last iteration that starts above round-off.
  unsigned int k = r.size() - 1;
  while (k > 1 && r[k - 1] < 1e-9 * force)
    --k;
  EXPECT_LE(r[k], factor * r[k - 1] * r[k - 1] / force + 1e-11 * force);
  EXPECT_LE(r[k], 1e-3 * r[k - 1]);
}

TEST(NewtonOnContact, HertzEndsQuadratically)
{
  for (const unsigned int degree : {1, 2})
    {
      EquilibriumModel<2> model(
        grid_text("-10, -4", "10, 4", "20, 8", 2, graded_text(0)) + degree_text(degree)
        + bodies_text(
          {{"block", half_space_text("0, 0", "0, 1") + conditions_text({{"base", "set On = y-"}})},
           {"cylinder",
            ball_text("0, 10", 10.)
              + conditions_text({{"top", "set On = y+\nset Value = 0.02*t; -0.04*t"}})}})
        + contact_text(friction) + solver_text(1e-12));
      const auto result = model.step(1.);
      EXPECT_LE(result.iterations, 25u);
      check_last_phase(result, model.equilibrium.force_scale(), 10.);
    }
}

TEST(NewtonOnContact, FrictionIn3DEndsQuadratically)
{
  // The direction of slip turns: the law is curved.
  EquilibriumModel<3> model(
    grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 1) + degree_text(1)
    + bodies_text(
      {{"block",
        half_space_text("0, 0, 0", "0, 0, 1") + conditions_text({{"base", "set On = z-"}})},
       {"cap", half_space_text("0, 0, 0", "0, 0, -1")
                 + conditions_text(
                   {{"top", "set On = z+\nset Value = -0.05*y*t + 0.01*t; 0.08*x*t; -0.02*t"}})}})
    + contact_text("set Law = coulomb\nset Friction coefficient = 0.3") + solver_text(1e-12));
  const auto result = model.step(1.);
  const auto after  = states(model);
  EXPECT_GT(std::count(after.begin(), after.end(), ContactStatus::slip), 10);
  check_last_phase(result, model.equilibrium.force_scale(), 100.);
}
} // namespace
} // namespace scree
