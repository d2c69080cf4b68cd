// Level sets that are moved through deformations with a known end: Zalesak's disc, the vortex that
// reverses (2D), Enright's deformation of a ball (3D), shear and rotation by load steps. Prints
// tables; with a folder as second argument the final values of the plane cases are written there.
//
// usage: motions plane|enright [folder]

#include <scree/level_set/advection.h>
#include <scree/level_set/closest_point.h>
#include <scree/level_set/reinitialisation.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace dealii;
using namespace scree;

// CPU time: other work on the machine does not count.
double
seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// [-size, size]^dim with n spacings per direction.
template <int dim, typename F>
Lattice<dim>
sampled(const int n, const double size, const F &f)
{
  LatticeFrame<dim> frame;
  frame.spacing = 2 * size / n;
  std::array<int, dim> lower, count;
  lower.fill(-n / 2);
  count.fill(n + 1);
  Lattice<dim> lattice(frame, lower, count);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = f(lattice.node(lattice.index(i)));
  return lattice;
}

template <int dim, typename F>
NodalVectors<dim>
vectors(const Lattice<dim> &lattice, const F &f)
{
  NodalVectors<dim> result;
  for (auto &component : result)
    component.resize(lattice.values().size());
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Tensor<1, dim> v = f(lattice.node(lattice.index(i)));
      for (unsigned int d = 0; d < dim; ++d)
        result[d][i] = v[d];
    }
  return result;
}

// The volume where the cubic interpolant is negative, by 4^dim samples per spacing of a step that
// is smoothed over their distance, near the contour.
template <int dim>
double
volume(const Lattice<dim> &lattice)
{
  const double h = lattice.spacing(), part = h / 4;
  double       sum = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const auto index = lattice.index(i);
      bool       last  = false;
      for (unsigned int d = 0; d < dim; ++d)
        last |= index[d] + 1 == lattice.lower()[d] + lattice.n_nodes()[d];
      if (last || lattice.values()[i] > 3 * h)
        continue;
      if (lattice.values()[i] < -3 * h)
        {
          sum += 1;
          continue;
        }
      for (int k = 0; k < (1 << (2 * dim)); ++k)
        {
          Point<dim> x = lattice.node(index);
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += part * (((k >> (2 * d)) & 3) + 0.5);
          sum += std::clamp(0.5 - lattice.value(x, 3) / part, 0., 1.) / (1 << (2 * dim));
        }
    }
  return sum * std::pow(h, dim);
}

// Where the contour crosses the lattice lines (cubic interpolant).
template <int dim>
std::vector<Point<dim>>
contour_points(const Lattice<dim> &lattice)
{
  std::vector<Point<dim>> result;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      {
        auto next = lattice.index(i);
        ++next[d];
        if (!lattice.contains(next) || (lattice.values()[i] < 0) == (lattice(next) < 0))
          continue;
        Point<dim> a = lattice.node(lattice.index(i)), b = lattice.node(next);
        if (lattice.values()[i] > 0)
          std::swap(a, b);
        for (int k = 0; k < 40; ++k)
          {
            const Point<dim> middle                = a + 0.5 * (b - a);
            (lattice.value(middle, 3) < 0 ? a : b) = middle;
          }
        result.push_back(a);
      }
  return result;
}

// A shape with a known distance and points all over its contour.
template <int dim>
struct Exact
{
  std::function<double(const Point<dim> &)> distance;
  std::vector<Point<dim>>                   points;
};

// The Hausdorff distance: the largest one from the contour to the exact one and back. Back, the
// nearest crossing of a lattice line is where the closest point is looked for.
template <int dim>
double
hausdorff(const Lattice<dim> &lattice, const Exact<dim> &exact)
{
  const auto contour = contour_points(lattice);
  if (contour.empty())
    return std::numeric_limits<double>::infinity();
  double result = 0;
  for (const Point<dim> &x : contour)
    result = std::max(result, std::abs(exact.distance(x)));
  for (const Point<dim> &x : exact.points)
    {
      const auto closer = [&](const Point<dim> &a, const Point<dim> &b) {
        return x.distance_square(a) < x.distance_square(b);
      };
      const Point<dim>        start    = *std::min_element(contour.begin(), contour.end(), closer);
      const ClosestPoint<dim> foot     = closest_point(lattice, x, 3, start);
      double                  distance = x.distance(start);
      if (foot.converged)
        distance = std::min(distance, x.distance(foot.point));
      result = std::max(result, distance);
    }
  return result;
}

