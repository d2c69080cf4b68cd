#pragma once

#include <scree/geometry/closed_surface.h>
#include <scree/geometry/polygon_sides.h>
#include <scree/geometry/shape_family.h>

#include <memory>

namespace scree
{
/** What a closed triangle surface contains. Its edges are those of a smooth surface, not corners.
 */
class SurfaceShape : public Shape<3>
{
public:
  explicit SurfaceShape(std::shared_ptr<const ClosedSurface> surface);

  double signed_distance(const dealii::Point<3> &x) const override;

  std::optional<dealii::Tensor<1, 3>> exact_gradient(const dealii::Point<3> &x,
                                                     const double            near) const override;

  dealii::BoundingBox<3> bounding_box() const override;

private:
  std::shared_ptr<const ClosedSurface> surface;
};

/** What an outline of a section contains, in the same sense smooth. */
class OutlineShape : public Shape<2>
{
public:
  explicit OutlineShape(const std::vector<dealii::Point<2>> &vertices);

  double signed_distance(const dealii::Point<2> &x) const override;

  dealii::BoundingBox<2> bounding_box() const override;

private:
  PolygonSides           sides;
  dealii::BoundingBox<2> box;
};

/** The shape of a file: the surface in 3D, a plane section of it in 2D. */
template <int dim>
ShapeFamily<dim> surface_family();
} // namespace scree
