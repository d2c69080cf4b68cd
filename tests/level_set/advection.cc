#include <gtest/gtest.h>

#include <scree/level_set/advection.h>
#include <scree/level_set/map_velocity.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
NodeSet<dim>
all_nodes_of(const Lattice<dim> &lattice)
{
  return all_nodes(HaloGrid<dim>{lattice.n_nodes(), lattice.spacing()});
}

// The body {phi < 0}, star-shaped about a centre, against another one: areas by rays.
struct Comparison
{
  double area;     // relative error
  double distance; // largest |phi_exact| on the contour: the Hausdorff distance for a disc
};

template <typename F>
Comparison
compare(const Lattice<2> &lattice, const Point<2> &centre, const double reach, const F &exact)
{
  const int  n_rays = 720;
  double     area = 0, exact_area = 0, distance = 0;
  const auto root = [&](const auto &phi, const Tensor<1, 2> &ray) {
    double low = 0, high = reach;
    for (int i = 0; i < 50; ++i)
      {
        const double middle                           = 0.5 * (low + high);
        (phi(centre + middle * ray) < 0 ? low : high) = middle;
      }
    return low;
  };
  for (int i = 0; i < n_rays; ++i)
    {
      const double       angle = 2 * numbers::PI * i / n_rays;
      const Tensor<1, 2> ray({std::cos(angle), std::sin(angle)});
      const double       r = root([&](const Point<2> &x) { return lattice.value(x, 3); }, ray),
                   s       = root(exact, ray);
      area += r * r;
      exact_area += s * s;
      distance = std::max(distance, std::abs(exact(Point<2>(centre + r * ray))));
    }
  return {area / exact_area - 1, distance};
}

const char *
name(const IncrementMotion motion)
{
  return motion == IncrementMotion::semi_lagrangian ? "semi-Lagrangian"
         : motion == IncrementMotion::map_velocity  ? "map velocity"
                                                    : "frozen velocity";
}

// The velocity of the map of a turn, v(x, tau) = du(X), in closed form.
TEST(MapVelocity, SolvesTheMapOfATurn)
{
  for (const double angle : {0.126, 1.2})
    {
      const auto lattice = sampled<2>(0.1, 1, [](const Point<2> &) { return 0.; });
      const auto du = vectors<2>(lattice, [&](const Point<2> &x) { return turned(x, angle) - x; });
      NodalVectors<2> v = du;
      EXPECT_EQ(map_velocity<2>(all_nodes_of(lattice), du, 0.6, v), 0u);
      for (std::size_t i = 0; i < v[0].size(); ++i)
        {
          const Point<2> x = lattice.node(lattice.index(i));
          const Point<2> X(x[0] - 0.6 * v[0][i], x[1] - 0.6 * v[1][i]);
          EXPECT_NEAR((X + 0.6 * (turned(X, angle) - X) - x).norm(), 0, 1e-10);
        }
    }
}

TEST(MapVelocity, SolvesACurvedMapIn3d)
{
  std::array<double, 2> errors;
  for (const int level : {0, 1})
    {
      const double h       = 0.1 / (1 + level);
      const auto   lattice = sampled<3>(h, 1, [](const Point<3> &) { return 0.; });
      const auto   map     = [](const Point<3> &x) {
        return Tensor<1, 3>(
          {0.2 * std::sin(2 * x[1]), 0.1 * std::cos(x[2] + x[0]), 0.2 * x[0] * x[1]});
      };
      const auto      du = vectors<3>(lattice, map);
      NodalVectors<3> v  = du;
      EXPECT_EQ(map_velocity<3>(all_nodes_of(lattice), du, 1., v), 0u);
      errors[level] = 0;
      for (std::size_t i = 0; i < v[0].size(); ++i)
        {
          const Point<3> x = lattice.node(lattice.index(i));
          const Point<3> X = x - Tensor<1, 3>({v[0][i], v[1][i], v[2][i]});
          if (x.norm() < 0.7)
            errors[level] = std::max(errors[level], (X + map(X) - x).norm());
        }
    }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.5);
  EXPECT_LT(errors[1], 1e-6);
}

TEST(MapVelocity, CountsNodesWhereTheMapFolds)
{
  const auto      lattice = sampled<2>(0.1, 1, [](const Point<2> &) { return 0.; });
  const auto      du      = vectors<2>(lattice, [](const Point<2> &x) {
    return Tensor<1, 2>({-1.5 * std::sin(9 * x[0]), 0.});
  });
  NodalVectors<2> v       = du;
  EXPECT_GT(map_velocity<2>(all_nodes_of(lattice), du, 1., v), 0u);
}

