#include <scree/geometry/half_space.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
void
check_half_space(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const auto &normal = p.coordinates("Normal");
  if (!normal.empty()
      && std::all_of(normal.begin(), normal.end(), [](const double value) { return value == 0; }))
    section.error("Normal", "'Normal' is zero", "give the outward direction");
}
} // namespace

template <int dim>
ShapeFamily<dim>
HalfSpace<dim>::family()
{
  return {{"half space"},
          "half space",
          {coordinates("Point", "A point on the surface of %"),
           coordinates("Normal", "Outward normal of %, of any length", "")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<HalfSpace<dim>>(p.point("Point"), p.point("Normal"));
          },
          check_half_space<dim>};
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
  BoundingBox<dim> result = unbounded_box<dim>();
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(normal[d]) == 1)
      (normal[d] > 0 ? result.get_boundary_points().second : result.get_boundary_points().first)[d]
        = point[d];
  return result;
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

template class HalfSpace<2>;
template class HalfSpace<3>;
} // namespace scree
