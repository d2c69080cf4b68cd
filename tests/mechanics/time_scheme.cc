// The schemes as formulas, and as what enters the equations.
#include <gtest/gtest.h>

#include <scree/mechanics/one_step_scheme.h>
#include <scree/mechanics/quasi_static.h>
#include <scree/mechanics/velocity_field.h>

#include <functional>

#include "equilibrium_model.h"

using namespace scree;
using namespace dealii;

namespace
{
/** |error| at t = 2 of u'' = -u - 3 u^3, u = 1 and u' = 0 at 0, with n steps. */
double
oscillator_error(const std::function<StepFormula(double)> &formula, const unsigned int n,
                 const double exact)
{
  const double dt    = 2. / n;
  const auto   force = [](const double u) { return -u - 3. * u * u * u; };
  double       u = 1., v = 0., a = force(u);
  const auto   of_step = formula(dt);
  for (unsigned int i = 0; i < n; ++i)
    {
      double d = dt * v;
      for (unsigned int k = 0; k < 20; ++k) // r(u + d) + share r(u) - a*(d) = 0
        {
          const double r
            = force(u + d) + of_step.initial_share * force(u) - of_step.balance(d, v, a);
          d += r / (of_step.balance.motion + 1. + 9. * (u + d) * (u + d));
        }
      const double v_n = v;
      v                = of_step.velocity(d, v_n, a);
      a                = of_step.acceleration(d, v_n, a);
      u += d;
    }
  return std::abs(u - exact);
}

constexpr double density = 3.;

/** Section Materials with density instead of that of bodies_text(). */
std::string
with_density(std::string text)
{
  for (const std::string line : {"  set Poisson's ratio = 0.3\n", "  set Law = rigid\n"})
    text.insert(text.find(line), "  set Density = 3\n");
  return text;
}

/** A body that nothing holds, with its mass and state. */
template <int dim>
struct FreeBody
{
  using Vector = TrilinosWrappers::MPI::Vector;

  explicit FreeBody(const std::string &lines)
      : model(grid_text(dim == 2 ? "-1, -1" : "-1, -1, -1", dim == 2 ? "1, 1" : "1, 1, 1",
                        dim == 2 ? "4, 4" : "4, 4, 4", 1)
                + degree_text(1) + with_density(bodies_text({{"body", lines}})),
              MPI_COMM_WORLD, true)
      , mass(model.mass)
      , equilibrium(model.equilibrium)
  {
    State<dim> &state  = model.state;
    auto       &rates  = state.predictor.rates;
    rates.velocity     = mass->fit(mass->initial_velocities());
    rates.acceleration = rates.velocity;
    rates.acceleration = 0.;
    mass->set_initial_motion(rates);
    equilibrium.set_kinetic_energy(mass->kinetic_energy(state.displacement, rates));
    equilibrium.start_motion(0., state.displacement, state.contact);
    rates.forces = equilibrium.forces_without_inertia();
    mass->set_accelerations(state.displacement, rates.forces, nullptr, rates);
  }

  /** A step by Newton's method; the state is taken over. */
  void step(const TimeScheme<dim> &scheme, const double time)
  {
    State<dim> &state = model.state;
    Vector      u     = *scheme.predicted(model.kinematics, state, time), r(u), du(u);
    equilibrium.set_time(time, u);
    equilibrium.set_inertia(scheme.inertia(mass, state, time));
    for (unsigned int i = 0; i < 6; ++i)
      {
        equilibrium.residual(u, state.contact, r);
        model.linear_solver.solve(equilibrium.tangent(), du, r, equilibrium.is_symmetric());
        u += du;
      }
    equilibrium.residual(u, state.contact, r);
    EXPECT_LT(r.l2_norm(), 1e-11 * equilibrium.force_scale() + 1e2 * equilibrium.round_off());
    Rates rates  = scheme.rates(mass.get(), state, u, equilibrium.accelerations_by_contact(u),
                                {turns_freely}, time);
    rates.forces = equilibrium.forces_without_inertia();
    equilibrium.set_kinetic_energy(mass->kinetic_energy(u, rates));
    equilibrium.accept(u, state.contact);
    state.predictor.rates = rates;
    state.displacement    = u;
    state.time            = time;
  }

