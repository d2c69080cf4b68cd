#pragma once

#include <scree/geometry/shape_family.h>

namespace scree
{
/** How shapes are combined. */
enum class Combination
{
  union_of,
  intersection,
  difference
};

/**
 * The union min(phi_i), the intersection max(phi_i) or the difference max(phi_1, -phi_2, ...) of
 * shapes: not a distance, but one near the smooth parts of the boundary if the parts are distances.
 */
template <int dim>
class CombinedShape : public Shape<dim>
{
public:
  static ShapeFamily<dim> family();

  /** `parts` is not empty. */
  CombinedShape(Combination type, std::vector<ShapePointer<dim>> parts);

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  Combination                    type;
  std::vector<ShapePointer<dim>> parts;
};
} // namespace scree
