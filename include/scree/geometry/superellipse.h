#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** |x/a|^n + |y/b|^n (+ |z/c|^n) < 1, n >= 1. The level set `(sum_i |x_i/a_i|^n)^{1/n} - 1` times
 * the least semi-axis. */
template <int dim>
class Superellipse : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  Superellipse(const dealii::Point<dim> &centre, const dealii::Point<dim> &semi_axes,
               double exponent);

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> centre, semi_axes;
  double             exponent, least_axis;
};
} // namespace scree
