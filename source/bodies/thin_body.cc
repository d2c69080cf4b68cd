#include <scree/bodies/thin_body.h>

#include <cmath>

namespace scree
{
template <int dim>
std::optional<dealii::Point<dim>>
foot_on_thin_body(const Body<dim> &body, const dealii::Point<dim> &x,
                  const dealii::Tensor<1, dim> &direction, const double reach)
{
  if (!body.shape || body.shape->is_smooth())
    return {};
  const dealii::Point<dim> X = initial_position(body, x);
  dealii::BoundingBox<dim> box({X, X});
  box.extend(reach);
  std::vector<SmoothPiece<dim>> pieces, facing;
  body.shape->append_pieces(box, pieces);
  bool   is_thin  = false;
  double smallest = reach;
  for (const auto &piece : pieces)
    {
      const auto [value, gradient] = value_and_gradient(body, piece, x);
      const double cosine          = gradient * direction / (gradient.norm() * direction.norm());
      is_thin = is_thin || (cosine < -0.5 && std::abs(value) < reach * gradient.norm());
      const double distance = std::abs(value) / gradient.norm();
      if (cosine > 0.5 && distance < smallest)
        {
          smallest = distance;
          facing   = {piece};
        }
    }
  if (!is_thin || facing.empty())
    return {};
  dealii::Point<dim> foot = x;
  for (unsigned int iteration = 0; iteration < 10; ++iteration)
    {
      const auto [value, gradient] = value_and_gradient(body, facing[0], foot);
      foot -= value / gradient.norm_square() * gradient;
      if (std::abs(value) < 1e-12 * reach * gradient.norm())
        break;
    }
  const bool is_on_boundary
    = std::abs(body.shape->signed_distance(initial_position(body, foot))) < 1e-3 * reach;
  return is_on_boundary && foot.distance(x) < reach ? std::optional<dealii::Point<dim>>(foot)
                                                    : std::nullopt;
}

#define SCREE_INSTANTIATE(dim)                                  \
  template std::optional<dealii::Point<dim>> foot_on_thin_body( \
    const Body<dim> &, const dealii::Point<dim> &, const dealii::Tensor<1, dim> &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
