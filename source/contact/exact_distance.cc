#include <scree/bodies/boundary_foot.h>
#include <scree/contact/exact_distance.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
ExactDistances<dim>::ExactDistances(const std::vector<Body<dim>> &bodies, const double size)
    : bodies(bodies)
    , step(1e-6 * size)
{
  for (const Body<dim> &body : bodies)
    is_slope_1.push_back(body.shape && body.shape->is_distance()
                         && body.shape->exact_gradient(dealii::Point<dim>(), step).has_value());
}

template <int dim>
bool
ExactDistances<dim>::is_known(const unsigned int body, const dealii::Point<dim> &x) const
{
  const auto &shape = bodies[body].shape;
  if (!shape)
    return false;
  if (is_slope_1[body])
    return true;
  // Off the kinks, which may lie on grid lines.
  constexpr double   aside[] = {137., 261., 183.};
  dealii::Point<dim> beside  = initial_position(bodies[body], x);
  for (unsigned int d = 0; d < dim; ++d)
    beside[d] += aside[d] * step;
  return std::abs(slope(*shape, beside).norm_square() - 1.) < 1e-3;
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::slope(const Shape<dim> &shape, const dealii::Point<dim> &X) const
{
  if (const auto exact = shape.exact_gradient(X, 0.5 * step))
    return *exact;
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = X, after = X;
      before[d] -= 0.5 * step;
      after[d] += 0.5 * step;
      result[d] = (shape.signed_distance(after) - shape.signed_distance(before)) / step;
    }
  return result;
}

template <int dim>
double
ExactDistances<dim>::value(const unsigned int body, const dealii::Point<dim> &x) const
{
  return has_deformed(body)
           ? foot_and_normal(body, x).distance
           : bodies[body].shape->signed_distance(initial_position(bodies[body], x));
}

template <int dim>
BoundaryFoot<dim>
ExactDistances<dim>::foot_and_normal(const unsigned int body, const dealii::Point<dim> &x) const
{
  const Body<dim> &b = bodies[body];
  if (has_deformed(body))
    if (const auto foot = foot_on_boundary(b, x))
      return *foot;
  // To first order, exact where the body has not deformed.
  const dealii::Point<dim> X        = initial_position(b, x);
  dealii::Tensor<1, dim>   normal   = slope(*b.shape, X) * initial_gradient(b, x);
  const double             length   = std::max(0.1, normal.norm());
  double                   distance = b.shape->signed_distance(X);
  normal /= length;
  if (has_deformed(body))
    distance /= length;
  return {x - distance * normal, normal, distance};
}

template <int dim>
std::pair<double, dealii::Tensor<1, dim>>
ExactDistances<dim>::value_and_normal(const unsigned int body, const dealii::Point<dim> &x) const
{
  const BoundaryFoot<dim> foot = foot_and_normal(body, x);
  return {foot.distance, foot.normal};
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::normal(const unsigned int body, const dealii::Point<dim> &x) const
{
  return foot_and_normal(body, x).normal;
}

template <int dim>
dealii::Point<dim>
ExactDistances<dim>::foot(const unsigned int body, const dealii::Point<dim> &x) const
{
  return foot_and_normal(body, x).point;
}

template <int dim>
bool
ExactDistances<dim>::is_kinked(const unsigned int body, const dealii::BoundingBox<dim> &box) const
{
  const auto &shape = bodies[body].shape;
  if (!shape || shape->is_smooth())
    return false;
  std::vector<dealii::Point<dim>> corners;
  for (unsigned int v = 0; v < 1u << dim; ++v)
    corners.push_back(initial_position(bodies[body], box.vertex(v)));
  std::vector<SmoothPiece<dim>> pieces;
  shape->append_pieces(dealii::BoundingBox<dim>(corners), pieces);
  return pieces.size() > 1;
}

template class ExactDistances<2>;
template class ExactDistances<3>;
} // namespace scree
