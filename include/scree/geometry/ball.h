#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** A disc or ball: |x - centre| < radius. */
template <int dim>
class Ball : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  Ball(const dealii::Point<dim> &centre, double radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

private:
  dealii::Point<dim> centre;
  double             radius;
};
} // namespace scree
