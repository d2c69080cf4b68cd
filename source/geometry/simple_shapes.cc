#include <scree/geometry/simple_shapes.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
// The box of half-widths `extent` around a centre.
template <int dim>
BoundingBox<dim>
box_around(const Point<dim> &centre, const Tensor<1, dim> &extent)
{
  return BoundingBox<dim>({centre - extent, centre + extent});
}

template <int dim>
Tensor<1, dim>
equal_components(const double value)
{
  Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = value;
  return result;
}

template <int dim>
double
distance_to_segment(const Point<dim> &x, const Point<dim> &a, const Point<dim> &b)
{
  const Tensor<1, dim> side   = b - a;
  const double         square = side.norm_square();
  const double         t      = square > 0 ? std::clamp((x - a) * side / square, 0., 1.) : 0.;
  return x.distance(a + t * side);
}

// The largest root t of sum_i (e_i y_i / (t + e_i^2))^2 = 1 for y >= 0 with y_i > 0 at the least
// axis, as s = t + (least e_i)^2, which keeps its digits near the pole. The sum falls convexly, so
// Newton steps from the left of the root never pass it.
template <int dim>
double
ellipse_parameter(const Point<dim> &y, const Point<dim> &e, const unsigned int least)
{
  double s = e[least] * y[least];
  for (unsigned int iteration = 0; iteration < 200; ++iteration)
    {
      double f = -1, slope = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double denominator = s + (e[d] - e[least]) * (e[d] + e[least]);
          const double ratio       = e[d] * y[d] / denominator;
          f += ratio * ratio;
          slope -= 2 * ratio * ratio / denominator;
        }
      const double next = s - f / slope;
      if (!(next > s))
        break;
      s = next;
    }
  return s;
}

// The closest point of the ellipse with semi-axes e around the origin to y >= 0.
template <int dim>
Point<dim>
closest_on_ellipse(const Point<dim> &y, const Point<dim> &e)
{
  unsigned int least = 0;
  for (unsigned int d = 1; d < dim; ++d)
    if (e[d] < e[least] || (e[d] == e[least] && y[d] > y[least]))
      least = d;

  Point<dim> result;
  if (y[least] <= 0)
    {
      // On the plane of symmetry: the foot has a component along the least axis near the centre.
      double rest = 1;
      for (unsigned int d = 0; d < dim; ++d)
        if (e[d] > e[least])
          {
            result[d] = e[d] * e[d] * y[d] / (e[d] * e[d] - e[least] * e[least]);
            rest -= result[d] * result[d] / (e[d] * e[d]);
          }
      if (rest >= 0)
        {
          result[least] = e[least] * std::sqrt(rest);
          return result;
        }
      // Else the foot lies in that plane: drop the axis.
      Point<dim> other_axes = e;
      other_axes[least]     = 2 * e.norm(); // never the least, and y is zero there
      result                = closest_on_ellipse(y, other_axes);
      return result;
    }
  const double s = ellipse_parameter(y, e, least);
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = e[d] * e[d] * y[d] / (s + (e[d] - e[least]) * (e[d] + e[least]));
  return result;
}

} // namespace

template <int dim>
Ball<dim>::Ball(const Point<dim> &centre, const double radius)
    : centre(centre)
    , radius(radius)
{
  Assert(radius > 0, ExcMessage("A radius must be positive."));
}

template <int dim>
double
Ball<dim>::signed_distance(const Point<dim> &x) const
{
  return x.distance(centre) - radius;
}

template <int dim>
BoundingBox<dim>
Ball<dim>::bounding_box() const
{
  return box_around(centre, equal_components<dim>(radius));
}

template <int dim>
Box<dim>::Box(const Point<dim> &lower, const Point<dim> &upper)
    : lower(lower)
    , upper(upper)
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
      const double distance = std::max(lower[d] - x[d], x[d] - upper[d]);
      outside[d]            = std::max(distance, 0.);
      inside                = std::max(inside, distance);
    }
  return inside < 0 ? inside : outside.norm();
}

template <int dim>
BoundingBox<dim>
Box<dim>::bounding_box() const
{
  return BoundingBox<dim>({lower, upper});
}

template <int dim>
HalfSpace<dim>::HalfSpace(const Point<dim> &point, const Tensor<1, dim> &normal)
    : point(point)
    , normal(normal / normal.norm())
{
  Assert(normal.norm() > 0, ExcMessage("A normal must not be zero."));
}

template <int dim>
double
HalfSpace<dim>::signed_distance(const Point<dim> &x) const
{
  return (x - point) * normal;
}

