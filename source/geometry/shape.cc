#include <scree/geometry/shape.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
std::optional<dealii::Tensor<1, dim>>
Shape<dim>::exact_gradient(const dealii::Point<dim> &, const double) const
{
  return {};
}

template <int dim>
bool
Shape<dim>::is_distance() const
{
  return true;
}

template <int dim>
bool
Shape<dim>::is_claimed_distance() const
{
  return false;
}

template <int dim>
bool
Shape<dim>::has_curvature_jumps() const
{
  return false;
}

template <int dim>
bool
Shape<dim>::is_smooth() const
{
  return true;
}

template <int dim>
void
Shape<dim>::append_pieces(const dealii::BoundingBox<dim> &box,
                          std::vector<SmoothPiece<dim>>  &pieces) const
{
  const auto &[lower, upper] = box.get_boundary_points();
  const double reach         = 0.5 * (upper - lower).norm();
  if (is_distance() && std::abs(signed_distance(lower + 0.5 * (upper - lower))) > reach)
    return;
  pieces.emplace_back(
    [this](const dealii::Point<dim> &x) { return signed_distance(x); },
    [this](const dealii::Point<dim> &x, const double near) { return exact_gradient(x, near); });
}

template <int dim>
dealii::BoundingBox<dim>
unbounded_box()
{
  dealii::BoundingBox<dim> result({dealii::Point<dim>(), dealii::Point<dim>()});
  result.extend(Shape<dim>::unbounded);
  return result;
}

namespace
{
/** Directions all around in the plane across a unit normal. */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
directions_across(const dealii::Tensor<1, dim> &normal)
{
  if constexpr (dim == 2)
    {
      const dealii::Tensor<1, 2> t({-normal[1], normal[0]});
      return {t, -t};
    }
  else
    {
      const unsigned int smallest
        = std::min_element(normal.begin_raw(), normal.end_raw(),
                           [](const double a, const double b) { return std::abs(a) < std::abs(b); })
          - normal.begin_raw();
      dealii::Tensor<1, 3> s;
      s[smallest] = 1.;
      s -= normal[smallest] * normal;
      s /= s.norm();
      const dealii::Tensor<1, 3>        t = cross_product_3d(normal, s);
      std::vector<dealii::Tensor<1, 3>> result;
      constexpr unsigned int            n = 12;
      for (unsigned int i = 0; i < n; ++i)
        result.push_back(std::cos(2. * M_PI * i / n) * s + std::sin(2. * M_PI * i / n) * t);
      return result;
    }
}
} // namespace

template <int dim>
std::vector<SmoothPiece<dim>>
active_pieces(const Shape<dim> &shape, const dealii::Point<dim> &x, const double radius)
{
  dealii::BoundingBox<dim> box({x, x});
  box.extend(radius);
  std::vector<SmoothPiece<dim>> near, result;
  shape.append_pieces(box, near);
  for (const auto &piece : near)
    {
      const double                 step   = 1e-3 * radius;
      const dealii::Point<dim>     middle = piece.foot(x, step);
      const dealii::Tensor<1, dim> normal = piece.normal(middle, step);
      if (!(normal.norm_square() > 0.) || middle.distance(x) > radius)
        continue;
      auto places = directions_across<dim>(normal);
      places.emplace_back();
      // The shape lies behind the piece, and nothing before it, somewhere around x.
      const auto bounds = [&](const dealii::Tensor<1, dim> &place) {
        const dealii::Point<dim>     y = piece.foot(middle + 0.5 * radius * place, step);
        const dealii::Tensor<1, dim> n = 0.01 * radius * piece.normal(y, step);
        return (shape.signed_distance(y - n) < 0.) != (shape.signed_distance(y + n) < 0.);
      };
      if (std::any_of(places.begin(), places.end(), bounds))
        result.push_back(piece);
    }
  return result;
}

template class Shape<2>;
template class Shape<3>;
template dealii::BoundingBox<2>      unbounded_box();
template dealii::BoundingBox<3>      unbounded_box();
template std::vector<SmoothPiece<2>> active_pieces(const Shape<2> &, const dealii::Point<2> &,
                                                   const double);
template std::vector<SmoothPiece<3>> active_pieces(const Shape<3> &, const dealii::Point<3> &,
                                                   const double);
} // namespace scree
