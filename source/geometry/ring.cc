#include <scree/geometry/ring.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
void
check_ring(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (p.number("Inner radius") >= p.number("Radius"))
    section.error("Inner radius", "'Inner radius' is not less than 'Radius'");
}
} // namespace

template <int dim>
ShapeFamily<dim>
Ring<dim>::family()
{
  return {{"ring"},
          "ring",
          {coordinates("Centre", "Centre of %"), positive_length("Radius", "outer radius of %"),
           positive_length("Inner radius", "Inner radius of %")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Ring<dim>>(p.point("Centre"), p.number("Inner radius"),
                                               p.number("Radius"));
          },
          check_ring<dim>};
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
  BoundingBox<dim> result({centre, centre});
  result.extend(outer_radius);
  return result;
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

template class Ring<2>;
template class Ring<3>;
} // namespace scree