  Momentum<dim> momentum() const
  {
    const auto &rates = model.state.predictor.rates;
    const auto  v     = mass->at_points(rates.velocity);
    return mass->momenta(model.state.displacement, rates, typename Mass<dim>::Vectors(v.size()), v)
      .front();
  }

  EquilibriumModel<dim>                   model;
  const std::shared_ptr<const Mass<dim>> &mass;
  Equilibrium<dim>                       &equilibrium;
  bool                                    turns_freely = false;
};

std::function<StepFormula(double)>
trapezoidal()
{
  return [](const double dt) { return newmark(dt, 0.25, 0.5); };
}
} // namespace

TEST(TimeScheme, Orders)
{
  const double exact = [&]() { // by Verlet's method
    double       u = 1., v = 0.;
    const auto   force = [](const double x) { return -x - 3. * x * x * x; };
    const double dt    = 2. / 200000;
    for (unsigned int i = 0; i < 200000; ++i)
      {
        v += 0.5 * dt * force(u);
        u += dt * v;
        v += 0.5 * dt * force(u);
      }
    return u;
  }();
  struct Expected
  {
    std::function<StepFormula(double)> formula;
    double                             order;
  };
  for (const auto &[formula, order] :
       {Expected{trapezoidal(), 2.}, Expected{backward_euler, 1.},
        Expected{[](const double dt) { return newmark(dt, 0.3, 0.6); }, 1.},
        Expected{[](const double dt) { return generalized_alpha(dt, 0.8); }, 2.},
        Expected{[](const double dt) { return generalized_alpha(dt, 0.); }, 2.}})
    {
      const double coarse = oscillator_error(formula, 400, exact);
      const double fine   = oscillator_error(formula, 800, exact);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.06);
      EXPECT_LT(fine, order == 2. ? 1e-4 : 5e-2);
    }
}

// Of u'' = -w^2 u, in a step from the exact u and v, and a_n where the scheme has it.
TEST(TimeScheme, LocalErrors)
{
  constexpr double w = 3., dt = 1e-3, rho = 0.6;
  const double     theta = (2. * rho - 1.) / (rho + 1.) - rho / (rho + 1.);
  struct Case
  {
    StepFormula of_step;
    double      shift; // of a_n, in steps
  };
  for (const auto &[of_step, shift] :
       {Case{newmark(dt, 0.25, 0.5), 0.}, Case{newmark(dt, 0.4, 0.5), 0.},
        Case{backward_euler(dt), 0.}, Case{generalized_alpha(dt, rho), theta}})
    {
      const double t = 0.7, u = std::cos(w * t), v = -w * std::sin(w * t),
                   a = -w * w * std::cos(w * (t + shift * dt));
      // a*(d) + w^2 (u + d + share u) = 0, linear in d.
      const double d = -(of_step.balance(0., v, a) + w * w * (1. + of_step.initial_share) * u)
                       / (of_step.balance.motion + w * w);
      const double error   = u + d - std::cos(w * (t + dt));
      const auto  &formula = of_step.local_error;
      const double estimated
        = formula.at_end * of_step.acceleration(d, v, a) + formula.at_start * a;
      EXPECT_NEAR(estimated, error, 0.02 * std::abs(error));
    }
  // gamma > 1/2: the velocity is of the first order.
  EXPECT_DOUBLE_EQ(newmark(dt, 0.5, 0.95).local_error.at_end, 0.45 * dt * dt);
}

TEST(TimeScheme, QuasiStaticHasNoInertia)
{
  EquilibriumModel<2>  model(grid_text("-1, -1", "1, 1", "4, 4", 1) + degree_text(1)
                             + bodies_text({{"disc", ball_text("0.02, 0.01", 0.63)}}));
  const QuasiStatic<2> scheme;
  auto                 u = model.state.displacement;
  EXPECT_FALSE(scheme.predicted(model.kinematics, model.state, 0.1).has_value());
  EXPECT_EQ(scheme.inertia(nullptr, model.state, 0.1).mass, nullptr);
  for (const DofIndex index : model.cut.space->owned())
    u(index) = 1e-3 * (index % 7);
  u.compress(VectorOperation::insert);
  const Rates rates = scheme.rates(nullptr, model.state, u, u, {}, 0.1);
  EXPECT_EQ(rates.acceleration.size(), 0u);
  EXPECT_NEAR(rates.velocity.linfty_norm(), 10. * u.linfty_norm(), 1e-15);
}

