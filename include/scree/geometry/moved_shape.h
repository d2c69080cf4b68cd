#pragma once

#include <scree/geometry/shape.h>

namespace scree
{
/** A shape moved by `x -> centre + R (x - centre) + translation`. */
template <int dim>
class MovedShape : public Shape<dim>
{
public:
  MovedShape(std::shared_ptr<const Shape<dim>> shape, const dealii::Tensor<2, dim> &rotation,
             const dealii::Point<dim> &centre, const dealii::Tensor<1, dim> &translation);

  double signed_distance(const dealii::Point<dim> &x) const override;

  std::optional<dealii::Tensor<1, dim>> exact_gradient(const dealii::Point<dim> &x,
                                                       const double near) const override;

  bool is_distance() const override;

  bool is_claimed_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;
  bool has_curvature_jumps() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  /** Where x is before the motion. */
  dealii::Point<dim> unmoved(const dealii::Point<dim> &x) const;

  std::shared_ptr<const Shape<dim>> shape;
  dealii::Tensor<2, dim>            rotation;
  dealii::Point<dim>                centre;
  dealii::Tensor<1, dim>            translation;
};

/** The rotation by an angle [degrees]; `axis`, of any length, counts in 3D (Rodrigues' formula). */
template <int dim>
dealii::Tensor<2, dim> rotation_matrix(const double degrees, const std::vector<double> &axis);
} // namespace scree
