#include <gtest/gtest.h>

#include <scree/level_set/advection.h>

#include <cmath>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim, typename F>
double
error(const Lattice<dim> &lattice, const F &exact)
{
  double result = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    result
      = std::max(result, std::abs(lattice.values()[i] - exact(lattice.node(lattice.index(i)))));
  return result;
}

template <int dim>
Tensor<1, dim>
spin(const Point<dim> &x)
{
  Tensor<1, dim> v;
  v[0] = -x[1];
  v[1] = x[0];
  return v;
}

// L(phi) from one Euler stage, at the nodes away from the ends.
template <int dim, typename F, typename V>
Lattice<dim>
right_hand_side(const int n, const Upwinding upwinding, const F &phi, const V &velocity)
{
  auto                lattice = sampled<dim>(1. / n, 1, phi);
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const NodeSet<dim>  nodes = all_nodes(grid);
  std::vector<double> from(grid.size()), to(grid.size()), moved(lattice.values().size());
  nodes.load(lattice.values(), from.data());
  hj_stage<dim>(nodes, upwinding, vectors<dim>(lattice, velocity), {0., 1.},
                {{from.data(), from.data()}}, to.data());
  nodes.store(to.data(), moved);
  for (std::size_t i = 0; i < moved.size(); ++i)
    lattice.values()[i] = moved[i] - lattice.values()[i];
  return lattice;
}

template <int dim>
double
wave(const Point<dim> &x)
{
  double result = std::sin(2 * x[0] + 0.3) + std::cos(3 * x[1]) * x[0];
  if (dim == 3)
    result += std::sin(2 * x[dim - 1]) * x[1];
  return result;
}

template <int dim>
Tensor<1, dim>
wave_gradient(const Point<dim> &x)
{
  Tensor<1, dim> g;
  g[0] = 2 * std::cos(2 * x[0] + 0.3) + std::cos(3 * x[1]);
  g[1] = -3 * std::sin(3 * x[1]) * x[0];
  if (dim == 3)
    {
      g[1] += std::sin(2 * x[dim - 1]);
      g[dim - 1] = 2 * std::cos(2 * x[dim - 1]) * x[1];
    }
  return g;
}

// Velocities of every sign pattern.
template <int dim>
Tensor<1, dim>
swirl(const Point<dim> &x)
{
  Tensor<1, dim> v;
  for (unsigned int d = 0; d < dim; ++d)
    v[d] = std::sin(4 * x[(d + 1) % dim] + d) - 0.2;
  return v;
}

template <int dim>
double
gradient_error(const int n, const Upwinding upwinding)
{
  const auto rate   = right_hand_side<dim>(n, upwinding, wave<dim>, swirl<dim>);
  double     sum    = 0;
  int        inside = 0;
  for (std::size_t i = 0; i < rate.values().size(); ++i)
    {
      const Point<dim> x = rate.node(rate.index(i));
      double           r = 0;
      for (unsigned int d = 0; d < dim; ++d)
        r = std::max(r, std::abs(x[d]));
      if (r > 0.75)
        continue;
      sum += std::abs(rate.values()[i] + swirl(x) * wave_gradient(x));
      ++inside;
    }
  return sum / inside;
}

TEST(HjWeno5, GradientsHaveTheirOrder)
{
  const double weno
    = std::log2(gradient_error<2>(20, Upwinding::weno5) / gradient_error<2>(40, Upwinding::weno5)),
    weno_3d
    = std::log2(gradient_error<3>(12, Upwinding::weno5) / gradient_error<3>(24, Upwinding::weno5)),
    first = std::log2(gradient_error<2>(40, Upwinding::first_order)
                      / gradient_error<2>(80, Upwinding::first_order));
  std::cout << "orders: WENO5 " << weno << " (2D), " << weno_3d << " (3D), first order " << first
            << '\n';
  EXPECT_GT(weno, 4.7);
  EXPECT_GT(weno_3d, 4.5);
  EXPECT_NEAR(first, 1, 0.1);
  EXPECT_NEAR(std::log2(gradient_error<3>(20, Upwinding::first_order)
                        / gradient_error<3>(40, Upwinding::first_order)),
              1, 0.1);
}

// The published formula (Jiang & Peng 2000; Osher & Fedkiw 2003, equations 3.25 to 3.41) with
// upwinded substencils, term by term.
double
published_derivative(const std::array<double, 7> &phi, const bool from_left)
{
  std::array<double, 5> v;
  for (int k = 0; k < 5; ++k)
    v[k] = from_left ? phi[k + 1] - phi[k] : phi[6 - k] - phi[5 - k];
  const auto [a, b, c, d, e] = v;
  const auto sq              = [](const double x) { return x * x; };
  // 12 S_k, as Jiang & Peng scale them against epsilon
  const double s0 = 13 * sq(a - 2 * b + c) + 3 * sq(a - 4 * b + 3 * c),
               s1 = 13 * sq(b - 2 * c + d) + 3 * sq(b - d),
               s2 = 13 * sq(c - 2 * d + e) + 3 * sq(3 * c - 4 * d + e);
  const double w0 = 1 / sq(0.1 + s0), w1 = 6 / sq(0.1 + s1), w2 = 3 / sq(0.1 + s2);
  return (w0 * (2 * a - 7 * b + 11 * c) + w1 * (-b + 5 * c + 2 * d) + w2 * (2 * c + 5 * d - e))
         / (6 * (w0 + w1 + w2));
}

