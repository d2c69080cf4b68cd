#include <scree/geometry/ellipse.h>

#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
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
ShapeFamily<dim>
Ellipse<dim>::family()
{
  return {{"ellipse", "ellipsoid"},
          "ellipse (or ellipsoid)",
          {semi_axes_entry(), coordinates("Centre", "Centre of %")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Ellipse<dim>>(p.point("Centre"), p.point("Semi-axes"));
          }};
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
  const Tensor<1, dim> extent = semi_axes;
  return BoundingBox<dim>({centre - extent, centre + extent});
}

template class Ellipse<2>;
template class Ellipse<3>;
} // namespace scree
