// Lattices and shapes that several tests of level sets use.
#pragma once

#include <scree/level_set/advection.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace scree
{
// A function on a lattice over [-size, size]^dim.
template <int dim, typename F>
Lattice<dim>
sampled(const double spacing, const double size, const F &f)
{
  LatticeFrame<dim> frame;
  frame.spacing = spacing;
  std::array<int, dim> lower, count;
  const int            n = static_cast<int>(std::lround(size / spacing));
  lower.fill(-n);
  count.fill(2 * n + 1);
  Lattice<dim> lattice(frame, lower, count);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = f(lattice.node(lattice.index(i)));
  return lattice;
}

// A vector function at the nodes.
template <int dim, typename F>
NodalVectors<dim>
vectors(const Lattice<dim> &lattice, const F &f)
{
  NodalVectors<dim> result;
  for (auto &component : result)
    component.resize(lattice.values().size());
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const dealii::Tensor<1, dim> v = f(lattice.node(lattice.index(i)));
      for (unsigned int d = 0; d < dim; ++d)
        result[d][i] = v[d];
    }
  return result;
}

// x turned in the plane of the first two axes.
template <int dim>
dealii::Point<dim>
turned(const dealii::Point<dim> &x, const double angle)
{
  dealii::Point<dim> result = x;
  result[0]                 = std::cos(angle) * x[0] - std::sin(angle) * x[1];
  result[1]                 = std::sin(angle) * x[0] + std::cos(angle) * x[1];
  return result;
}

// The vortex of LeVeque (SIAM J. Numer. Anal. 33, 1996) in the unit box, moved to [-1/2, 1/2]^2;
// times cos(pi t / T) it returns everything to its place at t = T.
inline dealii::Tensor<1, 2>
vortex(const dealii::Point<2> &x)
{
  using dealii::numbers::PI;
  const double s = std::cos(PI * x[0]), t = std::cos(PI * x[1]);
  return dealii::Tensor<1, 2>({s * s * std::sin(2 * PI * x[1]), -t * t * std::sin(2 * PI * x[0])});
}

inline const dealii::Point<2> vortex_centre(0, 0.25);

inline double
vortex_disc(const dealii::Point<2> &x)
{
  return (x - vortex_centre).norm() - 0.15;
}

inline double
distance_to_segment(const dealii::Point<2> &x, const dealii::Point<2> &a, const dealii::Point<2> &b)
{
  const double t = std::clamp((x - a) * (b - a) / (b - a).norm_square(), 0., 1.);
  return (x - a - t * (b - a)).norm();
}

// The slotted disc of Zalesak (J. Comput. Phys. 31, 1979): radius 15 about (0, 25), slot of width 5
// and length 25 from below.
inline double
slotted_disc(const dealii::Point<2> &x)
{
  using dealii::Point;
  const Point<2> centre(0, 25);
  const double   end = 25 - std::sqrt(15. * 15 - 2.5 * 2.5), top = 35;
  const bool     inside = (x - centre).norm() < 15 && !(std::abs(x[0]) < 2.5 && x[1] < top);
  const Point<2> a(-2.5, end), b(-2.5, top), c(2.5, top), d(2.5, end);
  double         distance = std::min(
            {distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, d)});
  const dealii::Tensor<1, 2> from = x - centre;
  if (!(std::abs(from[0]) < 2.5 * from.norm() / 15 && from[1] < 0))
    distance = std::min(distance, std::abs(from.norm() - 15));
  return inside ? -distance : distance;
}

struct SlottedDiscError
{
  double area; // relative
  double L1;   // area between the contours over the perimeter
  double exact_area;
};

// The contour of the bilinear interpolant in [-50, 50]^2 against the slotted disc, by samples.
inline SlottedDiscError
slotted_disc_error(const Lattice<2> &lattice)
{
  const int n    = 10; // samples per unit of length
  double    area = 0, exact_area = 0, difference = 0;
  for (int i = 0; i < 100 * n; ++i)
    for (int j = 0; j < 100 * n; ++j)
      {
        const dealii::Point<2> x(-50 + (i + 0.5) / n, -50 + (j + 0.5) / n);
        const bool             is = lattice.value(x, 1) < 0, was = slotted_disc(x) < 0;
        area += is;
        exact_area += was;
        difference += is != was;
      }
  const double perimeter = 2 * (10 + std::sqrt(15. * 15 - 2.5 * 2.5)) + 5
                           + 2 * 15 * (dealii::numbers::PI - std::asin(2.5 / 15));
  return {area / exact_area - 1, difference / (n * n) / perimeter, exact_area / (n * n)};
}
} // namespace scree
