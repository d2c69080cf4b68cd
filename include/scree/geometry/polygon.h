#pragma once

#include <scree/geometry/polygon_sides.h>
#include <scree/geometry/shape_family.h>

namespace scree
{
/** The inside of a closed polygon without crossing sides, its vertices in either orientation. */
class Polygon : public Shape<2>
{
public:
  template <int dim>
  static ShapeFamily<dim> family();

  explicit Polygon(const std::vector<dealii::Point<2>> &vertices);

  double signed_distance(const dealii::Point<2> &x) const override;

  dealii::BoundingBox<2> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<2> &box,
                     std::vector<SmoothPiece<2>>  &pieces) const override;

  /** Whether two sides of the polygon with these vertices cross or touch (beyond common vertices).
   */
  static bool crosses_itself(const std::vector<dealii::Point<2>> &vertices);

private:
  std::vector<dealii::Point<2>> vertices;
  PolygonSides                  sides;
};
} // namespace scree
