#include <scree/geometry/smooth_piece.h>

#include <cmath>

namespace scree
{
using namespace dealii;

template <int dim>
SmoothPiece<dim>::SmoothPiece(const Point<dim> &point, const Tensor<1, dim> &normal)
    : point(point)
    , plane_normal(normal)
{
  Assert(std::abs(normal.norm() - 1) < 1e-12, ExcMessage("A normal has length 1."));
}

template <int dim>
SmoothPiece<dim>::SmoothPiece(const LevelSet &level_set, const Gradient &exact_gradient)
    : level_set(level_set)
    , exact_gradient(exact_gradient)
{
  Assert(level_set, ExcMessage("A curved piece needs a level set."));
}

template <int dim>
double
SmoothPiece<dim>::value(const Point<dim> &x) const
{
  return is_plane() ? (x - point) * plane_normal : level_set(x);
}

template <int dim>
Tensor<1, dim>
SmoothPiece<dim>::gradient(const Point<dim> &x, const double step) const
{
  if (is_plane())
    return plane_normal;
  if (exact_gradient)
    if (const auto exact = exact_gradient(x, step))
      return *exact;
  Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      Point<dim> before = x, after = x;
      before[d] -= step;
      after[d] += step;
      result[d] = (level_set(after) - level_set(before)) / (after[d] - before[d]);
    }
  return result;
}

template <int dim>
Tensor<1, dim>
SmoothPiece<dim>::normal(const Point<dim> &x, const double step) const
{
  const Tensor<1, dim> direction = gradient(x, step);
  const double         length    = direction.norm();
  return length > 0 ? direction / length : direction;
}

template <int dim>
Point<dim>
SmoothPiece<dim>::foot(const Point<dim> &x, const double step) const
{
  Point<dim> result = x;
  for (unsigned int iteration = 0; iteration < 20; ++iteration)
    {
      const double         phi    = value(result);
      const Tensor<1, dim> slope  = gradient(result, step);
      const double         square = slope.norm_square();
      if (!(square > 0))
        break;
      result -= phi / square * slope;
      if (is_plane() || std::abs(phi) < 1e-12 * step)
        break;
    }
  return result;
}

template <int dim>
SmoothPiece<dim>
SmoothPiece<dim>::reversed() const
{
  if (is_plane())
    return SmoothPiece(point, -plane_normal);
  Gradient of_outside;
  if (exact_gradient)
    of_outside = [exact = exact_gradient](const Point<dim> &x, const double step) {
      auto result = exact(x, step);
      if (result)
        *result *= -1.;
      return result;
    };
  return SmoothPiece([phi = level_set](const Point<dim> &x) { return -phi(x); }, of_outside);
}

template <int dim>
SmoothPiece<dim>
SmoothPiece<dim>::moved(const Tensor<2, dim> &rotation, const Point<dim> &centre,
                        const Tensor<1, dim> &translation) const
{
  if (is_plane())
    return SmoothPiece(centre + rotation * (point - centre) + translation, rotation * plane_normal);
  const auto back = [=](const Point<dim> &x) {
    return centre + transpose(rotation) * (x - translation - centre);
  };
  Gradient of_moved;
  if (exact_gradient)
    of_moved = [=, exact = exact_gradient](const Point<dim> &x, const double step) {
      auto result = exact(back(x), step);
      if (result)
        result = rotation * *result;
      return result;
    };
  return SmoothPiece([=, phi = level_set](const Point<dim> &x) { return phi(back(x)); }, of_moved);
}

template class SmoothPiece<2>;
template class SmoothPiece<3>;
} // namespace scree