TEST(HjWeno5, EqualsThePublishedFormulaOnRoughData)
{
  const auto rough = [](const double i) { return std::sin(12.3 * i * i) + std::abs(i - 0.2); };
  const auto rate  = [&](const double v) {
    HaloGrid<2>         grid{{{9, 4}}, 1.};
    std::vector<double> values(36), from(grid.size()), to(grid.size());
    for (int i = 0; i < 36; ++i)
      values[i] = rough(i % 9);
    const NodeSet<2> nodes = all_nodes(grid);
    nodes.load(values, from.data());
    std::array<std::vector<double>, 2> velocity;
    velocity[0].assign(36, v);
    velocity[1].assign(36, 0.);
    hj_stage<2>(nodes, Upwinding::weno5, velocity, {0., 1.}, {{from.data(), from.data()}},
                to.data());
    return values[13] - to[grid.first() + 4 + grid.stride(1)];
  };
  std::array<double, 7> stencil;
  for (int k = 0; k < 7; ++k)
    stencil[k] = rough(k + 1);
  EXPECT_NEAR(rate(1.7), 1.7 * published_derivative(stencil, true), 1e-12);
  EXPECT_NEAR(rate(-0.6), -0.6 * published_derivative(stencil, false), 1e-12);
  EXPECT_GT(std::abs(published_derivative(stencil, true) - published_derivative(stencil, false)),
            0.1);
}

// A smooth bump in a turning field, a quarter turn; dt ~ h^(5/3), so that RK3 does not show.
double
bump_error(const int n)
{
  const auto bump
    = [](const Point<2> &x) { return std::exp(-25 * (x - Point<2>(0.35, 0.1)).norm_square()); };
  auto            lattice = sampled<2>(1. / n, 1, bump);
  AdvectionScheme scheme;
  scheme.cfl = 0.5 * std::pow(20. / n, 2. / 3.);
  advect<2>(lattice, vectors<2>(lattice, spin<2>), numbers::PI / 2, scheme);
  // the disc that never leaves the lattice
  double result = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Point<2> x = lattice.node(lattice.index(i));
      if (x.norm() < 0.9)
        result
          = std::max(result, std::abs(lattice.values()[i] - bump(turned(x, -numbers::PI / 2))));
    }
  return result;
}

TEST(HjWeno5, AdvectsASmoothBumpWithOrderFive)
{
  const double coarse = bump_error(45), fine = bump_error(90);
  std::cout << "errors " << coarse << ' ' << fine << ", order " << std::log2(coarse / fine) << '\n';
  EXPECT_GT(std::log2(coarse / fine), 4.5);
  EXPECT_LT(fine, 4e-5);
}

// Linear phi stays linear in a turning field and all space operators are exact for it: what
// remains is the error in time, with a rate of turning that depends on time.
template <int dim>
double
time_error(const unsigned int order, const double cfl)
{
  const auto      slope   = [](const Point<dim> &x) { return 0.7 * x[0] - 0.4 * x[1] + 0.1; };
  auto            lattice = sampled<dim>(0.25, 1, slope);
  const auto      field   = vectors<dim>(lattice, spin<dim>);
  AdvectionScheme scheme;
  scheme.time_order = order;
  scheme.cfl        = cfl;
  advect<dim>(
    lattice,
    [&](const double t, NodalVectors<dim> &v) {
      v = field;
      for (auto &component : v)
        for (double &value : component)
          value *= std::exp(-t);
    },
    1., scheme);
  const double angle = 1 - std::exp(-1.);
  return error(lattice, [&](const Point<dim> &x) { return slope(turned(x, -angle)); });
}

TEST(TvdRungeKutta, HasItsOrderInTime)
{
  for (const unsigned int order : {1, 2, 3})
    {
      const double coarse = time_error<2>(order, 0.1), fine = time_error<2>(order, 0.025);
      std::cout << "order " << order << ": " << std::log2(coarse / fine) / 2 << ", errors "
                << coarse << ' ' << fine << '\n';
      EXPECT_NEAR(std::log2(coarse / fine) / 2, order, 0.1);
    }
  EXPECT_NEAR(std::log2(time_error<3>(3, 0.1) / time_error<3>(3, 0.025)) / 2, 3, 0.1);
}

TEST(TvdRungeKutta, KeepsTheCflBound)
{
  auto         lattice = sampled<2>(0.1, 1, wave<2>);
  const double speed   = 2; // |v_x| + |v_y| at the corners
  const auto   field   = vectors<2>(lattice, spin<2>);
  EXPECT_EQ(advect<2>(lattice, field, 1.).n_steps, std::ceil(speed / (0.5 * 0.1)));
  EXPECT_EQ(advect<2>(lattice, field, 0.).n_steps, 1u);
}
} // namespace
} // namespace scree