template <int dim>
Exact<dim>
exact_ball(const Point<dim> &centre, const double radius)
{
  Exact<dim> result;
  result.distance        = [=](const Point<dim> &x) { return (x - centre).norm() - radius; };
  const int    n         = dim == 2 ? 1000 : 4000;
  const double increment = dim == 2 ? 2 * numbers::PI / n : numbers::PI * (3 - std::sqrt(5.));
  for (int i = 0; i < n; ++i)
    {
      Point<dim>   x;
      const double z = dim == 2 ? 0 : (2. * i + 1) / n - 1, r = std::sqrt(1 - z * z);
      x[0]       = r * std::cos(increment * i);
      x[1]       = r * std::sin(increment * i);
      x[dim - 1] = dim == 2 ? x[1] : z;
      result.points.push_back(centre + radius * x);
    }
  return result;
}

// How a motion is computed: WENO5 or semi-Lagrangian, and the reinitialisations on the way.
struct Way
{
  bool semi_lagrangian;
  int  n_reinitialisations;

  std::string name() const
  {
    return std::string(semi_lagrangian ? "semi-Lagrangian" : "WENO5") + ", "
           + (n_reinitialisations == 0 ? "none" : std::to_string(n_reinitialisations));
  }
};

// A motion from 0 to `period`.
template <int dim>
struct Motion
{
  double                                                            period;
  int                                                               n_increments;
  std::function<void(double, NodalVectors<dim> &)>                  velocity; // at a time
  std::function<Tensor<1, dim>(const Point<dim> &, double, double)> path; // of x between two times
};

template <int dim>
void
run(Lattice<dim> &lattice, const Motion<dim> &motion, const Way &way)
{
  const int n_parts = std::max(1, way.n_reinitialisations);
  for (int part = 0; part < n_parts; ++part)
    {
      const double begin = motion.period * part / n_parts, length = motion.period / n_parts;
      if (way.semi_lagrangian)
        {
          const int n = motion.n_increments / n_parts;
          for (int i = 0; i < n; ++i)
            {
              const double from = begin + length * i / n, to = begin + length * (i + 1) / n;
              advect_increment<dim>(lattice, vectors<dim>(lattice, [&](const Point<dim> &x) {
                                      return motion.path(x, from, to);
                                    }));
            }
        }
      else
        advect<dim>(
          lattice, [&](const double t, NodalVectors<dim> &v) { motion.velocity(begin + t, v); },
          length);
      if (way.n_reinitialisations > 0)
        reinitialise(lattice);
    }
}

// The path in a steady field times a factor g(t): that of the steady field for a time `duration`,
// the integral of g.
template <int dim, typename F>
Tensor<1, dim>
steady_path(const F &field, const Point<dim> &start, const double duration)
{
  Point<dim> x = start;
  for (int part = 0; part < 2; ++part)
    {
      const double         dt = duration / 2;
      const Tensor<1, dim> a = field(x), b = field(x + 0.5 * dt * a), c = field(x + 0.5 * dt * b),
                           d = field(x + dt * c);
      x += dt / 6 * (a + 2. * b + 2. * c + d);
    }
  return x - start;
}

// A field times cos(pi t / T).
template <int dim, typename F>
Motion<dim>
reversing(const Lattice<dim> &lattice, const F &field, const double period, const int n_increments)
{
  const auto at_nodes = vectors<dim>(lattice, field);
  return {period, n_increments,
          [=](const double t, NodalVectors<dim> &v) {
            const double factor = std::cos(numbers::PI * t / period);
            for (unsigned int d = 0; d < dim; ++d)
              for (std::size_t i = 0; i < v[d].size(); ++i)
                v[d][i] = factor * at_nodes[d][i];
          },
          [=](const Point<dim> &x, const double from, const double to) {
            const double duration
              = period / numbers::PI
                * (std::sin(numbers::PI * to / period) - std::sin(numbers::PI * from / period));
            return steady_path<dim>(field, x, duration);
          }};
}

void
save(const std::string &folder, const std::string &name, const Lattice<2> &lattice)
{
  if (folder.empty())
    return;
  std::ofstream file(folder + "/" + name + ".txt");
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    file << lattice.values()[i] << ((i + 1) % lattice.n_nodes()[0] == 0 ? '\n' : ' ');
}

// LeVeque's vortex (SIAM J. Numer. Anal. 33, 1996) in the box [-1/2, 1/2]^2.
Tensor<1, 2>
vortex(const Point<2> &x)
{
  const double s = std::cos(numbers::PI * x[0]), t = std::cos(numbers::PI * x[1]);
  return Tensor<1, 2>(
    {s * s * std::sin(2 * numbers::PI * x[1]), -t * t * std::sin(2 * numbers::PI * x[0])});
}

