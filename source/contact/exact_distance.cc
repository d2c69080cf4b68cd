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
    {
      poses.emplace_back();
      if (body.is_rigid())
        poses.back().emplace(*body.rigid, body.pose);
    }
}

template <int dim>
bool
ExactDistances<dim>::is_known(const unsigned int body, const dealii::Point<dim> &x) const
{
  const auto &shape = bodies[body].shape;
  if (!shape || bodies[body].law)
    return false;
  // Off the kinks, which may lie on grid lines.
  constexpr double   aside[]       = {137., 261., 183.};
  dealii::Point<dim> beside        = initial_position(body, x);
  double             slope_squared = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    beside[d] += aside[d] * step;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = beside, after = beside;
      before[d] -= 0.5 * step;
      after[d] += 0.5 * step;
      const double slope = (shape->signed_distance(after) - shape->signed_distance(before)) / step;
      slope_squared += slope * slope;
    }
  return std::abs(slope_squared - 1.) < 1e-3;
}

template <int dim>
double
ExactDistances<dim>::value(const unsigned int body, const dealii::Point<dim> &x) const
{
  return bodies[body].shape->signed_distance(initial_position(body, x));
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::gradient(const unsigned int body, const dealii::Point<dim> &x) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = x, after = x;
      before[d] -= 0.5 * step;
      after[d] += 0.5 * step;
      result[d] = (value(body, after) - value(body, before)) / step;
    }
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::normal(const unsigned int body, const dealii::Point<dim> &x) const
{
  const dealii::Tensor<1, dim> slope = gradient(body, x);
  return slope / std::max(0.1, slope.norm());
}

template <int dim>
dealii::Point<dim>
ExactDistances<dim>::foot(const unsigned int body, const dealii::Point<dim> &x) const
{
  return x - value(body, x) * normal(body, x);
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
    corners.push_back(initial_position(body, box.vertex(v)));
  std::vector<SmoothPiece<dim>> pieces;
  shape->append_pieces(dealii::BoundingBox<dim>(corners), pieces);
  return pieces.size() > 1;
}

template class ExactDistances<2>;
template class ExactDistances<3>;
} // namespace scree
