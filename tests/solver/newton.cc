// Newton's method on small systems: order of convergence, line searches, the ways to fail.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>
#include <scree/solver/linear_solver.h>
#include <scree/solver/newton.h>

#include <cmath>
#include <limits>
#include <optional>

namespace scree
{
namespace
{
using namespace dealii;
using Vector = Newton::Vector;

Vector
vector(const std::vector<double> &values)
{
  Vector v(complete_index_set(values.size()), MPI_COMM_SELF);
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

/** One equation scale * f(u) = 0, r = -scale * f; the reference is scale. */
Newton::Hooks
scalar(const std::function<double(double)> &f, const std::function<double(double)> &derivative,
       const double scale = 1)
{
  Newton::Hooks hooks;
  hooks.residual = [=](const Vector &u, Vector &r) { r(0) = -scale * f(u(0)); };
  hooks.solve    = [=](const Vector &u, const Vector &r, double, Vector &du) {
    du(0) = r(0) / (scale * derivative(u(0)));
  };
  hooks.reference = [=]() { return scale; };
  return hooks;
}

NewtonParameters
with(const LineSearch line_search)
{
  NewtonParameters parameters;
  parameters.line_search = line_search;
  return parameters;
}

/** u0^2 + u1 = 3, u0 + u1^3 = 9 with the solution (1, 2). */
Newton::Hooks
two_equations()
{
  Newton::Hooks hooks;
  hooks.residual = [](const Vector &u, Vector &r) {
    r(0) = 3 - u(0) * u(0) - u(1);
    r(1) = 9 - u(0) - u(1) * u(1) * u(1);
  };
  hooks.solve = [](const Vector &u, const Vector &r, double, Vector &du) {
    const double a = 2 * u(0), b = 1, c = 1, d = 3 * u(1) * u(1), det = a * d - b * c;
    du(0) = (d * r(0) - b * r(1)) / det;
    du(1) = (a * r(1) - c * r(0)) / det;
  };
  hooks.reference = []() { return 10.; };
  return hooks;
}

TEST(Newton, ConvergesQuadratically)
{
  std::vector<NewtonIteration> log;
  Newton::Hooks                hooks = two_equations();
  hooks.observe = [&](const NewtonIteration &iteration) { log.push_back(iteration); };
  NewtonParameters parameters;
  parameters.relative_tolerance = 1e-14;
  Vector             u          = vector({1.3, 2.2});
  const NewtonResult result     = Newton(parameters, hooks).solve(u);

  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_NEAR(u(0), 1, 1e-13);
  EXPECT_NEAR(u(1), 2, 1e-13);
  EXPECT_LE(result.iterations, 6u);
  EXPECT_EQ(result.residuals.size(), result.iterations + 1);
  EXPECT_EQ(log.size(), result.residuals.size());
  EXPECT_EQ(log.back().number, result.iterations);
  EXPECT_EQ(log.back().tolerance, 1e-13);
  // |r_(k+1)| <= C |r_k|^2 with one C while the residuals are above round-off.
  unsigned int checked = 0;
  for (std::size_t k = 0; k + 1 < result.residuals.size() && result.residuals[k + 1] > 1e-12; ++k)
    {
      EXPECT_LT(result.residuals[k + 1], 0.6 * std::pow(result.residuals[k], 2));
      ++checked;
    }
  EXPECT_GE(checked, 3u);
}

TEST(Newton, LineSearchesRescueAtan)
{
  const auto f = [](double u) { return std::atan(u); };
  const auto d = [](double u) { return 1 / (1 + u * u); };
  for (const auto line_search : {LineSearch::none, LineSearch::residual, LineSearch::work})
    {
      Vector             u      = vector({3.});
      const NewtonResult result = Newton(with(line_search), scalar(f, d)).solve(u);
      EXPECT_EQ(result.converged(), line_search != LineSearch::none) << result.message;
      if (result.converged())
        {
          EXPECT_NEAR(u(0), 0, 1e-9);
          EXPECT_LE(result.iterations, 8u);
        }
    }
}

TEST(Newton, WorkLineSearchFindsTheContactOfASpring)
{
  // f = k u - load + eps <u - g>: the first step misses the contact by far, and from beyond it the
  // tangent is right. Without the search the residual jumps by a factor of 1e3 first.
  const double k = 1, load = 10, eps = 1e4, g = 0.1;
  const auto   f = [=](double u) { return k * u - load + eps * std::max(u - g, 0.); };
  const auto   d = [=](double u) { return k + (u > g ? eps : 0); };

  double       largest[2];
  unsigned int count = 0;
  for (const auto line_search : {LineSearch::none, LineSearch::work})
    {
      Vector             u      = vector({0.});
      const NewtonResult result = Newton(with(line_search), scalar(f, d)).solve(u);
      ASSERT_TRUE(result.converged()) << result.message;
      EXPECT_NEAR(u(0), (load + eps * g) / (k + eps), 1e-9);
      EXPECT_LE(result.iterations, 5u);
      largest[count++] = *std::max_element(result.residuals.begin(), result.residuals.end());
    }
  EXPECT_GT(largest[0], 1e4);
  EXPECT_LE(largest[1], 10.);
}

// A spring that finds a stiff stop, and a load on a spring that nothing couples to it: the step of
// the one is shortened, that of the other is not.
TEST(Newton, PartsHaveLineSearchesOfTheirOwn)
{
  const double  k = 1, load = 10, eps = 1e4, g = 0.1;
  Newton::Hooks hooks;
  double        second = 0.;
  hooks.residual       = [&](const Vector &u, Vector &r) {
    r(0)   = load - k * u(0) - eps * std::max(u(0) - g, 0.);
    r(1)   = load - k * u(1);
    second = u(1);
  };
  hooks.solve = [&](const Vector &u, const Vector &r, double, Vector &du) {
    du(0) = r(0) / (k + (u(0) > g ? eps : 0.));
    du(1) = r(1) / k;
  };
  hooks.reference = []() { return 10.; };
  for (const bool has_parts : {true, false})
    {
      unsigned int n_begun = 0;
      hooks.parts          = [&](const bool begins) {
        n_begun += begins ? 1 : 0;
        return has_parts ? Partition{2, {0, 1}} : Partition();
      };
      std::vector<double> seconds, lengths;
      hooks.observe = [&](const NewtonIteration &iteration) {
        seconds.push_back(second);
        lengths.push_back(iteration.step_length);
      };
      Vector             u      = vector({0., 0.});
      const NewtonResult result = Newton(with(LineSearch::work), hooks).solve(u);
      ASSERT_TRUE(result.converged()) << result.message;
      EXPECT_NEAR(u(0), (load + eps * g) / (k + eps), 1e-9);
      EXPECT_NEAR(u(1), load / k, 1e-9);
      EXPECT_EQ(n_begun, result.iterations);
      EXPECT_LT(lengths[1], 1.);
      EXPECT_EQ(std::abs(seconds[1] - load / k) < 1e-12, has_parts);
    }
}

TEST(Newton, LineSearchEndsACycle)
{
  // f = sign(u) sqrt|u| sends u to -u for ever.
  const auto f = [](double u) { return std::copysign(std::sqrt(std::abs(u)), u); };
  const auto d = [](double u) { return 0.5 / std::sqrt(std::abs(u)); };
  for (const auto line_search : {LineSearch::none, LineSearch::residual, LineSearch::work})
    {
      Vector           u            = vector({1.});
      NewtonParameters parameters   = with(line_search);
      parameters.relative_tolerance = 1e-6;
      const NewtonResult result     = Newton(parameters, scalar(f, d)).solve(u);
      EXPECT_EQ(result.converged(), line_search != LineSearch::none) << result.message;
      EXPECT_EQ(result.status == NewtonStatus::max_iterations, line_search == LineSearch::none);
    }
}

/** A force 0.3 pushes what the tangent hardly resists, towards a spring that begins at u = 1;
 * lagged steps have a mass of 1. The factors of the mass are written to `masses`, those of ends as
 * 0. */
Newton::Hooks
loose_body(std::vector<double> &masses)
{
  Newton::Hooks hooks;
  const auto    pressed = [](const Vector &u) { return std::max(0., u(0) - 1.); };
  hooks.residual        = [=](const Vector &u, Vector &r) { r(0) = 0.3 - pressed(u); };
  hooks.solve           = [=, &masses](const Vector &u, const Vector &r, double, Vector &du) {
    du(0) = r(0) / ((pressed(u) > 0. ? 1. : 1e-6) + (masses.empty() ? 0. : masses.back()));
  };
  hooks.reference = []() { return 1.; };
  hooks.lag       = [&](const std::optional<double> s) { masses.push_back(s.value_or(0.)); };
  hooks.mass      = [&](const Vector &du) {
    double last = 0.;
    for (const double mass : masses)
      last = mass > 0. ? mass : last;
    Vector result(du);
    result *= last > 0. ? last : 1e-6;
    return result;
  };
  return hooks;
}

TEST(Newton, LagsFrictionAfterShortSteps)
{
  std::vector<double>          masses;
  std::vector<NewtonIteration> log;
  Newton::Hooks                hooks = loose_body(masses);
  hooks.observe             = [&](const NewtonIteration &iteration) { log.push_back(iteration); };
  Vector             u      = vector({0.});
  const NewtonResult result = Newton(with(LineSearch::work), hooks).solve(u);
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_NEAR(u(0), 1.3, 1e-8);
  EXPECT_LE(result.iterations, 6u);
  ASSERT_LT(log[1].step_length, 0.5);
  // Each lagged step begins with a mass and ends.
  ASSERT_EQ(masses.size() % 2, 0u);
  ASSERT_GE(masses.size(), 2u);
  EXPECT_EQ(masses[0], 1e-4);
  for (std::size_t i = 0; i < masses.size(); i += 2)
    {
      EXPECT_GT(masses[i], 0.);
      EXPECT_EQ(masses[i + 1], 0.);
    }
}

TEST(Newton, FullStepsAreNeverLagged)
{
  std::vector<double> masses;
  Vector              u = vector({0.});
  EXPECT_TRUE(Newton(with(LineSearch::none), loose_body(masses)).solve(u).converged());
  EXPECT_TRUE(masses.empty());
}

TEST(Newton, BalancesOnlyWhereTheResidualAllows)
{
  // A balance that sends u back to -1 for ever: refused from the fourth time on.
  Newton::Hooks hooks     = two_equations();
  unsigned int  n_balance = 0;
  hooks.lag               = [](std::optional<double>) {};
  hooks.mass              = [](const Vector &du) {
    Vector result(du);
    result = 0.;
    return result;
  };
  hooks.balance = [&](Vector &u) {
    if (u(0) == 1.3)
      return false;
    ++n_balance;
    u = vector({1.3, 2.2});
    return true;
  };
  Vector             u      = vector({1.3, 2.2});
  const NewtonResult result = Newton(NewtonParameters(), hooks).solve(u);
  ASSERT_TRUE(result.converged()) << result.message;
  EXPECT_NEAR(u(0), 1, 1e-8);
  EXPECT_GT(n_balance, 3u);
}

TEST(Newton, StepsToUndefinedResidualsAreHalved)
{
  // log(u) is not a number at the end of the first step, u = 5 - 5 log 5 < 0.
  const auto f = [](double u) { return std::log(u); };
  const auto d = [](double u) { return 1 / u; };
  for (const auto line_search : {LineSearch::none, LineSearch::residual, LineSearch::work})
    {
      Vector             u      = vector({5.});
      const NewtonResult result = Newton(with(line_search), scalar(f, d)).solve(u);
      EXPECT_TRUE(result.converged()) << result.message;
      EXPECT_NEAR(u(0), 1, 1e-8);
    }
}

TEST(Newton, UnitsDoNotMatter)
{
  const auto                f = [](double u) { return u + u * u * u - 1; };
  const auto                d = [](double u) { return 1 + 3 * u * u; };
  std::vector<unsigned int> iterations;
  for (const double scale : {1e-9, 1., 1e12})
    {
      Vector u = vector({0.});
      iterations.push_back(Newton(NewtonParameters(), scalar(f, d, scale)).solve(u).iterations);
      EXPECT_NEAR(f(u(0)), 0, 1e-9);
    }
  EXPECT_EQ(iterations[0], iterations[1]);
  EXPECT_EQ(iterations[2], iterations[1]);
}

TEST(Newton, NothingToDoTakesNoIteration)
{
  Newton::Hooks hooks       = scalar([](double u) { return u; }, [](double) { return 1.; });
  hooks.reference           = []() { return 0.; };
  Vector             u      = vector({0.});
  const NewtonResult result = Newton(NewtonParameters(), hooks).solve(u);
  EXPECT_EQ(result.status, NewtonStatus::converged);
  EXPECT_EQ(result.iterations, 0u);
}

TEST(Newton, PatienceEndsWithTheIterationThatDoesNotHelp)
{
  // x^2 = 2 from afar: |r| falls to a quarter in each iteration, then quadratically.
  const auto       f          = [](const double x) { return x * x - 2.; };
  const auto       d          = [](const double x) { return 2. * x; };
  NewtonParameters parameters = with(LineSearch::none);
  Vector           u          = vector({1e3});
  parameters.patience         = 3;
  EXPECT_EQ(Newton(parameters, scalar(f, d)).solve(u).iterations, 3u);
  u                   = vector({1.5});
  parameters.patience = 1;
  EXPECT_TRUE(Newton(parameters, scalar(f, d)).solve(u).converged()); // in 4
}

TEST(Newton, RoundOffPlateauIsAccepted)
{
  // The residual never falls below 3e-12, a stand-in for the rounding of large internal forces.
  const auto       f            = [](double u) { return std::abs(u - 1) < 3e-12 ? 3e-12 : u - 1; };
  const auto       d            = [](double) { return 1.; };
  NewtonParameters parameters   = with(LineSearch::none);
  parameters.relative_tolerance = 1e-13;
  Vector             u          = vector({0.});
  const NewtonResult result     = Newton(parameters, scalar(f, d)).solve(u);
  EXPECT_EQ(result.status, NewtonStatus::converged_at_round_off) << result.message;
  EXPECT_TRUE(result.converged());

  // The same plateau far above the tolerance is a failure.
  parameters.relative_tolerance = 1e-15;
  u                             = vector({0.});
  EXPECT_EQ(Newton(parameters, scalar(f, d)).solve(u).status, NewtonStatus::max_iterations);
}

TEST(Newton, WhatTheAccuracyOfTheGeometryLeavesIsAccepted)
{
  const auto    f      = [](double u) { return std::abs(u - 1) < 1e-6 ? 1e-6 : u - 1; };
  Newton::Hooks hooks  = scalar(f, [](double) { return 1.; });
  unsigned int  asked  = 0;
  Vector        u      = vector({0.});
  const auto    answer = [&](const bool is_geometric) {
    hooks.is_geometric = [&asked, is_geometric](const Vector &, double) {
      ++asked;
      return is_geometric;
    };
    u = vector({0.});
    return Newton(with(LineSearch::none), hooks).solve(u);
  };
  const NewtonResult accepted = answer(true);
  EXPECT_EQ(accepted.status, NewtonStatus::converged_at_round_off) << accepted.message;
  EXPECT_EQ(asked, 1u);
  EXPECT_LE(accepted.iterations, 4u);
  EXPECT_FALSE(answer(false).converged());
}

// A residual that turns from 1e-6 to -1.2e-6 and back: a contact that opens and closes.
TEST(Newton, StandsStillInBalance)
{
  const auto f = [](double u) { return std::abs(u - 1) > 2e-6 ? u - 1 : u > 1 ? 1.2e-6 : -1e-6; };
  Newton::Hooks hooks  = scalar(f, [](double) { return 1.; });
  const auto    answer = [&](const bool is_in_balance) {
    std::vector<double> asked;
    hooks.is_in_balance = [&](const Vector &, const double residual) {
      asked.push_back(residual);
      return is_in_balance;
    };
    Vector             u      = vector({0.});
    const NewtonResult result = Newton(with(LineSearch::none), hooks).solve(u);
    for (const double residual : asked)
      EXPECT_LE(residual, 1.2e-6);
    return result;
  };
  const NewtonResult accepted = answer(true);
  EXPECT_EQ(accepted.status, NewtonStatus::converged_at_standstill) << accepted.message;
  EXPECT_TRUE(accepted.converged());
  EXPECT_GE(accepted.iterations, 8u);
  EXPECT_LE(accepted.iterations, 12u);
  EXPECT_FALSE(answer(false).converged());
}

// A residual of 2e-8 at u = 1 that nothing after it comes near: contact at a gap of zero opens for
// good.
TEST(Newton, GoesBackToTheBestInBalance)
{
  const auto f = [](double u) {
    const double distance = std::abs(u - 1);
    return distance < 1e-9 ? -2e-8 : distance < 1e-6 ? -8e-5 : distance < 1e-3 ? 8e-5 : u - 1;
  };
  Newton::Hooks hooks  = scalar(f, [](double) { return 1.; });
  const auto    answer = [&](const bool is_in_balance, Vector &u) {
    hooks.is_in_balance = [&](const Vector &at, const double residual) {
      EXPECT_EQ(residual, 2e-8);
      EXPECT_EQ(at(0), 1.);
      return is_in_balance;
    };
    u = vector({0.});
    return Newton(with(LineSearch::none), hooks).solve(u);
  };
  Vector             u        = vector({0.});
  const NewtonResult accepted = answer(true, u);
  EXPECT_EQ(accepted.status, NewtonStatus::converged_at_standstill) << accepted.message;
  EXPECT_EQ(accepted.iterations, 4u);
  EXPECT_EQ(accepted.residuals.back(), 2e-8);
  EXPECT_EQ(u(0), 1.);
  EXPECT_FALSE(answer(false, u).converged());
}

TEST(Newton, FailuresAreTold)
{
  const auto one = [](double) { return 1.; };

  Newton::Hooks hooks = scalar([](double u) { return u - 1; }, one);
  hooks.solve         = [](const Vector &, const Vector &, double, Vector &) {
    throw LinearSolverFailure("the matrix is singular");
  };
  Vector       u      = vector({0.});
  NewtonResult result = Newton(NewtonParameters(), hooks).solve(u);
  EXPECT_EQ(result.status, NewtonStatus::linear_solver_failure);
  EXPECT_EQ(result.message, "the matrix is singular");
  EXPECT_EQ(result.iterations, 1u);

  const auto nan = [](double) { return std::numeric_limits<double>::quiet_NaN(); };
  result         = Newton(NewtonParameters(), scalar(nan, one)).solve(u);
  EXPECT_EQ(result.status, NewtonStatus::diverged);
  EXPECT_EQ(result.iterations, 0u);

  // No lagged step goes on from what is not finite.
  hooks      = scalar([&](double u) { return u == 0. ? 1. : nan(u); }, one);
  hooks.lag  = [](std::optional<double>) {};
  hooks.mass = [](const Vector &du) { return du; };
  u          = vector({0.});
  EXPECT_EQ(Newton(NewtonParameters(), hooks).solve(u).status, NewtonStatus::diverged);

  // u^2 + 1 has no zero.
  u      = vector({0.7});
  result = Newton(NewtonParameters(),
                  scalar([](double u) { return u * u + 1; }, [](double u) { return 2 * u; }))
             .solve(u);
  EXPECT_EQ(result.status, NewtonStatus::max_iterations);
  EXPECT_EQ(result.iterations, NewtonParameters().max_iterations);
  EXPECT_EQ(result.residuals.size(), NewtonParameters().max_iterations + 1u);

  // exp(-u) - 1e3 u runs away without a line search when the tangent is wrong by sign and size.
  u      = vector({1.});
  result = Newton(with(LineSearch::none),
                  scalar([](double u) { return u; }, [](double) { return -0.01; }))
             .solve(u);
  EXPECT_EQ(result.status, NewtonStatus::diverged);
}

TEST(NewtonParameters, AreReadAndChecked)
{
  ParameterFile good
    = ParameterFile::from_string("set Line search = residual\nset Relative tolerance = 1e-12\n");
  NewtonParameters parameters;
  parameters.declare(good.root());
  good.check();
  EXPECT_EQ(parameters.line_search, LineSearch::residual);
  EXPECT_EQ(parameters.relative_tolerance, 1e-12);

  for (const char *wrong : {"set Line search = maybe", "set Relative tolerance = 0",
                            "set Maximum iterations = 0", "set Absolute tolerance = -1"})
    {
      ParameterFile bad = ParameterFile::from_string(wrong);
      NewtonParameters().declare(bad.root());
      EXPECT_THROW(bad.check(), UserError) << wrong;
    }
}
} // namespace
} // namespace scree
