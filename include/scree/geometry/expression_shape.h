#pragma once

#include <scree/base/expression.h>
#include <scree/geometry/shape_family.h>

#include <string>
#include <vector>

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
  static ShapeFamily<dim> family();

  /**
   * `distance` tells that the formula is a signed distance, `pieces` are its extremum_arguments()
   * if there are several.
   */
  ExpressionShape(const Expression<dim> &expression, bool distance,
                  std::vector<Expression<dim>> pieces = {});

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  bool is_claimed_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  Expression<dim>              expression;
  bool                         distance;
  std::vector<Expression<dim>> pieces; // empty: smooth
};
} // namespace scree
