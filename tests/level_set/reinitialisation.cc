#include <gtest/gtest.h>

#include <scree/level_set/binary_field.h>
#include <scree/level_set/closest_point.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/reinitialisation.h>

#include <cmath>
#include <iostream>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

// The largest distance of points of the contour of `a` near an ellipse from the contour of `b`.
double
motion(const Lattice<2> &a, const Lattice<2> &b, const Point<2> &axes, const unsigned int degree)
{
  double result = 0;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const Point<2> x(axes[0] * std::cos(i), axes[1] * std::sin(i));
      const auto     from = project(a, x, degree), to = project(b, from.point, degree);
      EXPECT_TRUE(from.converged && to.converged);
      result = std::max(result, from.point.distance(to.point));
    }
  return result;
}

struct Motions
{
  ReinitialisationCount first;
  double                once, hundred_times; // spacings
};

Motions
motions(const Lattice<2> &start, const Point<2> &axes, const unsigned int degree)
{
  Motions result;
  auto    lattice = start;
  result.first    = reinitialise(lattice, {0.1, degree});
  result.once     = motion(start, lattice, axes, degree) / start.spacing();
  for (unsigned int i = 1; i < 100; ++i)
    reinitialise(lattice, {0.1, degree});
  result.hundred_times = motion(start, lattice, axes, degree) / start.spacing();
  return result;
}

// A disc and an ellipse whose slope is within the tolerance (in the band): nothing moves, for any
// degree. With other slopes the contour of the cubic interpolant stays, that of lower degrees moves
// by what interpolating another function means; the band is changed in the first call only.
TEST(Reinitialisation, LeavesTheContourInPlace)
{
  const double   h = 0.025;
  const Point<2> round(0.53, 0.53), oval(0.8, 0.5);
  const auto     ellipse = [](const Point<2> &x) { return std::hypot(x[0] / 0.8, x[1] / 0.5); };
  const auto     near_distance = [&](const Point<2> &x) {
    // f / |grad f|, |x| away from zero
    const double f = ellipse(x) + 1e-10;
    return (f - 1) * f / std::hypot(x[0] / 0.64, x[1] / 0.25 + 1e-10);
  };
  for (const unsigned int degree : {1, 2, 3})
    {
      const auto disc
        = motions(sampled<2>(h, 1.1, [](const Point<2> &x) { return 1.06 * (x.norm() - 0.53); }),
                  round, degree);
      const auto distance = motions(sampled<2>(h, 1.1, near_distance), oval, degree);
      for (const Motions &m : {disc, distance})
        {
          EXPECT_EQ(m.first.n_changed_near, 0u);
          EXPECT_LT(m.once, 1e-11);
          EXPECT_LT(m.hundred_times, 1e-11);
        }

      const auto wavy  = motions(sampled<2>(h, 1.1,
                                           [](const Point<2> &x) {
                                             return (x.norm_square() - 0.53 * 0.53)
                                                    * (2 + std::sin(2 * x[0] + x[1]));
                                           }),
                                 round, degree);
      const auto steep = motions(
        sampled<2>(h, 1.1, [&](const Point<2> &x) { return ellipse(x) - 1; }), oval, degree);
      for (const Motions &m : {wavy, steep})
        {
          std::cout << "degree " << degree << ": slope off by " << m.first.deviation_near
                    << ", contour/h moved by " << m.once << " in 1 call ("
                    << m.first.contour_motion / h << " at the cut edges), " << m.hundred_times
                    << " in 100\n";
          EXPECT_GT(m.first.n_changed_near, 0u);
          EXPECT_LT(m.first.contour_motion / h, 1.1 * m.once);
          EXPECT_LT(m.once, degree == 3 ? 1e-4 : degree == 2 ? 5e-4 : 1e-2);
          EXPECT_LT(m.hundred_times, degree == 3 ? 1e-3 : m.once + 1e-5);
        }
    }
}

