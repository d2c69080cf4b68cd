#pragma once

#include <scree/points/moving_least_squares.h>

#include <cmath>
#include <random>

namespace scree
{
/** Clouds of points for the tests: a distorted grid of n^dim points, a body each, side by side. */
template <int dim>
struct PointCloud
{
  std::vector<dealii::Point<dim>> position;
  std::vector<unsigned int>       body;
  std::vector<double>             spacing;
};

/** How the points of the unit box are placed. */
enum class Placement
{
  regular,
  rotated,
  graded,
  irregular
};

/** The point of the cloud at `u` of the unit box: body b lies in the box shifted by b along x. */
template <int dim>
dealii::Point<dim>
placed(const dealii::Point<dim> &u, const Placement placement)
{
  dealii::Point<dim> x = u;
  if (placement == Placement::graded)
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 0.3 * u[d] + 0.7 * u[d] * u[d];
  if (placement == Placement::rotated)
    {
      const double c = std::cos(0.6), s = std::sin(0.6);
      x[0] = c * u[0] - s * u[1];
      x[1] = s * u[0] + c * u[1];
    }
  return x;
}

template <int dim>
PointCloud<dim>
make_cloud(const unsigned int n, const Placement placement, const unsigned int n_bodies = 2)
{
  PointCloud<dim>                        cloud;
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> shift(-0.45, 0.45);
  const unsigned int                     n_points = dim == 2 ? n * n : n * n * n;
  for (unsigned int b = 0; b < n_bodies; ++b)
    for (unsigned int i = 0; i < n_points; ++i)
      {
        dealii::Point<dim> u;
        double             spacing = 1. / n;
        unsigned int       rest    = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= n)
          u[d] = (rest % n + 0.5 + (placement == Placement::irregular ? shift(random) : 0.)) / n;
        if (placement == Placement::graded)
          {
            double largest = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              largest = std::max(largest, 0.3 + 1.4 * u[d]);
            spacing *= largest;
          }
        auto x = placed(u, placement);
        x[0] += b;
        cloud.position.push_back(x);
        cloud.body.push_back(b);
        cloud.spacing.push_back(spacing);
      }
  return cloud;
}

/** n^dim random targets of body 0, and as many on the surface of its box, corners included. */
template <int dim>
Targets<dim>
make_targets(const unsigned int n, const Placement placement, const double cell_size)
{
  Targets<dim>                           targets;
  std::mt19937                           random(11);
  std::uniform_real_distribution<double> anywhere(0., 1.);
  const unsigned int                     n_inside = dim == 2 ? n * n : n * n * n;
  for (unsigned int i = 0; i < 2 * n_inside + (1 << dim); ++i)
    {
      dealii::Point<dim> u;
      for (unsigned int d = 0; d < dim; ++d)
        u[d] = i >= 2 * n_inside ? (i >> d) & 1 : anywhere(random);
      if (i >= n_inside && i < 2 * n_inside)
        u[i % dim] = i / dim % 2;
      targets.position.push_back(placed(u, placement));
      targets.body.push_back(0);
      targets.cell_size.push_back(cell_size);
    }
  return targets;
}
} // namespace scree
