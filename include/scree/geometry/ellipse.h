#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/**
 * An axis-aligned ellipse or ellipsoid. The closest point `e_i^2 y_i / (t + e_i^2)` to y follows
 * from the largest root t of `sum_i (e_i y_i / (t + e_i^2))^2 = 1`, found by safeguarded Newton
 * steps (Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid",
 * Geometric Tools, 2013).
 */
template <int dim>
class Ellipse : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  Ellipse(const dealii::Point<dim> &centre, const dealii::Point<dim> &semi_axes);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

private:
  dealii::Point<dim> centre, semi_axes;
};
} // namespace scree
