// Rates on one thread, from the lowest CPU time of several runs: hj_stage() (HJ-WENO5, TVD-RK3)
// beside a hand-written fused kernel for this machine alone as its limit, the same in a narrow
// band, the back-trace and the semi-Lagrangian update, distances, whole steps.

#include <scree/level_set/advection.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/map_velocity.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

// limit.cc: one Euler stage of n^dim inner points on an array of (n + 6)^dim points.
void limit_stage(int dim, int n, double dt_over_h, double epsilon,
                 const std::array<std::vector<double>, 3> &velocity, const double *phi,
                 double *out);

namespace
{
using namespace dealii;
using namespace scree;

// The lowest CPU time of one call of f in seconds, over about half a second.
template <typename F>
double
fastest(const F &f)
{
  const auto   now   = []() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double begin = now();
  double       best  = 1e300;
  while (now() - begin < 0.5)
    {
      const double start = now();
      f();
      best = std::min(best, now() - start);
    }
  return best;
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

template <int dim>
double
limit_rate(const Lattice<dim> &lattice, const int n)
{
  const HaloGrid<dim>                grid{lattice.n_nodes(), lattice.spacing()};
  const NodalVectors<dim>            v = turning(lattice, 1.);
  std::array<std::vector<double>, 3> velocity;
  std::copy(v.begin(), v.end(), velocity.begin());
  std::vector<double> phi(grid.size());
  grid.load(lattice.values(), phi.data());
  std::vector<double> out  = phi;
  const double        time = fastest([&]() {
    limit_stage(dim, n, 0.25, 0.1 * grid.spacing * grid.spacing, velocity, phi.data(), out.data());
  });
  return 1e-6 * lattice.values().size() / time;
}

// Half width of the bands, in spacings.
constexpr double half_width = 10;

template <int dim>
void
kernel_row(const int n)
{
  const Lattice<dim>  lattice = ball<dim>(n);
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const NodeSet<dim>  all = all_nodes(grid),
                     band = nodes_near_contour(grid, lattice.values(), half_width * grid.spacing);
  const double first      = stage_rate(lattice, all, Upwinding::first_order),
               weno = stage_rate(lattice, all, Upwinding::weno5), limit = limit_rate(lattice, n),
               in_band = stage_rate(lattice, band, Upwinding::weno5);
  std::printf("| %d^%d | %.0f | %.0f | %.0f | %.2f | %.0f | %.0f |\n", n, dim, first, weno, limit,
              weno / limit, in_band, 1e-3 * band.n_nodes);
}

template <int dim>
void
increment_row(const int n)
{
  const Lattice<dim>  lattice = ball<dim>(n);
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const NodeSet<dim>  band = nodes_near_contour(grid, lattice.values(), half_width * grid.spacing);
  const NodalVectors<dim> du = turning(lattice, 0.05);
  NodalVectors<dim>       start, v;
  for (unsigned int d = 0; d < dim; ++d)
    band.pack(du[d], start[d]);
  std::vector<double> result;
  const double        back_trace = fastest([&]() {
    v = start;
    map_velocity<dim>(band, du, 1., v);
  });
  const double        again      = fastest([&]() { map_velocity<dim>(band, du, 0.99, v); });
  const double        values
    = fastest([&]() { values_at_departure<dim>(band, lattice.values(), v, result); });

  AdvectionScheme scheme;
  scheme.band           = half_width;
  const auto whole_step = [&](const IncrementMotion motion) {
    std::size_t  n_nodes = 0;
    const double time    = fastest([&]() {
      Lattice<dim> moved = lattice;
      n_nodes            = advect_increment<dim>(moved, du, motion, scheme).n_nodes;
    });
    return 1e9 * time / n_nodes;
  };
  std::printf("| %d^%d | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", n, dim,
              1e9 * back_trace / band.n_nodes, 1e9 * again / band.n_nodes,
              1e9 * values / band.n_nodes, whole_step(IncrementMotion::semi_lagrangian),
              whole_step(IncrementMotion::map_velocity),
              whole_step(IncrementMotion::frozen_velocity));
}

template <int dim>
void
distance_row(const int n)
{
  const Lattice<dim> lattice = ball<dim>(n);
  const double       time    = fastest([&]() {
    Lattice<dim> copy = lattice;
    compute_distances(copy);
  });
  std::printf("| %d^%d | %.1f |\n", n, dim, 1e-6 * lattice.values().size() / time);
}

// A ball of 0.45 n spacings in n^3 nodes, dense or in tiles.
void
tile_row(const int n)
{
  LatticeFrame<3> frame;
  frame.spacing          = 1. / n;
  const double     start = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  const Lattice<3> tiled(
    frame, {{-n / 2, -n / 2, -n / 2}}, {{n, n, n}},
    [](const Point<3> &x) { return x.norm() - 0.45; }, 8. / n);
  const double built    = static_cast<double>(std::clock()) / CLOCKS_PER_SEC - start;
  const int    n_points = 300000;
  double       sum      = 0;
  const double time     = fastest([&]() {
    for (int i = 0; i < n_points; ++i)
      {
        const double a = 2.4 * i, z = 2. * i / n_points - 1, r = std::sqrt(1 - z * z);
        sum += tiled.value(Point<3>(0.45 * r * std::cos(a), 0.45 * r * std::sin(a), 0.45 * z), 1);
      }
  });
  std::printf("| %d^3 | %.0f | %.0f | %.1f | %.0f |\n", n, 8e-6 * std::pow(n, 3),
              8e-6 * (tiled.values().size() + tiled.tiles().coarse().size()), built,
              1e9 * time / n_points + 0 * sum);
}
} // namespace

int
main()
{
  std::puts(
    "Million nodes times stages per second, all nodes and in a band of 10 spacings at each side\n"
    "of the contour.\n\n"
    "| lattice | first order | WENO5 | limit | WENO5 / limit | WENO5 in the band | thousand nodes "
    "of the band |\n"
    "|---|---|---|---|---|---|---|");
  for (const int n : {100, 256, 512, 1024})
    kernel_row<2>(n);
  for (const int n : {64, 128, 192})
    kernel_row<3>(n);

  std::puts("\nA load step that turns the ball by 0.05 (at most 0.0175 n spacings), nanoseconds "
            "per node of the band: the\n"
            "back-trace from du and from its last result, the values at the departure points, "
            "whole steps with\n"
            "everything (the map and the frozen velocity take as many steps of three stages as CFL "
            "0.5 asks for).\n\n"
            "| lattice | back-trace | again | values | semi-Lagrangian step | map velocity step | "
            "frozen velocity step |\n"
            "|---|---|---|---|---|---|---|");
  for (const int n : {256, 1024})
    increment_row<2>(n);
  for (const int n : {64, 128, 192})
    increment_row<3>(n);

  std::puts("\nSigned distances by fast marching, million nodes per second.\n\n| lattice | rate "
            "|\n|---|---|");
  for (const int n : {256, 1024})
    distance_row<2>(n);
  for (const int n : {64, 128})
    distance_row<3>(n);

  std::puts("\nA ball of 0.45 n spacings, stored densely and in tiles: megabytes, seconds to build "
            "the tiles, nanoseconds\n"
            "per evaluation (degree 1) on the contour.\n\n"
            "| lattice | dense MB | tiles MB | s | ns |\n|---|---|---|---|---|");
  for (const int n : {200, 400, 800})
    tile_row(n);
}