// A free body falls with b/rho everywhere, without strain; its energies and momenta say so.
TEST(Inertia, FreeFall)
{
  FreeBody<2>            body(ball_text("0.02, 0.01", 0.63)
                              + "  set Body force = 6; -12\n  set Initial velocity = 1; 2\n");
  const OneStepScheme<2> scheme(trapezoidal());
  const double           m = density * numbers::PI * 0.63 * 0.63;
  const Tensor<1, 2>     a({2., -4.});
  Tensor<1, 2>           v({1., 2.}), u;
  EXPECT_NEAR(body.momentum().linear[0], m, 2e-3 * m);
  const double exact_mass = body.momentum().linear[0];
  double       time       = 0.;
  for (const double dt : {0.1, 0.05, 0.2})
    {
      time += dt;
      body.step(scheme, time);
      u += dt * v + 0.5 * dt * dt * a;
      v += dt * a;
      const auto &rates = body.model.state.predictor.rates;
      for (unsigned int cell = 0; cell < body.model.cut.space->n_owned_cells(); ++cell)
        for (unsigned int d = 0; d < 2; ++d)
          {
            const DofIndex index = body.model.cut.space->nodes(cell)[0] + d;
            EXPECT_NEAR(body.model.state.displacement(index), u[d], 1e-9);
            EXPECT_NEAR(rates.velocity(index), v[d], 1e-8);
            EXPECT_NEAR(rates.acceleration(index), a[d], 1e-7);
          }
      EXPECT_NEAR((body.momentum().linear - exact_mass * v).norm(), 0., 1e-9 * m);
    }
  const Energies &energies = body.equilibrium.energies();
  EXPECT_NEAR(energies.kinetic, 0.5 * exact_mass * v.norm_square(), 1e-9 * energies.kinetic);
  EXPECT_NEAR(energies.balance_error(), 0., 1e-9 * energies.kinetic);
  const auto balance = body.equilibrium.balance(body.model.state.displacement);
  ASSERT_EQ(balance.size(), 1u);
  EXPECT_LT(balance[0].force.norm(), 1e-9 * m);
}

// What points carry keeps its momenta as a field: fit() has no loss for linear test functions.
TEST(Inertia, FitsKeepMomentum)
{
  FreeBody<2>      body(ball_text("0.02, 0.01", 0.63));
  const auto      &points = body.mass->points();
  Mass<2>::Vectors values;
  Tensor<1, 2>     momentum;
  double           angular = 0.;
  for (std::size_t p = 0; p < points.masses.size(); ++p)
    {
      const auto &x = points.positions[p];
      values.push_back(Tensor<1, 2>({std::sin(7. * x[0] + 3. * x[1]), std::cos(9. * x[1])}));
      momentum += points.masses[p] * values[p];
      angular += points.masses[p] * (x[0] * values[p][1] - x[1] * values[p][0]);
    }
  auto &rates    = body.model.state.predictor.rates;
  rates.velocity = body.mass->fit(values);
  EXPECT_NEAR((body.momentum().linear - momentum).norm(), 0., 1e-12);
  EXPECT_NEAR(body.momentum().angular[2], angular, 1e-12);
}

// The jumps weigh in proportion to their share, and nothing in the motion of a rigid body.
TEST(Inertia, ShareOfJumps)
{
  const FreeBody<2> body(ball_text("0.02, 0.01", 0.63));
  const auto       &model = body.model;
  const auto       &space = *model.cut.space;
  auto              rough = body.model.state.displacement, rigid = rough, weighted = rough;
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      {
        const auto     x    = space.position(a, space.basis.node(i));
        const DofIndex node = space.nodes(a)[i];
        rough(node)         = std::sin(7. * x[0] + 3. * x[1]);
        rigid(node)         = 0.3 - 0.2 * x[1];
        rigid(node + 1)     = 0.1 + 0.2 * x[0];
      }
  const auto norm_square = [&](const double share, const auto &v) {
    const Mass<2> mass(space, model.cut.bodies, *model.small_cuts, model.kinematics.mass_points(),
                       share);
    mass.matrix()->vmult(weighted, v);
    return weighted * v;
  };
  const double of_points = norm_square(0., rough), whole = norm_square(1., rough);
  EXPECT_GT(whole, 1.01 * of_points);
  EXPECT_NEAR(norm_square(0.1, rough), of_points + 0.1 * (whole - of_points), 1e-12 * whole);
  const double exact = norm_square(0., rigid);
  EXPECT_NEAR(norm_square(1., rigid), exact, 1e-12 * exact);
}

