// Rates on one thread, from the lowest CPU time of several runs: hj_stage() (HJ-WENO5, TVD-RK3)
// beside a hand-written fused kernel for this machine alone as its limit, the same in a narrow
// band, the back-trace and the semi-Lagrangian update, distances, whole steps.

#include <scree/level_set/extension.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/map_velocity.h>
#include <scree/level_set/reinitialisation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "stage_rate.h"

// limit.cc: one Euler stage of n^dim inner points on an array of (n + 6)^dim points.
void limit_stage(int dim, int n, double dt_over_h, double epsilon,
                 const std::array<std::vector<double>, 3> &velocity, const double *phi,
                 double *out);

namespace
{
using namespace dealii;
using namespace scree;

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

// A load step as the mechanics will take it: du, known where phi < 0, is extended linearly, phi
// moves, and is reinitialised. The contour moves by one spacing.
template <int dim>
void
whole_step_row(const int n, const bool in_bands)
{
  const Lattice<dim> lattice = ball<dim>(n);
  NodalVectors<dim>  du      = turning(lattice, lattice.spacing() / 0.3);
  std::vector<char>  known;
  for (const double value : lattice.values())
    known.push_back(value < 0);
  AdvectionScheme         scheme;
  ExtensionOptions        extension;
  ReinitialisationOptions reinitialisation;
  scheme.band = half_width;
  if (in_bands)
    {
      extension.band        = half_width + 4;
      reinitialisation.band = half_width + 4;
    }
  const double extend_time  = fastest([&]() { extend<dim, dim>(lattice, known, extension, du); });
  Lattice<dim> moved        = lattice;
  const auto   start        = [&]() { moved.values() = lattice.values(); };
  std::size_t  n_nodes      = 0;
  const double advect_time  = fastest(start, [&]() {
    n_nodes = advect_increment<dim>(moved, du, IncrementMotion::semi_lagrangian, scheme).n_nodes;
  });
  const double watch_time   = fastest([&]() { reinitialise(moved, reinitialisation); });
  const double rebuild_time = fastest(
    [&]() {
      start();
      for (double &value : moved.values())
        value *= 1.2;
    },
    [&]() { reinitialise(moved, reinitialisation); });
  const double per_node = 1e9 / n_nodes;
  std::printf("| %d^%d | %s | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", n, dim,
              in_bands ? "bands" : "all nodes", per_node * extend_time, per_node * advect_time,
              per_node * watch_time, per_node * rebuild_time,
              per_node * (extend_time + advect_time + watch_time),
              per_node * (extend_time + advect_time + rebuild_time));
}

// Fast marching, reinitialisation and extension of all nodes.
template <int dim>
void
lattice_row(const int n)
{
  const Lattice<dim> lattice   = ball<dim>(n);
  Lattice<dim>       work      = lattice;
  const double       n_nodes   = lattice.values().size();
  const double       distances = fastest([&]() { compute_distances(work); });
  const double       rebuilt   = fastest(
    [&]() {
      for (std::size_t i = 0; i < work.values().size(); ++i)
        work.values()[i] = 1.2 * lattice.values()[i];
    },
    [&]() { reinitialise(work); });
  NodalVectors<dim> du = turning(lattice, 1.);
  std::vector<char> known;
  for (const double value : lattice.values())
    known.push_back(value < 0);
  const double n_extended  = std::count(known.begin(), known.end(), char(0));
  const auto   extend_rate = [&](const Extrapolation extrapolation) {
    return 1e-6 * n_extended
           / fastest([&]() { extend<dim, dim>(lattice, known, {extrapolation}, du); });
  };
  const double constant = extend_rate(Extrapolation::constant),
               linear   = extend_rate(Extrapolation::linear);
  std::printf("| %d^%d | %.1f | %.1f | %.1f | %.1f |\n", n, dim, 1e-6 * n_nodes / distances,
              1e-6 * n_nodes / rebuilt, constant, linear);
}

// A ball of 0.45 n spacings in n^3 nodes, dense or in tiles.
void
tile_row(const int n)
{
  LatticeFrame<3> frame;
  frame.spacing = 1. / n;
  const Lattice<3> tiled(frame, {{-n / 2, -n / 2, -n / 2}}, {{n, n, n}},
                         [](const Point<3> &x) { return x.norm() - 0.45; });
  const int        n_points = 300000;
  double           sum      = 0;
  const auto       evaluate = [&]() {
    for (int i = 0; i < n_points; ++i)
      {
        const double a = 2.4 * i, z = 2. * i / n_points - 1, r = std::sqrt(1 - z * z);
        sum += tiled.value(Point<3>(0.45 * r * std::cos(a), 0.45 * r * std::sin(a), 0.45 * z), 1);
      }
  };
  const double start = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  evaluate();
  const double first = static_cast<double>(std::clock()) / CLOCKS_PER_SEC - start,
               later = fastest(evaluate);
  std::printf("| %d^3 | %.0f | %.0f | %.1f | %.0f |\n", n, 8e-6 * std::pow(n, 3),
              8e-6 * tiled.values().size(), first, 1e9 * later / n_points + 0 * sum);
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

  std::puts("\nAll nodes, million nodes per second: signed distances by fast marching, "
            "reinitialisation of a ball whose slope is\n"
            "1.2 everywhere, extension of a vector from phi < 0 to the nodes with phi > 0.\n\n"
            "| lattice | distances | reinitialisation | extension, constant | extension, linear "
            "|\n|---|---|---|---|---|");
  for (const int n : {256, 1024})
    lattice_row<2>(n);
  for (const int n : {64, 128})
    lattice_row<3>(n);

  std::puts("\nA whole load step that turns the ball by one spacing at its contour, nanoseconds "
            "per node of the advected band:\n"
            "linear extension of the increment, semi-Lagrangian advection in its band of 10 "
            "spacings, reinitialisation where no slope\n"
            "is beyond the tolerance and where all are; their sums. Extension and "
            "reinitialisation of all nodes and in bands of\n14 spacings.\n\n"
            "| lattice | extension and reinitialisation | extension | advection | "
            "reinitialisation, not needed | needed | whole step | with reinitialisation "
            "|\n|---|---|---|---|---|---|---|---|");
  for (const bool in_bands : {false, true})
    {
      for (const int n : {256, 1024})
        whole_step_row<2>(n, in_bands);
      for (const int n : {64, 128})
        whole_step_row<3>(n, in_bands);
    }

  std::puts("\nA ball of 0.45 n spacings, stored densely and in tiles: megabytes, seconds of the "
            "first 300,000 evaluations\n"
            "(degree 1) on the contour, in which tiles come, nanoseconds per later one.\n\n"
            "| lattice | dense MB | tiles MB | s | ns |\n|---|---|---|---|---|");
  for (const int n : {200, 400, 800})
    tile_row(n);
}
