#include <scree/geometry/superellipse.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
void
check_superellipse(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (p.number("Exponent") < 1)
    section.error("Exponent", "'Exponent' must be at least 1");
}
} // namespace

template <int dim>
ShapeFamily<dim>
Superellipse<dim>::family()
{
  return {{"superellipse"},
          "superellipse",
          {coordinates("Centre", "Centre of %"),
           semi_axes_entry(),
           {"Exponent", "Exponent n >= 1 of the superellipse |x/a|^n + |y/b|^n (+ |z/c|^n) < 1", "",
            unset_number}},
          [](const ShapeParameters<dim> &p) -> ShapePointer<dim> {
            return std::make_unique<Superellipse<dim>>(p.point("Centre"), p.point("Semi-axes"),
                                                       p.number("Exponent"));
          },
          check_superellipse<dim>};
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
  const Tensor<1, dim> extent = semi_axes;
  return BoundingBox<dim>({centre - extent, centre + extent});
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

template class Superellipse<2>;
template class Superellipse<3>;
} // namespace scree
