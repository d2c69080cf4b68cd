#include <scree/geometry/simple_shapes.h>

#include <algorithm>
#include <cmath>

// The smooth pieces of the boundaries.
namespace scree
{
using namespace dealii;

namespace
{
// Whether a segment meets a closed box.
bool
segment_meets_box(const Point<2> &a, const Point<2> &b, const BoundingBox<2> &box)
{
  double first = 0, last = 1;
  for (unsigned int d = 0; d < 2; ++d)
    {
      const double length = b[d] - a[d];
      double       enter = box.lower_bound(d) - a[d], leave = box.upper_bound(d) - a[d];
      if (length == 0)
        {
          if (enter > 0 || leave < 0)
            return false;
          continue;
        }
      enter /= length;
      leave /= length;
      first = std::max(first, std::min(enter, leave));
      last  = std::min(last, std::max(enter, leave));
    }
  return first <= last;
}
} // namespace

template <int dim>
bool
Box<dim>::is_smooth() const
{
  return false;
}

template <int dim>
void
Box<dim>::append_pieces(const BoundingBox<dim> &box, std::vector<SmoothPiece<dim>> &pieces) const
{
  for (unsigned int d = 0; d < dim; ++d)
    if (box.upper_bound(d) < lower[d] || box.lower_bound(d) > upper[d])
      return;
  for (unsigned int d = 0; d < dim; ++d)
    for (const double side : {-1., 1.})
      {
        const Point<dim> &corner = side < 0 ? lower : upper;
        if (corner[d] >= box.lower_bound(d) && corner[d] <= box.upper_bound(d))
          pieces.emplace_back(corner, side * Point<dim>::unit_vector(d));
      }
}

template <int dim>
void
HalfSpace<dim>::append_pieces(const BoundingBox<dim>        &box,
                              std::vector<SmoothPiece<dim>> &pieces) const
{
  double middle = 0, reach = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      middle += normal[d] * (0.5 * (box.lower_bound(d) + box.upper_bound(d)) - point[d]);
      reach += std::abs(normal[d]) * 0.5 * box.side_length(d);
    }
  if (std::abs(middle) <= reach)
    pieces.emplace_back(point, normal);
}

template <int dim>
bool
Ring<dim>::is_smooth() const
{
  return false;
}

template <int dim>
void
Ring<dim>::append_pieces(const BoundingBox<dim> &box, std::vector<SmoothPiece<dim>> &pieces) const
{
  const double reach
    = 0.5 * (box.get_boundary_points().second - box.get_boundary_points().first).norm();
  const double r = centre.distance(box.center());
  if (std::abs(r - inner_radius) <= reach)
    pieces.emplace_back([this](const Point<dim> &x) { return inner_radius - x.distance(centre); });
  if (std::abs(r - outer_radius) <= reach)
    pieces.emplace_back([this](const Point<dim> &x) { return x.distance(centre) - outer_radius; });
}

bool
Polygon::is_smooth() const
{
  return false;
}

void
Polygon::append_pieces(const BoundingBox<2> &box, std::vector<SmoothPiece<2>> &pieces) const
{
  double area = 0;
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    area += vertices[j][0] * vertices[i][1] - vertices[j][1] * vertices[i][0];
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    if (const Point<2> &a = vertices[j], &b = vertices[i]; segment_meets_box(a, b, box))
      {
        const Tensor<1, 2> side = b - a;
        pieces.emplace_back(a,
                            (area > 0 ? 1 : -1) / side.norm() * Tensor<1, 2>({side[1], -side[0]}));
      }
}

template <int dim>
bool
Superellipse<dim>::is_smooth() const
{
  return exponent > 1;
}

template <int dim>
void
Superellipse<dim>::append_pieces(const BoundingBox<dim>        &box,
                                 std::vector<SmoothPiece<dim>> &pieces) const
{
  if (is_smooth())
    return Shape<dim>::append_pieces(box, pieces);
  // The planes sum_d s_d (x_d - centre_d)/a_d = 1 of the orthants s that the box reaches into.
  for (unsigned int orthant = 0; orthant < (1u << dim); ++orthant)
    {
      Tensor<1, dim> normal;
      bool           is_reached = true;
      for (unsigned int d = 0; d < dim; ++d)
        {
          normal[d]  = ((orthant >> d & 1u) != 0 ? 1 : -1) / semi_axes[d];
          is_reached = is_reached
                       && (normal[d] > 0 ? box.upper_bound(d) >= centre[d]
                                         : box.lower_bound(d) <= centre[d]);
        }
      Point<dim> vertex = centre;
      vertex[0] += 1 / normal[0];
      if (is_reached)
        pieces.emplace_back(vertex, normal / normal.norm());
    }
}

#define INSTANTIATE(dim)                                                                           \
  template bool Box<dim>::is_smooth() const;                                                       \
  template bool Ring<dim>::is_smooth() const;                                                      \
  template bool Superellipse<dim>::is_smooth() const;                                              \
  template void Box<dim>::append_pieces(const BoundingBox<dim> &, std::vector<SmoothPiece<dim>> &) \
    const;                                                                                         \
  template void HalfSpace<dim>::append_pieces(const BoundingBox<dim> &,                            \
                                              std::vector<SmoothPiece<dim>> &) const;              \
  template void Ring<dim>::append_pieces(const BoundingBox<dim> &,                                 \
                                         std::vector<SmoothPiece<dim>> &) const;                   \
  template void Superellipse<dim>::append_pieces(const BoundingBox<dim> &,                         \
                                                 std::vector<SmoothPiece<dim>> &) const;

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
