#include <scree/geometry/lattice_shape.h>

#include <algorithm>

namespace scree
{
using namespace dealii;

namespace
{
/** The box of the contour between nodes, which cubics may leave by little. */
template <int dim>
BoundingBox<dim>
box_of_contour(const Lattice<dim> &lattice)
{
  constexpr double slack = 0.125; // spacings
  Point<dim>       lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = Shape<dim>::unbounded;
      upper[d] = -Shape<dim>::unbounded;
    }
  const auto &values = lattice.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (values[i] >= 0.)
        continue;
      const auto       index = lattice.index(i);
      const Point<dim> node  = lattice.node(index);
      for (unsigned int d = 0; d < dim; ++d)
        for (const int side : {-1, 1})
          {
            auto next = index;
            next[d] += side;
            const double beyond = lattice(next);
            const double part   = beyond > 0. ? values[i] / (values[i] - beyond) : 1.;
            const double end    = node[d] + side * (part + slack) * lattice.spacing();
            lower[d]            = std::min(lower[d], end);
            upper[d]            = std::max(upper[d], end);
          }
    }
  return BoundingBox<dim>({lower, upper});
}
} // namespace

template <int dim>
LatticeShape<dim>::LatticeShape(Lattice<dim> distances)
    : distances(std::move(distances))
    , bounds(box_of_contour(this->distances))
{
}

template <int dim>
double
LatticeShape<dim>::signed_distance(const Point<dim> &x) const
{
  const BoundingBox<dim> &box    = distances.box();
  Point<dim>              inside = x;
  for (unsigned int d = 0; d < dim; ++d)
    inside[d] = std::clamp(x[d], box.lower_bound(d), box.upper_bound(d));
  if (inside == x)
    return distances.value(x, 3);
  const auto [value, gradient] = distances.value_and_gradient(inside, 3);
  return x.distance(inside - value / gradient.norm() * gradient);
}

template <int dim>
BoundingBox<dim>
LatticeShape<dim>::bounding_box() const
{
  return bounds;
}

template class LatticeShape<2>;
template class LatticeShape<3>;
} // namespace scree