void
vortex_table(const std::string &folder)
{
  std::puts("\nVortex reversal on 128^2 spacings, distance two-sided (Hausdorff).\n\n"
            "| T | way, reinitialisations | area % | distance / h | s |\n|---|---|---|---|---|");
  const Exact<2> disc = exact_ball(Point<2>(0, 0.25), 0.15);
  for (const int period : {2, 4, 8})
    for (const Way way :
         {Way{false, 0}, Way{false, 5 * period}, Way{true, 0}, Way{true, 5 * period}})
      {
        auto         lattice = sampled<2>(128, 0.5, disc.distance);
        const double before = volume(lattice), start = seconds();
        run(lattice, reversing(lattice, vortex, period, 10 * period), way);
        const double time = seconds() - start;
        std::printf("| %d | %s | %.3f | %.3f | %.2f |\n", period, way.name().c_str(),
                    100 * (volume(lattice) / before - 1), 128 * hausdorff(lattice, disc), time);
        std::fflush(stdout);
        if (period == 8)
          save(folder,
               "vortex_" + std::to_string(way.semi_lagrangian)
                 + (way.n_reinitialisations > 0 ? "r" : ""),
               lattice);
      }
}

double
distance_to_segment(const Point<2> &x, const Point<2> &a, const Point<2> &b)
{
  const double t = std::clamp((x - a) * (b - a) / (b - a).norm_square(), 0., 1.);
  return (x - a - t * (b - a)).norm();
}

// The slotted disc of Zalesak (J. Comput. Phys. 31, 1979): radius 15 about (0, 25), slot of width 5
// and length 25 from below.
double
slotted_disc(const Point<2> &x)
{
  const Point<2> centre(0, 25);
  const double   end = 25 - std::sqrt(15. * 15 - 2.5 * 2.5), top = 35;
  const bool     inside = (x - centre).norm() < 15 && !(std::abs(x[0]) < 2.5 && x[1] < top);
  const Point<2> a(-2.5, end), b(-2.5, top), c(2.5, top), d(2.5, end);
  double         result = std::min(
            {distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, d)});
  const Tensor<1, 2> from = x - centre;
  if (!(std::abs(from[0]) < 2.5 * from.norm() / 15 && from[1] < 0))
    result = std::min(result, std::abs(from.norm() - 15));
  return inside ? -result : result;
}

struct Difference
{
  double area; // relative
  double l1;   // area between the contours over the perimeter
};

// By samples of the bilinear interpolant.
Difference
from_slotted_disc(const Lattice<2> &lattice)
{
  const int n    = 10; // samples per spacing
  double    area = 0, exact = 0, between = 0;
  for (int i = 0; i < 100 * n; ++i)
    for (int j = 0; j < 100 * n; ++j)
      {
        const Point<2> x(-50 + (i + 0.5) / n, -50 + (j + 0.5) / n);
        const bool     is = lattice.value(x, 1) < 0, was = slotted_disc(x) < 0;
        area += is;
        exact += was;
        between += is != was;
      }
  const double perimeter
    = 2 * (10 + std::sqrt(15. * 15 - 2.5 * 2.5)) + 5 + 2 * 15 * (numbers::PI - std::asin(2.5 / 15));
  return {area / exact - 1, between / (n * n) / perimeter};
}

void
zalesak_table(const std::string &folder)
{
  std::puts("\nZalesak's disc on 100^2 spacings, one turn.\n\n"
            "| way, reinitialisations | area % | L1 / perimeter | s |\n|---|---|---|---|");
  const double period = 628, rate = 2 * numbers::PI / period;
  for (const Way way :
       {Way{false, 0}, Way{false, 10}, Way{false, 50}, Way{true, 0}, Way{true, 10}, Way{true, 50}})
    {
      auto            lattice = sampled<2>(100, 50., slotted_disc);
      const auto      v       = vectors<2>(lattice, [&](const Point<2> &x) {
        return rate * Tensor<1, 2>({-x[1], x[0]});
      });
      const Motion<2> turn{
        period, 50, [&](double, NodalVectors<2> &at) { at = v; },
        [&](const Point<2> &x, const double from, const double to) {
          const double c = std::cos(rate * (to - from)), s = std::sin(rate * (to - from));
          return Tensor<1, 2>({c * x[0] - s * x[1] - x[0], s * x[0] + c * x[1] - x[1]});
        }};
      const double start = seconds();
      run(lattice, turn, way);
      const double     time = seconds() - start;
      const Difference end  = from_slotted_disc(lattice);
      std::printf("| %s | %.3f | %.4f | %.2f |\n", way.name().c_str(), 100 * end.area, end.l1,
                  time);
      std::fflush(stdout);
      if (way.n_reinitialisations != 50)
        save(folder,
             "zalesak_" + std::to_string(way.semi_lagrangian)
               + (way.n_reinitialisations > 0 ? "r" : ""),
             lattice);
    }
}