template <int dim>
void
check_distances(const double h, const double size)
{
  auto lattice = sampled<dim>(
    h, size, [](const Point<dim> &x) { return (x.norm_square() - 0.53 * 0.53) * (2 + x[0]); });
  const ReinitialisationCount first = reinitialise(lattice);
  double                      near = 0, all = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const double distance = lattice.node(lattice.index(i)).norm() - 0.53;
      const double error    = std::abs(lattice.values()[i] - distance);
      if (std::abs(distance) < 2 * h)
        near = std::max(near, error);
      if (distance > -0.15)
        all = std::max(all, error);
    }
  std::cout << "slope off by " << first.deviation_near << ", then error/h " << near / h << " near, "
            << all / h << " anywhere\n";
  EXPECT_LT(near, 1e-3 * h);
  EXPECT_LT(all, 0.1 * h);
  const ReinitialisationCount second = reinitialise(lattice);
  EXPECT_EQ(second.n_changed_near + second.n_changed_far, 0u);
  EXPECT_EQ(second.contour_motion, 0.);
}

TEST(Reinitialisation, MakesADistanceOnce)
{
  check_distances<2>(0.025, 1);
  check_distances<3>(0.05, 0.8);
}

TEST(Reinitialisation, KeepsTheCornersOfASquare)
{
  const double h      = 0.05;
  const auto   square = [](const Point<2> &x) {
    const double a = std::abs(x[0]) - 0.62, b = std::abs(x[1]) - 0.63;
    return std::max(a, b) < 0 ? std::max(a, b) : std::hypot(std::max(a, 0.), std::max(b, 0.));
  };
  auto         lattice = sampled<2>(h, 1, [&](const Point<2> &x) { return 2 * square(x); });
  const double area    = volume_below(lattice, 0);
  reinitialise(lattice);
  double error = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const double exact = square(lattice.node(lattice.index(i)));
      if (std::abs(exact) < 2 * h)
        error = std::max(error, std::abs(lattice.values()[i] - exact));
    }
  EXPECT_LT(error, 1e-3 * h);
  EXPECT_LT(std::abs(volume_below(lattice, 0) / area - 1), 1e-5);
}

TEST(Reinitialisation, NeedsAContour)
{
  auto lattice = sampled<2>(0.1, 0.5, [](const Point<2> &x) { return 1 + x.norm(); });
  deal_II_exceptions::disable_abort_on_exception();
  EXPECT_THROW(reinitialise(lattice), ExceptionBase);
  EXPECT_THROW(distance_from_labels(lattice), ExceptionBase);
}

// The vortex of LeVeque there and back on 128^2 spacings, T = 2, with a reinitialisation after
// every part.
TEST(ReleaseReinitialisation, KeepsTheAreaInAVortex)
{
  const double h = 1. / 128, period = 2;
  for (const unsigned int n_parts : {20, 80})
    {
      auto              lattice = sampled<2>(h, 0.5, vortex_disc);
      const auto        field   = vectors(lattice, vortex);
      const std::size_t n       = lattice.values().size();
      const double      area    = volume_below(lattice, 0);
      for (unsigned int part = 0; part < n_parts; ++part)
        {
          const double start = period * part / n_parts;
          advect<2>(
            lattice,
            [&](const double t, NodalVectors<2> &v) {
              for (unsigned int d = 0; d < 2; ++d)
                for (std::size_t i = 0; i < n; ++i)
                  v[d][i] = std::cos(numbers::PI * (start + t) / period) * field[d][i];
            },
            period / n_parts);
          reinitialise(lattice);
        }
      double distance = 0;
      for (unsigned int i = 0; i < 1000; ++i)
        {
          const Point<2> x(0.15 * std::cos(i), 0.25 + 0.15 * std::sin(i));
          distance = std::max(distance, std::abs(vortex_disc(closest_point(lattice, x, 3).point)));
        }
      const double error = volume_below(lattice, 0) / area - 1;
      std::cout << n_parts << " reinitialisations: area " << error << ", distance/h "
                << distance / h << '\n';
      EXPECT_LT(std::abs(error), 2e-3);
      EXPECT_LT(distance, h / 4);
    }
}

