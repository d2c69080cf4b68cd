#pragma once

#include <scree/geometry/shape.h>
#include <scree/level_set/lattice.h>

namespace scree
{
/**
 * What has no formula: the signed distances on a dense lattice of its own, which has positive
 * values all around, interpolated by cubics. Beyond its nodes it is the distance to a foot of the
 * contour, found from the nearest point of their box: that of convex shapes up to their curvature.
 */
template <int dim>
class LatticeShape : public Shape<dim>
{
public:
  explicit LatticeShape(Lattice<dim> distances);

  double signed_distance(const dealii::Point<dim> &x) const override;

  /** That of the contour between nodes and an eighth of a spacing. */
  dealii::BoundingBox<dim> bounding_box() const override;

private:
  Lattice<dim>             distances;
  dealii::BoundingBox<dim> bounds;
};
} // namespace scree
