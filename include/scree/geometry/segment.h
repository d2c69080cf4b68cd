#pragma once

#include <deal.II/base/point.h>

#include <algorithm>

namespace scree
{
/** Distance of x to the segment from a to b, which may be a point. */
template <int dim>
double
distance_to_segment(const dealii::Point<dim> &x, const dealii::Point<dim> &a,
                    const dealii::Point<dim> &b)
{
  const dealii::Tensor<1, dim> side   = b - a;
  const double                 square = side.norm_square();
  const double                 s = square > 0. ? std::clamp((x - a) * side / square, 0., 1.) : 0.;
  return x.distance(a + s * side);
}
} // namespace scree