// Lumping keeps the mass, and the momenta of nodes are those of the points.
TEST(Inertia, LumpedMass)
{
  const FreeBody<2> body(ball_text("0.02, 0.01", 0.63));
  const auto       &model = body.model;
  const auto       &space = *model.cut.space;
  const Mass<2> lumped(space, model.cut.bodies, *model.small_cuts, model.kinematics.mass_points(),
                       1., true);
  const auto   &points = lumped.points();
  Mass<2>::Vectors values;
  double           mass = 0., angular = 0.;
  Tensor<1, 2>     momentum;
  for (std::size_t p = 0; p < points.masses.size(); ++p)
    {
      const auto &x = points.positions[p];
      values.push_back(Tensor<1, 2>({std::sin(7. * x[0] + 3. * x[1]), std::cos(9. * x[1])}));
      mass += points.masses[p];
      momentum += points.masses[p] * values[p];
      angular += points.masses[p] * (x[0] * values[p][1] - x[1] * values[p][0]);
    }
  const auto v = lumped.fit(values);
  auto       m = v, mv = v, ones = v;
  ones = 1.;
  lumped.matrix()->vmult(m, ones);
  lumped.matrix()->vmult(mv, v);
  EXPECT_NEAR(m.l1_norm(), 2. * mass, 1e-12);
  EXPECT_LE(m.l1_norm(), m.mean_value() * m.size() * (1. + 1e-12)); // none is negative
  std::vector<bool> is_counted(space.n_dofs());
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      if (const DofIndex node = space.nodes(a)[i]; !is_counted[node])
        {
          const auto x     = space.position(a, space.basis.node(i));
          is_counted[node] = true;
          angular -= x[0] * mv(node + 1) - x[1] * mv(node);
          momentum -= Tensor<1, 2>({mv(node), mv(node + 1)});
          EXPECT_NEAR(m(node), lumped.matrix()->diag_element(node), 1e-15);
        }
  EXPECT_NEAR(momentum.norm(), 0., 1e-12);
  EXPECT_NEAR(angular, 0., 1e-12);
}

// v + w x (x - c), of deformable bodies and of rigid ones alike.
TEST(Inertia, VelocityFieldOfSpinningBodies)
{
  const std::string motion = motion_text("set Reference point = 0.1, 0.2\nset Force x = 0\n"
                                         "set Force y = 0\nset Moment = 0");
  for (const std::string &of_rigid : {std::string(), motion})
    {
      FreeBody<2>            body(ball_text("0.02, 0.01", 0.63)
                                  + "  set Initial velocity = 3; -2\n  set Initial spin = 5\n" + of_rigid);
      const VelocityField<2> velocity(*body.mass, body.model.state.displacement,
                                      body.model.state.predictor.rates.velocity);
      const Point<2>         x(0.3, -0.1);
      Tensor<1, 2>           found = velocity.value(0, x);
      if (of_rigid.empty())
        {
          EXPECT_EQ(found.norm(), 0.);
          const auto &space = *body.model.cut.space;
          const int   cell  = space.nearest_active_cell(x, 0);
          ASSERT_GE(cell, 0);
          found = velocity.value(PointInCell<2>{unsigned(cell), space.unit_point(cell, x)});
        }
      // about the centroid
      EXPECT_NEAR(found[0], 3. - 5. * (x[1] - 0.01), 1e-2);
      EXPECT_NEAR(found[1], -2. + 5. * (x[0] - 0.02), 1e-2);
    }
}

