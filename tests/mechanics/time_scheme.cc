// A scheme with inertia: the equations get a factor of the mass and forces, nothing else.
#include <gtest/gtest.h>

#include <scree/mechanics/quasi_static.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include "equilibrium_model.h"

using namespace scree;
using namespace dealii;

namespace
{
constexpr double   newmark_beta = 0.25, newmark_gamma = 0.6, density = 3.;
const Tensor<1, 2> body_force({6., -12.});

/** Newmark's method with a lumped mass, from rest. */
class LumpedNewmark : public TimeScheme<2>
{
public:
  /** The mass is what the body force b acts on: rho int N_a = rho/b times the load of node a. */
  LumpedNewmark(const DisplacementSpace<2> &space, const Bulk<2> &bulk)
  {
    Vector loads(space.owned(), MPI_COMM_WORLD), masses(loads);
    bulk.add_body_forces(loads, 0.);
    loads.compress(VectorOperation::add);
    for (unsigned int cell = 0; cell < space.n_owned_cells(); ++cell)
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          {
            const DofIndex index = space.nodes(cell)[i] + d;
            masses(index)        = density / body_force[d] * loads(index);
          }
    masses.compress(VectorOperation::insert);
    DynamicSparsityPattern pattern(space.n_dofs(), space.n_dofs(), space.owned());
    for (const DofIndex index : space.owned())
      pattern.add(index, index);
    const auto matrix = std::make_shared<TrilinosWrappers::SparseMatrix>();
    matrix->reinit(space.owned(), space.owned(), pattern, MPI_COMM_WORLD);
    for (const DofIndex index : space.owned())
      matrix->set(index, index, masses(index));
    matrix->compress(VectorOperation::insert);
    mass = matrix;
  }

  std::optional<Vector> predicted(const Kinematics<2> &, const State<2> &state,
                                  const double time) const override
  {
    return predicted(state, time);
  }

  Vector predicted(const State<2> &state, const double time) const
  {
    const double dt     = time - state.time;
    Vector       result = state.displacement;
    if (!state.predictor.is_empty())
      {
        result.add(dt, state.predictor.rates.velocity);
        result.add(0.5 * dt * dt * (1. - 2. * newmark_beta), state.predictor.rates.acceleration);
      }
    return result;
  }

  Inertia inertia(const Kinematics<2> &, const State<2> &state, const double time) const override
  {
    const double factor = 1. / (newmark_beta * std::pow(time - state.time, 2));
    Inertia      result{factor, mass, state.displacement};
    mass->vmult(result.forces, predicted(state, time));
    result.forces *= factor;
    return result;
  }

  Rates rates(const State<2> &state, const Vector &u, const double time) const override
  {
    const double dt = time - state.time;
    Rates        result{u, u};
    result.acceleration -= predicted(state, time);
    result.acceleration *= 1. / (newmark_beta * dt * dt);
    result.velocity = result.acceleration;
    result.velocity *= newmark_gamma * dt;
    if (!state.predictor.is_empty())
      {
        result.velocity += state.predictor.rates.velocity;
        result.velocity.add(dt * (1. - newmark_gamma), state.predictor.rates.acceleration);
      }
    return result;
  }

private:
  std::shared_ptr<const TrilinosWrappers::SparseMatrix> mass;
};

/** A disc that nothing holds. */
std::string
free_disc()
{
  return grid_text("-1, -1", "1, 1", "4, 4", 1) + degree_text(1)
         + bodies_text({{"disc", ball_text("0.02, 0.01", 0.63) + "  set Body force = 6; -12\n"}});
}

/** A step of the scheme, by Newton's method; the state is taken over. */
void
step(EquilibriumModel<2> &model, const TimeScheme<2> &scheme, const double time)
{
  using Vector          = EquilibriumModel<2>::Vector;
  State<2> &state       = model.state;
  auto     &equilibrium = model.equilibrium;
  Vector    u           = *scheme.predicted(model.kinematics, state, time), r(u), du(u);
  equilibrium.set_time(time, u);
  equilibrium.set_inertia(scheme.inertia(model.kinematics, state, time));
  EXPECT_TRUE(equilibrium.has_inertia());
  for (unsigned int i = 0; i < 5; ++i)
    {
      equilibrium.residual(u, state.contact, r);
      model.linear_solver.solve(equilibrium.tangent(), du, r, equilibrium.is_symmetric());
      u += du;
    }
  equilibrium.residual(u, state.contact, r);
  EXPECT_LT(r.l2_norm(), 1e-11 * equilibrium.force_scale());
  state.predictor.rates     = scheme.rates(state, u, time);
  state.predictor.step_size = time - state.time;
  state.displacement        = u;
  state.time                = time;
}
} // namespace

