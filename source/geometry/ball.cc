#include <scree/geometry/ball.h>

namespace scree
{
using namespace dealii;

template <int dim>
ShapeFamily<dim>
Ball<dim>::family()
{
  return {{"disc", "ball"},
          "disc (or ball)",
          {coordinates("Centre", "Centre of %"), positive_length("Radius", "Radius of %")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Ball<dim>>(p.point("Centre"), p.number("Radius"));
          }};
}

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
  BoundingBox<dim> result({centre, centre});
  result.extend(radius);
  return result;
}

template class Ball<2>;
template class Ball<3>;
} // namespace scree