// The tangent is the derivative of the residual, turned rigid bodies in 3D included.
TEST(Inertia, TangentOfRigidBodies)
{
  FreeBody<3> body("  subsection Shape\n   set Type = box\n   set Lower corner = -0.5, -0.4, -0.2\n"
                   "   set Upper corner = 0.5, 0.4, 0.2\n  end\n  set Initial velocity = 1; 2; 3\n"
                   "  set Initial spin = 2, 3, -1\n"
                   + motion_text("set Reference point = 0.1, 0, 0.3\nset Force x = 0\n"
                                 "set Force y = 0\nset Force z = 0\nset Moment x = 0\n"
                                 "set Moment y = 0\nset Moment z = 0"));
  const OneStepScheme<3> scheme([](const double dt) { return generalized_alpha(dt, 0.5); });
  auto                  &state = body.model.state;
  auto                   u = state.displacement, r = u, plus = u, minus = u, column = u, unit = u;
  body.equilibrium.set_inertia(scheme.inertia(body.mass, state, 0.3));
  for (const DofIndex index : body.model.cut.space->owned())
    u(index) = 0.1 * (1. + index % 5);
  u.compress(VectorOperation::insert);
  body.equilibrium.residual(u, state.contact, r);
  TrilinosWrappers::SparseMatrix K;
  K.copy_from(body.equilibrium.tangent());
  for (unsigned int m = 0; m < 6; ++m)
    {
      constexpr double step                            = 1e-6;
      unit                                             = 0.;
      unit(body.model.cut.space->rigid_unknown(0) + m) = 1.;
      unit.compress(VectorOperation::insert);
      K.vmult(column, unit);
      auto shifted = u;
      shifted.add(step, unit);
      body.equilibrium.residual(shifted, state.contact, minus);
      shifted.add(-2. * step, unit);
      body.equilibrium.residual(shifted, state.contact, plus);
      plus -= minus;
      plus *= 0.5 / step;
      plus -= column;
      EXPECT_LT(plus.linfty_norm(), 1e-7 * column.linfty_norm());
    }
}

namespace
{
/** A block in free flight that turns about no principal axis, a second in n steps. */
struct Tumble
{
  Tumble(const unsigned int n, const bool turns_freely)
  {
    FreeBody<3> body(
      "  subsection Shape\n   set Type = box\n   set Lower corner = -0.5, -0.4, -0.2\n"
      "   set Upper corner = 0.5, 0.4, 0.2\n  end\n  set Initial spin = 1, 2, -1\n"
      + motion_text("set Force x = 0\nset Force y = 0\nset Force z = 0\nset Moment x = 0\n"
                    "set Moment y = 0\nset Moment z = 0"));
    body.turns_freely    = turns_freely;
    const double       m = 3. * 0.32;
    const Tensor<1, 3> J({m / 12. * (0.64 + 0.16), m / 12. * (1. + 0.16), m / 12. * 1.64});
    const Momentum<3>  start = body.momentum();
    const Tensor<1, 3> spin({1., 2., -1.});
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(start.angular[d], J[d] * spin[d], 3e-4 * J[d]);
    const auto energy = [&]() {
      return body.mass->kinetic_energy(body.model.state.displacement,
                                       body.model.state.predictor.rates);
    };
    const double           energy_at_start = energy();
    const OneStepScheme<3> scheme(trapezoidal());
    EXPECT_TRUE(body.equilibrium.free_motions().unsupported().front());
    for (unsigned int i = 1; i <= n; ++i)
      body.step(scheme, 1. * i / n);
    EXPECT_LT(body.momentum().linear.norm(), 1e-11);
    momentum_error = (body.momentum().angular - start.angular).norm() / start.angular.norm();
    energy_error   = std::abs(energy() / energy_at_start - 1.);
  }

  double momentum_error, energy_error;
};
} // namespace

// Momenta stay, the angular one by itself to order 2.
TEST(Inertia, RigidBodiesTumble)
{
  const Tumble coarse(20, false), fine(40, false);
  EXPECT_LT(fine.momentum_error, 1e-3);
  EXPECT_NEAR(std::log2(coarse.momentum_error / fine.momentum_error), 2., 0.2);
}

// Without what the scheme adds, the angular momentum stays and the energy does to order 2.
TEST(Inertia, BodiesThatTurnFreelyKeepTheirSpin)
{
  const Tumble coarse(20, true), fine(40, true);
  EXPECT_LT(coarse.momentum_error, 1e-12);
  EXPECT_LT(fine.momentum_error, 1e-12);
  EXPECT_LT(fine.energy_error, 1e-3);
  EXPECT_GT(std::log2(coarse.energy_error / fine.energy_error), 1.8);
}