// Ten semi-Lagrangian steps of a smooth bump: the error of cubic interpolation, order 4.
TEST(SemiLagrangian, HasOrderFourOnSmoothData)
{
  std::array<double, 3> errors;
  const auto            bump
    = [](const Point<2> &x) { return std::exp(-25 * (x - Point<2>(0.35, 0.1)).norm_square()); };
  for (unsigned int level = 0; level < 3; ++level)
    {
      const double step    = 0.13;
      auto         lattice = sampled<2>(0.04 / (1 << level), 1, bump);
      const auto   du = vectors<2>(lattice, [&](const Point<2> &x) { return turned(x, step) - x; });
      for (int i = 0; i < 10; ++i)
        EXPECT_EQ(advect_increment<2>(lattice, du).n_unconverged, 0u);
      errors[level] = 0;
      for (std::size_t i = 0; i < lattice.values().size(); ++i)
        {
          const Point<2> x = lattice.node(lattice.index(i));
          if (x.norm() < 0.9)
            errors[level] = std::max(errors[level],
                                     std::abs(lattice.values()[i] - bump(turned(x, -10 * step))));
        }
    }
  std::cout << "errors " << errors[0] << ' ' << errors[1] << ' ' << errors[2] << ", orders "
            << std::log2(errors[0] / errors[1]) << ' ' << std::log2(errors[1] / errors[2]) << '\n';
  EXPECT_GT(std::log2(errors[1] / errors[2]), 3.5);
}

// A disc off the centre of turning, 50 steps of 7.2 degrees. The flow of the frozen velocity
// du = (R - I) x shrinks areas by exp(2 cos theta - 2) per step: the map matters.
TEST(ReleaseIncrements, TurnADiscByOneRevolution)
{
  const double   h = 0.4, radius = 6;
  const Point<2> centre(3, 1);
  const auto     disc = [&](const Point<2> &x) { return (x - centre).norm() - radius; };
  for (const auto motion : {IncrementMotion::semi_lagrangian, IncrementMotion::map_velocity,
                            IncrementMotion::frozen_velocity})
    {
      auto       lattice = sampled<2>(h, 14, disc);
      const auto du      = vectors<2>(
        lattice, [&](const Point<2> &x) { return turned(x, 2 * numbers::PI / 50) - x; });
      AdvectionCount total{0, 0, 0};
      for (int step = 0; step < 50; ++step)
        {
          const AdvectionCount count = advect_increment<2>(lattice, du, motion);
          total.n_steps += count.n_steps;
          total.n_unconverged += count.n_unconverged;
        }
      const Comparison end = compare(lattice, centre, 9, disc);
      std::cout << name(motion) << ": area " << end.area << ", distance/h " << end.distance / h
                << ", steps " << total.n_steps << '\n';
      EXPECT_EQ(total.n_unconverged, 0u);
      if (motion == IncrementMotion::frozen_velocity)
        EXPECT_NEAR(end.area, std::expm1(50 * (2 * std::cos(2 * numbers::PI / 50) - 2)), 1e-3);
      else
        {
          EXPECT_LT(std::abs(end.area), 1e-3);
          EXPECT_LT(end.distance, h / 4);
        }
    }
}

// Simple shear to 100 % in 50 steps; du(x) = (0.02 y, 0), for which map and flow agree.
TEST(Increments, ShearADiscTo100Percent)
{
  const double h = 0.4, radius = 6;
  // a distance near the contour: f / |grad f| of the sheared disc f = |X| - radius
  const auto sheared = [&](const Point<2> &x) {
    const double X = x[0] - x[1], r = std::hypot(X, x[1]) + 1e-300;
    return (r - radius) / std::hypot(X / r, (x[1] - X) / r);
  };
  for (const auto motion : {IncrementMotion::semi_lagrangian, IncrementMotion::map_velocity,
                            IncrementMotion::frozen_velocity})
    {
      auto       lattice = sampled<2>(h, 16, [&](const Point<2> &x) { return x.norm() - radius; });
      const auto du      = vectors<2>(lattice, [](const Point<2> &x) {
        return Tensor<1, 2>({0.02 * x[1], 0.});
      });
      for (int step = 0; step < 50; ++step)
        EXPECT_EQ(advect_increment<2>(lattice, du, motion).n_unconverged, 0u);
      const Comparison end = compare(lattice, Point<2>(), 14, sheared);
      std::cout << name(motion) << ": area " << end.area << ", distance/h " << end.distance / h
                << '\n';
      EXPECT_LT(std::abs(end.area), 1e-3);
      EXPECT_LT(end.distance, h / 4);
    }
}

