#include <scree/geometry/capsule.h>
#include <scree/geometry/segment.h>

#include <algorithm>

namespace scree
{
using namespace dealii;

template <int dim>
ShapeFamily<dim>
Capsule<dim>::family()
{
  return {{"capsule"},
          "capsule",
          {coordinates("First point", "One end of the axis of %"),
           coordinates("Second point", "The other end of the axis of %"),
           positive_length("Radius", "Radius of %")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Capsule<dim>>(p.point("First point"), p.point("Second point"),
                                                  p.number("Radius"));
          }};
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
  BoundingBox<dim> result(std::vector<Point<dim>>{first, second});
  result.extend(radius);
  return result;
}

template class Capsule<2>;
template class Capsule<3>;
} // namespace scree