// Fifty load steps x = X + du(X) that shear a disc to 100 % or turn it once.
void
load_step_table()
{
  std::puts("\nA disc of radius 15 spacings under 50 load steps x + du(x), distance two-sided.\n\n"
            "| motion | way | area % | distance / h | s |\n|---|---|---|---|---|");
  const double       radius = 6, angle = 2 * numbers::PI / 50;
  const Tensor<2, 2> shear({{0., 0.02}, {0., 0.}}),
    turn({{std::cos(angle) - 1, -std::sin(angle)}, {std::sin(angle), std::cos(angle) - 1}});
  const Exact<2> disc = exact_ball(Point<2>(3, 1), radius);
  Exact<2>       sheared;
  sheared.distance = [&](const Point<2> &x) { // f / |grad f| of the sheared disc f = |X| - radius
    const double X = x[0] - x[1] - 3, Y = x[1] - 1, r = std::hypot(X, Y) + 1e-300;
    return (r - radius) / std::hypot(X / r, (Y - X) / r);
  };
  for (const Point<2> &X : disc.points)
    sheared.points.emplace_back(X[0] + X[1], X[1]);
  for (const bool is_turn : {false, true})
    for (const auto &[motion, name] :
         {std::make_pair(IncrementMotion::semi_lagrangian, "semi-Lagrangian"),
          std::make_pair(IncrementMotion::map_velocity, "map velocity"),
          std::make_pair(IncrementMotion::frozen_velocity, "frozen velocity")})
      {
        auto       lattice = sampled<2>(80, 16., disc.distance);
        const auto du      = vectors<2>(
          lattice, [&](const Point<2> &x) { return (is_turn ? turn : shear) * Tensor<1, 2>(x); });
        const double before = volume(lattice), start = seconds();
        for (int step = 0; step < 50; ++step)
          advect_increment<2>(lattice, du, motion);
        const double time = seconds() - start;
        std::printf("| %s | %s | %.4f | %.4f | %.3f |\n",
                    is_turn ? "turn by 360 degrees" : "shear to 100 %", name,
                    100 * (volume(lattice) / before - 1),
                    hausdorff(lattice, is_turn ? disc : sheared) / 0.4, time);
        std::fflush(stdout);
      }
}

// Enright et al., J. Comput. Phys. 183 (2002), in the box [-1/2, 1/2]^3: a ball of radius 0.15
// about (-0.15, -0.15, -0.15), T = 3.
void
enright_table()
{
  std::puts("\nEnright's deformation of a ball, T = 3, distance two-sided.\n\n"
            "| spacings | way, reinitialisations | volume % at T/2 | volume % | distance / h | s "
            "|\n|---|---|---|---|---|---|");
  const auto field = [](const Point<3> &p) {
    std::array<double, 3> s, s2;
    for (unsigned int d = 0; d < 3; ++d)
      {
        s[d]  = std::cos(numbers::PI * p[d]);
        s2[d] = -2 * std::sin(numbers::PI * p[d]) * s[d];
      }
    return Tensor<1, 3>({2 * s[0] * s[0] * s2[1] * s2[2], -s2[0] * s[1] * s[1] * s2[2],
                         -s2[0] * s2[1] * s[2] * s[2]});
  };
  const Exact<3> ball = exact_ball(Point<3>(-0.15, -0.15, -0.15), 0.15);
  for (const int n : {64, 128})
    for (const Way way : {Way{true, 0}, Way{true, 6}, Way{false, 6}})
      {
        auto         lattice = sampled<3>(n, 0.5, ball.distance);
        const double before = volume(lattice), start = seconds();
        Motion<3>    motion = reversing(lattice, field, 3., 60);
        const auto   there  = motion;
        Motion<3>    half   = motion;
        half.period /= 2;
        half.n_increments /= 2;
        const Way half_way{way.semi_lagrangian, way.n_reinitialisations / 2};
        run(lattice, half, half_way);
        const double middle = volume(lattice);
        half.velocity = [&](const double t, NodalVectors<3> &v) { there.velocity(1.5 + t, v); };
        half.path     = [&](const Point<3> &x, const double from, const double to) {
          return there.path(x, 1.5 + from, 1.5 + to);
        };
        run(lattice, half, half_way);
        const double time = seconds() - start;
        std::printf("| %d^3 | %s | %.2f | %.2f | %.2f | %.0f |\n", n, way.name().c_str(),
                    100 * (middle / before - 1), 100 * (volume(lattice) / before - 1),
                    n * hausdorff(lattice, ball), time);
        std::fflush(stdout);
      }
}
} // namespace

int
main(const int argc, char **const argv)
{
  const std::string folder = argc > 2 ? argv[2] : "";
  if (argc > 1 && std::strcmp(argv[1], "enright") == 0)
    enright_table();
  else if (argc > 1 && std::strcmp(argv[1], "plane") == 0)
    {
      zalesak_table(folder);
      vortex_table(folder);
      load_step_table();
    }
  else
    {
      std::fputs("usage: motions plane|enright [folder]\n", stderr);
      return 2;
    }
}