// A motion that is continued badly far from the body: the map folds there and some back-traces have
// no solution. Values must stay finite, and the body must not notice.
TEST(Increments, FoldsFarFromTheBody)
{
  const double    h       = 0.25;
  const auto      disc    = [](const Point<2> &x) { return x.norm() - 2.; };
  const auto      initial = sampled<2>(h, 8, disc);
  const auto      du      = vectors<2>(initial, [&](const Point<2> &x) {
    const double far = std::max(disc(x) - 2., 0.);
    return Point<2>(0.1 - 1.1 * far + std::sin(7 * far), 0.3 * far * far * std::cos(11 * x[1]));
  });
  const auto      u       = vectors<2>(initial, [](const Point<2> &) { return Point<2>(); });
  auto            image = initial, moved = initial;
  NodalVectors<2> moved_by;
  EXPECT_GT(image_of_initial<2>(image, initial, du, u, moved_by).n_unconverged, 0u);
  EXPECT_GT(advect_increment<2>(moved, du).n_unconverged, 0u);
  for (std::size_t i = 0; i < initial.values().size(); ++i)
    {
      const Point<2> x = initial.node(initial.index(i));
      EXPECT_LT(std::abs(image.values()[i]), 100.);
      EXPECT_LT(std::abs(moved.values()[i]), 100.);
      if (std::abs(disc(x)) < 1.)
        {
          EXPECT_NEAR(image.values()[i], disc(x - Tensor<1, 2>({0.1, 0.})), 0.1 * h);
          EXPECT_NEAR(moved.values()[i], disc(x - Tensor<1, 2>({0.1, 0.})), 0.1 * h);
        }
    }
}

// A square turned by 360 degrees: advection rounds its corners step by step, the image of the
// initial level set keeps them.
TEST(Increments, ImageOfTheInitialLevelSetDoesNotWear)
{
  const double   h = 0.25, angle = 2 * numbers::PI / 100;
  const Point<2> centre(1, 0.5);
  const auto     square = [&](const Point<2> &x) {
    return std::max(std::abs(x[0] - centre[0]), std::abs(x[1] - centre[1])) - 3.;
  };
  const auto initial = sampled<2>(h, 7, square);
  auto       worn = initial, image = initial;
  const auto du = vectors<2>(initial, [&](const Point<2> &x) { return turned(x, angle) - x; });
  for (int step = 0; step < 100; ++step)
    {
      advect_increment<2>(worn, du);
      const auto u
        = vectors<2>(initial, [&](const Point<2> &x) { return x - turned(x, -step * angle); });
      NodalVectors<2> moved_by;
      EXPECT_EQ(image_of_initial<2>(image, initial, du, u, moved_by).n_unconverged, 0u);
    }
  double by_steps = 0., at_once = 0.;
  for (std::size_t i = 0; i < initial.values().size(); ++i)
    if (std::abs(initial.values()[i]) < 3 * h)
      {
        by_steps = std::max(by_steps, std::abs(worn.values()[i] - initial.values()[i]));
        at_once  = std::max(at_once, std::abs(image.values()[i] - initial.values()[i]));
      }
  std::cout << "change/h by steps " << by_steps / h << ", image " << at_once / h << '\n';
  EXPECT_LT(at_once, 1e-9 * h);
  EXPECT_GT(by_steps, 0.1 * h);
}

TEST(ReleaseIncrements, TurnABallIn3d)
{
  const double h = 0.1, angle = numbers::PI / 20;
  const auto   ball = [](const Point<3> &x) { return (x - Point<3>(0.3, 0.1, -0.1)).norm() - 0.5; };
  for (const auto motion : {IncrementMotion::semi_lagrangian, IncrementMotion::map_velocity})
    {
      auto       lattice = sampled<3>(h, 1.3, ball);
      const auto du = vectors<3>(lattice, [&](const Point<3> &x) { return turned(x, angle) - x; });
      for (int step = 0; step < 10; ++step)
        EXPECT_EQ(advect_increment<3>(lattice, du, motion).n_unconverged, 0u);
      double error = 0;
      for (std::size_t i = 0; i < lattice.values().size(); ++i)
        {
          const Point<3> X = turned(lattice.node(lattice.index(i)), -10 * angle);
          if (std::abs(ball(X)) < h)
            error = std::max(error, std::abs(lattice.values()[i] - ball(X)));
        }
      std::cout << name(motion) << ": error/h " << error / h << '\n';
      EXPECT_LT(error, 0.02 * h);
    }
}