// One turn on 100^2 spacings, 1257 steps, reinitialised after every 25th and every 5th.
TEST(ReleaseReinitialisation, KeepsZalesaksDisc)
{
  for (const unsigned int n_parts : {50, 250})
    {
      auto       lattice = sampled<2>(1., 50., slotted_disc);
      const auto v       = vectors(lattice, [](const Point<2> &x) {
        return 2 * numbers::PI / 628 * Tensor<1, 2>({-x[1], x[0]});
      });
      for (unsigned int part = 0; part < n_parts; ++part)
        {
          advect<2>(lattice, v, 628. / n_parts);
          reinitialise(lattice);
        }
      const SlottedDiscError end = slotted_disc_error(lattice);
      std::cout << n_parts << " reinitialisations: area " << end.area << ", L1/perimeter " << end.L1
                << '\n';
      EXPECT_LT(std::abs(end.area), 0.005);
      EXPECT_LT(end.L1, 0.10);
    }
}

// Labels of a blob with a deterministic roughness of one node.
template <int dim>
void
check_labels(const double h, const double roughness)
{
  auto         lattice  = sampled<dim>(h, 1, [&](const Point<dim> &x) {
    double angle = 0;
    for (unsigned int d = 0; d < dim; ++d)
      angle += (97 + 31 * d) * x[d] / h;
    return x.norm() < 0.6 + 0.1 * std::sin(3 * x[0]) + roughness * h * std::sin(angle) ? -1. : 1.;
  });
  const auto   n_inside = std::count_if(lattice.values().begin(), lattice.values().end(),
                                        [](double v) { return v < 0; });
  const double volume   = n_inside * std::pow(h, dim);
  distance_from_labels(lattice);
  double deviation = 0;
  for (unsigned int i = 0; i < 500; ++i)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::sin(1. + 1.7 * i * (d + 1) + d);
      x *= 0.6 / x.norm();
      const Point<dim> foot = closest_point(lattice, x, 3).point;
      deviation = std::max(deviation, std::abs(foot.norm() - 0.6 - 0.1 * std::sin(3 * foot[0])));
    }
  const double                kept  = volume_below(lattice, 0) / volume - 1;
  const ReinitialisationCount count = reinitialise(lattice);
  const double                after = volume_below(lattice, 0) / volume - 1;
  std::cout << dim << "D labels: volume " << kept << ", after reinitialisation " << after
            << ", contour/h off by " << deviation / h << ", slope off by " << count.deviation_near
            << '\n';
  EXPECT_LT(std::abs(kept), 1e-6);
  EXPECT_LT(std::abs(after), 5e-3);
  EXPECT_LT(deviation, 0.75 * h);
}

TEST(Labels, KeepTheVolumeAndBecomeSmooth)
{
  check_labels<2>(0.025, 0);
  check_labels<2>(0.025, 1);
  check_labels<3>(0.05, 1);
}

TEST(Labels, KeepASingleVoxel)
{
  const double h = 0.1;
  auto lattice   = sampled<2>(h, 1, [](const Point<2> &x) { return x.norm() < 0.01 ? -1. : 1.; });
  distance_from_labels(lattice);
  EXPECT_NEAR(volume_below(lattice, 0), h * h, 1e-6);
}

TEST(Labels, VolumesOfBallsAreOfSecondOrder)
{
  const auto error = [](const double h) {
    const auto lattice = sampled<3>(h, 1, [](const Point<3> &x) { return x.norm() - 0.7; });
    return std::abs(volume_below(lattice, 0.05) / (4. / 3. * numbers::PI * std::pow(0.75, 3)) - 1);
  };
  const double coarse = error(0.1), fine = error(0.05);
  EXPECT_LT(fine, 3e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.9);
}
} // namespace
} // namespace scree
