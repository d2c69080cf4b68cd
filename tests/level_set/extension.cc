#include <gtest/gtest.h>

#include <scree/level_set/extension.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
using Values = std::array<std::vector<double>, dim>;

// A ball of radius 0.53 on [-1, 1]^dim with values up to 1.5 spacings outside.
template <int dim>
struct Ball
{
  explicit Ball(const int n)
      : h(2. / n)
      , phi(make(n))
      , known(phi.values().size())
  {
    for (std::size_t i = 0; i < known.size(); ++i)
      {
        phi.values()[i] = node(i).norm() - radius;
        known[i]        = phi.values()[i] < 1.5 * h;
      }
  }

  static Lattice<dim> make(const int n)
  {
    LatticeFrame<dim> frame;
    frame.spacing = 2. / n;
    std::array<int, dim> lower, count;
    lower.fill(-n / 2);
    count.fill(n + 1);
    return Lattice<dim>(frame, lower, count);
  }

  Point<dim> node(const std::size_t i) const
  {
    return phi.node(phi.index(i));
  }

  // All components equal f + component, extended.
  template <typename F>
  Values<dim> extended(const F &f, const Extrapolation extrapolation) const
  {
    Values<dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      for (std::size_t i = 0; i < known.size(); ++i)
        v[d].push_back(known[i] ? f(node(i)) + d : std::numeric_limits<double>::quiet_NaN());
    const ExtensionCount count = extend(phi, known, {extrapolation}, v);
    EXPECT_EQ(count.n_upstream, 0u);
    return v;
  }

  // The largest error of component 1 less 1 at unknown nodes up to a distance from the contour.
  template <typename F>
  double error(const Values<dim> &v, const F &exact, const double distance) const
  {
    double result = 0;
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!known[i] && phi.values()[i] < distance)
        {
          const double difference = std::abs(v[1][i] - 1 - exact(node(i)));
          result                  = difference <= result ? result : difference; // NaN stays
        }
    return result;
  }

  static constexpr double radius = 0.53;
  double                  h;
  Lattice<dim>            phi;
  std::vector<char>       known;
};

template <int dim>
double
wave(const Point<dim> &x)
{
  return std::sin(2 * x[0]) + std::cos(1.5 * x[1] + x[dim - 1]);
}

template <int dim>
void
check_constant(const int n)
{
  // constant along radii outside; inside the values do not matter near the centre
  const auto on_contour = [](const Point<dim> &x) {
    return wave<dim>(Point<dim>(x * (Ball<dim>::radius / std::max(x.norm(), 0.1))));
  };
  std::array<double, 2> errors;
  for (const int level : {0, 1})
    {
      const Ball<dim> ball(n << level);
      errors[level]
        = ball.error(ball.extended(on_contour, Extrapolation::constant), on_contour, 0.4);
    }
  std::cout << dim << "D constant: errors " << errors[0] << ' ' << errors[1] << ", order "
            << std::log2(errors[0] / errors[1]) << '\n';
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.65);
  EXPECT_LT(errors[1], 2e-3);
}

TEST(Extension, ConstantAlongNormalsIsOfSecondOrder)
{
  check_constant<2>(100);
  check_constant<3>(40);
}

template <int dim>
void
check_linear(const int n)
{
  std::array<double, 2> errors;
  for (const int level : {0, 1})
    {
      const Ball<dim> ball(n << level);
      errors[level]
        = ball.error(ball.extended(wave<dim>, Extrapolation::linear), wave<dim>, 6 * ball.h);
    }
  std::cout << dim << "D linear: errors within 6 h " << errors[0] << ' ' << errors[1] << ", order "
            << std::log2(errors[0] / errors[1]) << '\n';
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

TEST(Extension, LinearIsOfSecondOrderNearTheBody)
{
  check_linear<2>(100);
  check_linear<3>(40);
}

template <int dim>
void
check_affine(const int n)
{
  const Ball<dim> ball(n);
  const auto      affine = [](const Point<dim> &x) { return 1 + 2 * x[0] - 3 * x[dim - 1]; };
  EXPECT_LT(ball.error(ball.extended(affine, Extrapolation::linear), affine, 10), 1e-12);
  const auto one = [](const Point<dim> &) { return 1.; };
  EXPECT_LT(ball.error(ball.extended(one, Extrapolation::constant), one, 10), 1e-13);
}

TEST(Extension, AffineFieldsAreContinuedExactly)
{
  check_affine<2>(50);
  check_affine<3>(40);
}

// An ellipse, whose level set is no distance: phi gives directions only.
TEST(Extension, ConstantFollowsTheGradientOfAnyLevelSet)
{
  std::array<double, 2> errors;
  for (const int level : {0, 1})
    {
      Ball<2> ball(100 << level);
      for (std::size_t i = 0; i < ball.known.size(); ++i)
        {
          const Point<2> x     = ball.node(i);
          ball.phi.values()[i] = std::hypot(x[0] / 0.7, x[1] / 0.4) - 1;
          ball.known[i]        = ball.phi.values()[i] < 3 * ball.h;
        }
      // along the paths of grad phi, x^(a^2) / y^(b^2) is constant; so is its angle
      const auto v = [](const Point<2> &x) {
        return std::atan2(std::pow(std::abs(x[1]), 0.16), std::pow(std::abs(x[0]), 0.49));
      };
      const auto extended = ball.extended(v, Extrapolation::constant);
      errors[level]       = 0;
      for (std::size_t i = 0; i < ball.known.size(); ++i)
        {
          const Point<2> x = ball.node(i); // where v is smooth
          if (!ball.known[i] && ball.phi.values()[i] < 0.3
              && std::min(std::abs(x[0]), std::abs(x[1])) > 0.15)
            errors[level] = std::max(errors[level], std::abs(extended[0][i] - v(x)));
        }
    }
  std::cout << "ellipse: errors " << errors[0] << ' ' << errors[1] << ", order "
            << std::log2(errors[0] / errors[1]) << '\n';
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.6);
}

