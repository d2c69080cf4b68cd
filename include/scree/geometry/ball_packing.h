#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <cstdint>
#include <vector>

namespace scree
{
/** What a random packing of discs or balls in a box is to be. */
template <int dim>
struct PackingParameters
{
  unsigned int             n = 0;
  dealii::BoundingBox<dim> box;
  double                   size_ratio = 1.; //!< of the largest to the smallest radius, at least 1
  std::uint64_t            seed       = 1;
};

template <int dim>
struct PackedBall
{
  dealii::Point<dim> centre;
  double             radius;
};

/**
 * Balls that have grown until they touch one another and the box, without overlap; their radii are
 * uniform between the smallest and the largest. From random places they grow together; overlaps
 * push both balls apart by halves, sweep by sweep, until that fails. A cell list keeps the time
 * proportional to their number. One seed gives the same numbers everywhere: all arithmetic is sums,
 * products, quotients and square roots, in a fixed order.
 */
template <int dim>
std::vector<PackedBall<dim>> pack_balls(const PackingParameters<dim> &parameters);
} // namespace scree
