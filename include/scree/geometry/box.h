#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** An axis-aligned box between two corners; with a radius its edges and corners are round. */
template <int dim>
class Box : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  /** @param radius of edges and corners [L], at most half of the shortest edge */
  Box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, const double radius = 0.);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;
  bool has_curvature_jumps() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> lower, upper;
  double             radius;
};
} // namespace scree