// A local minimum of |phi| away from the values: reached from its neighbours afterwards.
TEST(Extension, ReachesNodesBehindAMinimum)
{
  Ball<2>           ball(40);
  const std::size_t at = ball.phi.offset({{15, 15}});
  ball.phi.values()[at] *= 0.1;
  Values<2> v;
  for (auto &component : v)
    component.assign(ball.known.size(), 2.);
  const ExtensionCount count = extend(ball.phi, ball.known, {Extrapolation::constant}, v);
  EXPECT_EQ(count.n_upstream, 1u);
  for (const double value : v[0])
    EXPECT_NEAR(value, 2, 1e-14);
}

TEST(Extension, NeedsValues)
{
  const Ball<2> ball(20);
  Values<2>     v;
  for (auto &component : v)
    component.assign(ball.known.size(), 0.);
  deal_II_exceptions::disable_abort_on_exception();
  EXPECT_THROW(extend(ball.phi, std::vector<char>(ball.known.size(), 0), {}, v), ExceptionBase);
}

template <int dim>
void
print_rate(const int n)
{
  const Ball<dim> ball(n);
  for (const auto extrapolation : {Extrapolation::constant, Extrapolation::linear})
    {
      Values<dim> v;
      for (auto &component : v)
        component.assign(ball.known.size(), 1.);
      const std::clock_t   start = std::clock();
      const ExtensionCount count = extend(ball.phi, ball.known, {extrapolation}, v);
      const double         time  = double(std::clock() - start) / CLOCKS_PER_SEC;
      std::cout << dim << "D " << (extrapolation == Extrapolation::linear ? "linear" : "constant")
                << ": " << count.n_extended / time * 1e-6 << " million nodes with " << dim
                << " components per second\n";
      EXPECT_EQ(count.n_extended,
                std::size_t(std::count(ball.known.begin(), ball.known.end(), char(0))));
    }
}

TEST(ReleaseExtension, Rate)
{
  print_rate<2>(400);
  print_rate<3>(80);
}

// Gradients of fits: affine fields stay exact, what a jagged part adds stays of its size.
TEST(Extension, FittedGradientsAreNotJagged)
{
  const double h      = 0.05;
  const auto   phi    = sampled<2>(h, 1, [](const Point<2> &x) { return x.norm() - 0.5; });
  const auto   affine = [](const Point<2> &x) { return 1. + 0.3 * x[0] - 0.7 * x[1]; };
  const auto   jagged = [&](const std::size_t i) {
    const auto index = phi.index(i);
    return (index[0] + index[1]) % 2 == 0 ? 0.01 : -0.01;
  };
  std::vector<char> known;
  for (const double value : phi.values())
    known.push_back(value < 1.5 * h);
  const auto largest_error = [&](const int fit, const bool is_jagged) {
    std::array<std::vector<double>, 1> v;
    for (std::size_t i = 0; i < known.size(); ++i)
      v[0].push_back(affine(phi.node(phi.index(i))) + (is_jagged ? jagged(i) : 0.));
    ExtensionOptions options;
    options.fit = fit;
    extend(phi, known, options, v);
    double largest = 0;
    for (std::size_t i = 0; i < known.size(); ++i)
      largest = std::max(largest, std::abs(v[0][i] - affine(phi.node(phi.index(i)))));
    return largest;
  };
  EXPECT_LT(largest_error(2, false), 1e-12);
  std::cout << "jagged by 0.01: " << largest_error(0, true) << ", with fits "
            << largest_error(2, true) << '\n';
  EXPECT_LT(largest_error(2, true), 0.06);
}
} // namespace
} // namespace scree
