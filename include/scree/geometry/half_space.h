#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** The half-space behind the plane through `point` with the outward `normal` (of any length). */
template <int dim>
class HalfSpace : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  HalfSpace(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &normal);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim>     point;
  dealii::Tensor<1, dim> normal;
};
} // namespace scree
