#pragma once

#include <scree/base/expression.h>
#include <scree/geometry/shape.h>

#include <deal.II/base/tensor.h>

namespace scree
{
/**
 * The formulas that a maximum or minimum chooses from, as a, b and c of max(a, min(b, c)); the
 * whole of any other formula.
 */
std::vector<std::string> extremum_arguments(const std::string &formula);

/** Where a formula of x, y (and z) is negative: max() intersects, min() unites. Without bounds. */
template <int dim>
class ExpressionShape : public Shape<dim>
{
public:
  /**
   * `distance` tells that the formula is a signed distance, `pieces` are its extremum_arguments()
   * if there are several.
   */
  ExpressionShape(const Expression<dim> &expression, bool distance,
                  std::vector<Expression<dim>> pieces = {});

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  Expression<dim>              expression;
  bool                         distance;
  std::vector<Expression<dim>> pieces; // empty: smooth
};

/** A shape moved by `x -> centre + R (x - centre) + translation`. */
template <int dim>
class MovedShape : public Shape<dim>
{
public:
  MovedShape(ShapePointer<dim> shape, const dealii::Tensor<2, dim> &rotation,
             const dealii::Point<dim> &centre, const dealii::Tensor<1, dim> &translation);

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  ShapePointer<dim>      shape;
  dealii::Tensor<2, dim> rotation;
  dealii::Point<dim>     centre;
  dealii::Tensor<1, dim> translation;
};

/**
 * The union min(phi_i), the intersection max(phi_i) or the difference max(phi_1, -phi_2, ...) of
 * shapes: not a distance, but one near the smooth parts of the boundary if the parts are distances.
 */
template <int dim>
class CombinedShape : public Shape<dim>
{
public:
  /** `type` is ShapeType::union_of, intersection or difference; `parts` is not empty. */
  CombinedShape(ShapeType type, std::vector<ShapePointer<dim>> parts);

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  ShapeType                      type;
  std::vector<ShapePointer<dim>> parts;
};
} // namespace scree
