#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** The points within `radius` of the segment from `first` to `second`. */
template <int dim>
class Capsule : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  Capsule(const dealii::Point<dim> &first, const dealii::Point<dim> &second, double radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool has_curvature_jumps() const override
  {
    return true;
  }

private:
  dealii::Point<dim> first, second;
  double             radius;
};
} // namespace scree
