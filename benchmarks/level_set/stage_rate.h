// What the programs that measure rates share: a ball in a turning field, the rate of hj_stage().
#pragma once

#include <scree/level_set/advection.h>

#include <algorithm>
#include <ctime>
#include <vector>

namespace
{
using namespace dealii;
using namespace scree;

// Half width of the bands, in spacings.
constexpr double half_width = 10;

// The lowest CPU time of one call of f in seconds, over about half a second, each after a call of
// `prepare` that does not count.
template <typename P, typename F>
double
fastest(const P &prepare, const F &f)
{
  const auto   now   = []() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double begin = now();
  double       best  = 1e300;
  while (now() - begin < 0.5)
    {
      prepare();
      const double start = now();
      f();
      best = std::min(best, now() - start);
    }
  return best;
}

template <typename F>
double
fastest(const F &f)
{
  return fastest([]() {}, f);
}

// A ball of radius 0.3 in [-1/2, 1/2]^dim with n nodes per direction.
template <int dim>
Lattice<dim>
ball(const int n)
{
  LatticeFrame<dim> frame;
  frame.spacing = 1. / (n - 1);
  for (unsigned int d = 0; d < dim; ++d)
    frame.origin[d] = -0.5;
  std::array<int, dim> count;
  count.fill(n);
  Lattice<dim> lattice(frame, {}, count);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = (lattice.node(lattice.index(i)) - Point<dim>()).norm() - 0.3;
  return lattice;
}

// A turning field at its nodes.
template <int dim>
NodalVectors<dim>
turning(const Lattice<dim> &lattice, const double factor)
{
  NodalVectors<dim> result;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Point<dim> x = lattice.node(lattice.index(i));
      result[0].push_back(-factor * x[1]);
      result[1].push_back(factor * x[0]);
      if (dim == 3)
        result[dim - 1].push_back(0.3 * factor * x[0]);
    }
  return result;
}

// Million nodes times stages per second of three stages at the nodes of a set.
template <int dim>
double
stage_rate(const Lattice<dim> &lattice, const NodeSet<dim> &nodes, const Upwinding upwinding)
{
  const NodalVectors<dim> everywhere = turning(lattice, 1.);
  NodalVectors<dim>       velocity;
  for (unsigned int d = 0; d < dim; ++d)
    nodes.pack(everywhere[d], velocity[d]);
  std::vector<double> phi(nodes.grid.size()), phi_1, phi_2;
  nodes.load(lattice.values(), phi.data());
  phi_1 = phi_2 = phi;
  const auto stage
    = [&](const double weight, const std::vector<double> &from, std::vector<double> &to) {
        hj_stage<dim>(nodes, upwinding, velocity, {weight, 0.25 * lattice.spacing()},
                      {{from.data(), phi.data()}}, to.data());
      };
  const double time = fastest([&]() {
    stage(0., phi, phi_1);
    stage(0.75, phi_1, phi_2);
    stage(1. / 3., phi_2, phi);
  });
  return 3e-6 * nodes.n_nodes / time;
}
} // namespace
