#include <scree/geometry/box.h>

#include <algorithm>

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
}
} // namespace

template <int dim>
ShapeFamily<dim>
Box<dim>::family()
{
  return {{"box"},
          "box",
          {coordinates("Lower corner", "Lower corner of %"),
           coordinates("Upper corner", "Upper corner of %")},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Box<dim>>(p.point("Lower corner"), p.point("Upper corner"));
          },
          check_box<dim>};
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

template class Box<2>;
template class Box<3>;
} // namespace scree