template <int dim>
BoundingBox<dim>
HalfSpace<dim>::bounding_box() const
{
  BoundingBox<dim> result = box_around(Point<dim>(), equal_components<dim>(Shape<dim>::unbounded));
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(normal[d]) == 1)
      (normal[d] > 0 ? result.get_boundary_points().second : result.get_boundary_points().first)[d]
        = point[d];
  return result;
}

template <int dim>
Ellipse<dim>::Ellipse(const Point<dim> &centre, const Point<dim> &semi_axes)
    : centre(centre)
    , semi_axes(semi_axes)
{
  for (unsigned int d = 0; d < dim; ++d)
    Assert(semi_axes[d] > 0, ExcMessage("Semi-axes must be positive."));
}

template <int dim>
double
Ellipse<dim>::signed_distance(const Point<dim> &x) const
{
  Point<dim> y;
  double     level = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      y[d] = std::abs(x[d] - centre[d]);
      level += y[d] * y[d] / (semi_axes[d] * semi_axes[d]);
    }
  const double distance = y.distance(closest_on_ellipse(y, semi_axes));
  return level < 1 ? -distance : distance;
}

template <int dim>
BoundingBox<dim>
Ellipse<dim>::bounding_box() const
{
  return box_around<dim>(centre, semi_axes);
}

template <int dim>
Ring<dim>::Ring(const Point<dim> &centre, const double inner_radius, const double outer_radius)
    : centre(centre)
    , inner_radius(inner_radius)
    , outer_radius(outer_radius)
{
  Assert(0 < inner_radius && inner_radius < outer_radius, ExcMessage("Radii must be in order."));
}

template <int dim>
double
Ring<dim>::signed_distance(const Point<dim> &x) const
{
  const double r = x.distance(centre);
  return std::max(inner_radius - r, r - outer_radius);
}

template <int dim>
BoundingBox<dim>
Ring<dim>::bounding_box() const
{
  return box_around(centre, equal_components<dim>(outer_radius));
}

template <int dim>
Capsule<dim>::Capsule(const Point<dim> &first, const Point<dim> &second, const double radius)
    : first(first)
    , second(second)
    , radius(radius)
{
  Assert(radius > 0, ExcMessage("A radius must be positive."));
}

template <int dim>
double
Capsule<dim>::signed_distance(const Point<dim> &x) const
{
  return distance_to_segment(x, first, second) - radius;
}

template <int dim>
BoundingBox<dim>
Capsule<dim>::bounding_box() const
{
  BoundingBox<dim> result = box_around(first, equal_components<dim>(radius));
  result.merge_with(box_around(second, equal_components<dim>(radius)));
  return result;
}

Polygon::Polygon(const std::vector<Point<2>> &vertices)
    : vertices(vertices)
    , sides(vertices)
{
  Assert(vertices.size() >= 3, ExcMessage("A polygon needs 3 vertices."));
}

double
Polygon::signed_distance(const Point<2> &x) const
{
  return sides.signed_distance(x);
}

BoundingBox<2>
Polygon::bounding_box() const
{
  return BoundingBox<2>(vertices);
}

bool
Polygon::crosses_itself(const std::vector<Point<2>> &vertices)
{
  return PolygonSides(vertices).cross();
}

template <int dim>
Superellipse<dim>::Superellipse(const Point<dim> &centre, const Point<dim> &semi_axes,
                                const double exponent)
    : centre(centre)
    , semi_axes(semi_axes)
    , exponent(exponent)
    , least_axis(*std::min_element(semi_axes.begin_raw(), semi_axes.end_raw()))
{
  Assert(least_axis > 0 && exponent >= 1, ExcMessage("Semi-axes must be positive, n at least 1."));
}

template <int dim>
double
Superellipse<dim>::signed_distance(const Point<dim> &x) const
{
  double sum = 0;
  for (unsigned int d = 0; d < dim; ++d)
    sum += std::pow(std::abs((x[d] - centre[d]) / semi_axes[d]), exponent);
  return (std::pow(sum, 1 / exponent) - 1) * least_axis;
}

template <int dim>
bool
Superellipse<dim>::is_distance() const
{
  return false;
}

template <int dim>
BoundingBox<dim>
Superellipse<dim>::bounding_box() const
{
  return box_around<dim>(centre, semi_axes);
}

#define INSTANTIATE(dim)         \
  template class Ball<dim>;      \
  template class Box<dim>;       \
  template class HalfSpace<dim>; \
  template class Ellipse<dim>;   \
  template class Ring<dim>;      \
  template class Capsule<dim>;   \
  template class Superellipse<dim>;

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
