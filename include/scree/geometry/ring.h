#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** The points between two concentric circles or spheres. */
template <int dim>
class Ring : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  Ring(const dealii::Point<dim> &centre, double inner_radius, double outer_radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> centre;
  double             inner_radius, outer_radius;
};
} // namespace scree