TEST(Increments, RefuseWhatIsNotFinite)
{
  auto lattice = sampled<2>(0.1, 1, [](const Point<2> &x) { return x.norm() - 0.5; });
  auto du      = vectors<2>(lattice, [](const Point<2> &) { return Tensor<1, 2>(); });
  du[1][7]     = std::numeric_limits<double>::quiet_NaN();
  deal_II_exceptions::disable_abort_on_exception();
  EXPECT_THROW(advect_increment<2>(lattice, du), ExceptionBase);
  EXPECT_THROW(advect_increment<2>(lattice, du, IncrementMotion::map_velocity), ExceptionBase);
  EXPECT_THROW(advect<2>(lattice, du, 1.), ExceptionBase);
}

// There and back on 128^2 spacings.
TEST(Vortex, ReversesADiscWithWeno5)
{
  const double h = 1. / 128, period = 2;
  auto         lattice = sampled<2>(h, 0.5, vortex_disc);
  const auto   field   = vectors(lattice, vortex);
  advect<2>(
    lattice,
    [&](const double t, NodalVectors<2> &v) {
      const double factor = std::cos(numbers::PI * t / period);
      for (unsigned int d = 0; d < 2; ++d)
        for (std::size_t i = 0; i < v[d].size(); ++i)
          v[d][i] = factor * field[d][i];
    },
    period);
  const Comparison end = compare(lattice, vortex_centre, 0.2, vortex_disc);
  std::cout << "area " << end.area << ", distance/h " << end.distance / h << '\n';
  EXPECT_LT(std::abs(end.area), 2e-4);
  EXPECT_LT(end.distance, h / 4);
}

// The same by semi-Lagrangian increments, whose du are the paths of the nodes over a step.
TEST(Vortex, ReversesADiscBySemiLagrangianIncrements)
{
  const double h = 1. / 128, period = 2;
  const int    n_steps = 20;
  auto         lattice = sampled<2>(h, 0.5, vortex_disc);
  for (int step = 0; step < n_steps; ++step)
    {
      // x' = v(x) g(t): the path is that of the steady vortex over the integral of g
      const auto primitive
        = [&](const int k) { return period / numbers::PI * std::sin(numbers::PI * k / n_steps); };
      const double duration = primitive(step + 1) - primitive(step);
      const auto   du       = vectors<2>(lattice, [&](const Point<2> &start) {
        Point<2> x = start;
        for (int part = 0; part < 4; ++part)
          {
            const double       dt = duration / 4;
            const Tensor<1, 2> a = vortex(x), b = vortex(x + 0.5 * dt * a),
                               c = vortex(x + 0.5 * dt * b), d = vortex(x + dt * c);
            x += dt / 6 * (a + 2. * b + 2. * c + d);
          }
        return x - start;
      });
      EXPECT_EQ(advect_increment<2>(lattice, du).n_unconverged, 0u);
    }
  const Comparison end = compare(lattice, vortex_centre, 0.2, vortex_disc);
  std::cout << "area " << end.area << ", distance/h " << end.distance / h << '\n';
  EXPECT_LT(std::abs(end.area), 2e-4);
  EXPECT_LT(end.distance, h / 4);
}

// One turn in 628 units of time on 100^2 spacings.
TEST(Zalesak, TurnsTheSlottedDiscOnce)
{
  auto                 lattice = sampled<2>(1., 50., slotted_disc);
  const auto           v       = vectors<2>(lattice, [](const Point<2> &x) {
    return 2 * numbers::PI / 628 * Tensor<1, 2>({-x[1], x[0]});
  });
  const AdvectionCount count   = advect<2>(lattice, v, 628.);

  const SlottedDiscError end = slotted_disc_error(lattice);
  std::cout << "area " << end.area << ", L1/perimeter " << end.L1 << ", steps " << count.n_steps
            << '\n';
  EXPECT_NEAR(end.exact_area, 582.2, 0.5);
  EXPECT_LT(std::abs(end.area), 0.005);
  EXPECT_LT(end.L1, 0.10);
}
} // namespace
} // namespace scree