// A body force b on the density rho of a free body: a = b/rho everywhere, without stress.
TEST(TimeScheme, NewmarkStepsOfAFreeBody)
{
  EquilibriumModel<2> model(free_disc());
  const LumpedNewmark scheme(*model.cut.space, model.bulk);
  const Tensor<1, 2>  a             = body_force / density;
  const auto          expect_motion = [&](const Tensor<1, 2> &u, const Tensor<1, 2> &v) {
    const auto &rates = model.state.predictor.rates;
    for (unsigned int cell = 0; cell < model.cut.space->n_owned_cells(); ++cell)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const DofIndex index = model.cut.space->nodes(cell)[0] + d;
          EXPECT_NEAR(model.state.displacement(index), u[d], 1e-9);
          EXPECT_NEAR(rates.velocity(index), v[d], 1e-8);
          EXPECT_NEAR(rates.acceleration(index), a[d], 1e-7);
        }
  };
  const double dt = 0.1, next = 0.05;
  step(model, scheme, dt);
  const Tensor<1, 2> u = newmark_beta * dt * dt * a, v = newmark_gamma * dt * a;
  expect_motion(u, v);
  // Momentum grows by the force: bodies are in balance with their inertia.
  const auto balance = model.equilibrium.balance(model.state.displacement);
  ASSERT_EQ(balance.size(), 1u);
  EXPECT_LT(balance[0].force.norm(), 1e-11 * body_force.norm());
  step(model, scheme, dt + next);
  expect_motion(u + next * v + 0.5 * next * next * a, v + next * a);
}

// Inertia in the tangent is the derivative of that in the residual; without it all is as before.
TEST(TimeScheme, InertiaLeavesNothingBehind)
{
  EquilibriumModel<2> model(free_disc());
  const LumpedNewmark scheme(*model.cut.space, model.bulk);
  auto                u = model.state.displacement, r = u, with = u, expected = u;
  for (const DofIndex index : model.cut.space->owned())
    u(index) = 1e-3 * (index % 7);
  u.compress(VectorOperation::insert);
  model.equilibrium.set_time(1., u);
  model.equilibrium.residual(u, model.state.contact, r);
  const Inertia inertia = scheme.inertia(model.kinematics, model.state, 0.1);
  model.equilibrium.set_inertia(inertia);
  model.equilibrium.residual(u, model.state.contact, with);
  inertia.mass->vmult(expected, u);
  expected.sadd(-inertia.factor, 1., inertia.forces);
  with -= r;
  with -= expected;
  EXPECT_LT(with.linfty_norm(), 1e-12 * expected.linfty_norm());

  const QuasiStatic<2> quasi_static;
  EXPECT_FALSE(quasi_static.predicted(model.kinematics, model.state, 0.1).has_value());
  model.equilibrium.set_inertia(quasi_static.inertia(model.kinematics, model.state, 0.1));
  model.equilibrium.residual(u, model.state.contact, with);
  with -= r;
  EXPECT_EQ(with.linfty_norm(), 0.);
  const Rates rates = quasi_static.rates(model.state, u, 0.1);
  EXPECT_EQ(rates.acceleration.size(), 0u);
  EXPECT_NEAR(rates.velocity.linfty_norm(), 10. * u.linfty_norm(), 1e-15);
}
