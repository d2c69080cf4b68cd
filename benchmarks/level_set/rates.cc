// Lattice points times stages per second of hj_stage() (HJ-WENO5, TVD-RK3), beside a hand-written
// fused kernel for this machine alone as its limit. One thread; best of several runs.

#include <scree/level_set/hj_weno5.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

// limit.cc: one Euler stage of n^dim inner points on an array of (n + 6)^dim points.
void limit_stage(int dim, int n, double dt_over_h, double epsilon,
                 const std::array<std::vector<double>, 3> &velocity, const double *phi,
                 double *out);

namespace
{
using Clock = std::chrono::steady_clock;

// The lowest time of one call of f in seconds, over about half a second.
template <typename F>
double
fastest(const F &f)
{
  double     best  = 1e300;
  const auto begin = Clock::now();
  while (std::chrono::duration<double>(Clock::now() - begin).count() < 0.5)
    {
      const auto start = Clock::now();
      f();
      best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
    }
  return best;
}

// A ball in a turning field, values without halo.
template <int dim>
struct Problem
{
  Problem(int n);

  scree::HaloGrid<dim>                 grid;
  std::vector<double>                  phi;
  std::array<std::vector<double>, dim> velocity;
  double                               dt;
};

template <int dim>
Problem<dim>::Problem(const int n)
{
  grid.n_nodes.fill(n);
  grid.spacing           = 1. / (n - 1);
  dt                     = 0.25 * grid.spacing;
  const std::size_t size = std::lround(std::pow(n, dim));
  phi.resize(size);
  for (auto &component : velocity)
    component.resize(size);
  for (std::size_t i = 0; i < size; ++i)
    {
      std::array<double, 3> x{};
      std::size_t           rest = i;
      for (int d = 0; d < dim; ++d, rest /= n)
        x[d] = (rest % n) * grid.spacing - 0.5;
      phi[i]         = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 0.3;
      velocity[0][i] = -x[1];
      velocity[1][i] = x[0];
      if (dim == 3)
        velocity[dim - 1][i] = 0.3 * x[0];
    }
}

template <int dim>
void
measure(const int n)
{
  const Problem<dim> problem(n);
  const auto        &grid = problem.grid;
  const auto         stage
    = [&](const scree::Upwinding upwinding, const double weight, const std::vector<double> &from,
          const std::vector<double> &start, std::vector<double> &to) {
        scree::hj_stage<dim>(grid, upwinding, problem.velocity, {weight, problem.dt},
                             {{&from, &start}}, to);
      };
  const auto rate = [&](const scree::Upwinding upwinding) {
    std::vector<double> phi = grid.with_halo(problem.phi), phi_1 = phi, phi_2 = phi;
    const double        time = fastest([&]() {
      stage(upwinding, 0., phi, phi, phi_1);
      stage(upwinding, 0.75, phi_1, phi, phi_2);
      stage(upwinding, 1. / 3., phi_2, phi, phi);
    });
    return 3e-6 * problem.phi.size() / time;
  };
  const double weno = rate(scree::Upwinding::weno5), first = rate(scree::Upwinding::first_order);

  std::array<std::vector<double>, 3> velocity;
  std::copy(problem.velocity.begin(), problem.velocity.end(), velocity.begin());
  std::vector<double> phi = grid.with_halo(problem.phi), out = phi;
  const double        limit
    = 1e-6 * problem.phi.size() / fastest([&]() {
        limit_stage(dim, n, problem.dt / grid.spacing, 0.1 * grid.spacing * grid.spacing, velocity,
                    phi.data(), out.data());
      });
  std::printf("| %d^%d | %.0f | %.0f | %.0f | %.2f |\n", n, dim, first, weno, limit, weno / limit);
}
} // namespace

int
main()
{
  std::puts("| lattice | first order | WENO5 | limit | WENO5 / limit |\n|---|---|---|---|---|");
  for (const int n : {100, 256, 512, 1024})
    measure<2>(n);
  for (const int n : {64, 128, 192})
    measure<3>(n);
}
