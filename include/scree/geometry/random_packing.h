#pragma once

#include <scree/geometry/random_shapes.h>

#include <deal.II/base/bounding_box.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace scree
{
/** What a random packing of convex shapes is to be. */
template <int dim>
struct PackingParameters
{
  unsigned int             n = 0;
  dealii::BoundingBox<dim> box;
  bool              in_cylinder = false; //!< in place of the box: that along z in it, a disc in 2D
  std::uint64_t     seed        = 1;
  RandomShapes<dim> shapes;
  /** Part of the container that they fill; not set: they grow until they jam. */
  std::optional<double> solid_fraction;
};

template <int dim>
struct PackedShape
{
  dealii::Point<dim>                      centre;
  dealii::Tensor<2, dim>                  rotation;
  std::shared_ptr<const ConvexShape<dim>> shape;
};

template <int dim>
struct RandomPacking
{
  std::vector<PackedShape<dim>> members;
  double                        solid_fraction; //!< less than was asked for if they jammed before
};

/**
 * Convex shapes that have grown until they touch one another and the container, without overlap.
 * From random places they grow together; overlaps push and turn both by halves, sweep by sweep,
 * until that fails: position-based dynamics (Müller et al., J. Vis. Commun. Image R. 18, 109, 2007)
 * of overdamped rigid bodies. A cell list keeps the time proportional to their number. The planes
 * of touching_scale() prove that there is no overlap. One seed gives the same numbers everywhere:
 * all arithmetic is sums, products, quotients and square roots, in a fixed order; superellipses
 * need powers, which libraries of C round differently.
 */
template <int dim>
RandomPacking<dim> pack_at_random(const PackingParameters<dim> &parameters);
} // namespace scree
