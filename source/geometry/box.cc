#include <scree/base/log.h>
#include <scree/geometry/box.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
void
check_box(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const auto &lower = p.coordinates("Lower corner"), &upper = p.coordinates("Upper corner");
  for (std::size_t d = 0; d < std::min(lower.size(), upper.size()); ++d)
    if (lower[d] >= upper[d])
      return section.error("Lower corner", "'Lower corner' is not below 'Upper corner'",
                           "every coordinate of the lower corner must be less");
    else if (p.number("Corner radius") > 0.5 * (upper[d] - lower[d]) * (1. + 1e-12))
      return section.error(
        "Corner radius", "the box is thinner than two radii: " + short_number(upper[d] - lower[d]),
        "give at most half of its shortest edge");
}
} // namespace

template <int dim>
ShapeFamily<dim>
Box<dim>::family()
{
  return {{"box"},
          "box",
          {coordinates("Lower corner", "Lower corner of %"),
           coordinates("Upper corner", "Upper corner of %"), corner_radius()},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            const double radius = p.number("Corner radius");
            return std::make_unique<Box<dim>>(p.point("Lower corner"), p.point("Upper corner"),
                                              std::isnan(radius) ? 0. : radius);
          },
          check_box<dim>};
}

template <int dim>
Box<dim>::Box(const Point<dim> &lower, const Point<dim> &upper, const double radius)
    : lower(lower)
    , upper(upper)
    , radius(radius)
{
  for (unsigned int d = 0; d < dim; ++d)
    Assert(lower[d] < upper[d], ExcMessage("The corners of a box must be in order."));
}

template <int dim>
double
Box<dim>::signed_distance(const Point<dim> &x) const
{
  Tensor<1, dim> outside;
  double         inside = -Shape<dim>::unbounded;
  for (unsigned int d = 0; d < dim; ++d)
    {
      // of the box whose points are at least the radius inside
      const double distance = std::max(lower[d] - x[d], x[d] - upper[d]) + radius;
      outside[d]            = std::max(distance, 0.);
      inside                = std::max(inside, distance);
    }
  return (inside < 0 ? inside : outside.norm()) - radius;
}

template <int dim>
BoundingBox<dim>
Box<dim>::bounding_box() const
{
  return BoundingBox<dim>({lower, upper});
}

template <int dim>
bool
Box<dim>::is_smooth() const
{
  return radius > 0.;
}

template <int dim>
bool
Box<dim>::has_curvature_jumps() const
{
  return radius > 0.;
}

template <int dim>
void
Box<dim>::append_pieces(const BoundingBox<dim> &box, std::vector<SmoothPiece<dim>> &pieces) const
{
  if (radius > 0.)
    return Shape<dim>::append_pieces(box, pieces);
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

template class Box<2>;
template class Box<3>;
} // namespace scree
