#include <scree/level_set/closest_point.h>
#include <scree/level_set/reboxing.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

template <int dim>
NodeBox<dim>
node_box(const LatticeFrame<dim> &frame, const Point<dim> &lower, const Point<dim> &upper)
{
  NodeBox<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      constexpr double rounding = 1e-6;
      const double     cell     = 2 * frame.spacing;
      const double     s_lower  = (lower[d] - frame.origin[d]) / cell,
                   s_upper      = (upper[d] - frame.origin[d]) / cell;
      result.lower[d]           = 2 * static_cast<int>(std::floor(s_lower + rounding));
      result.n_nodes[d] = 2 * static_cast<int>(std::ceil(s_upper - rounding)) - result.lower[d] + 1;
    }
  return result;
}

template <int dim>
NodeBox<dim>
node_box_around(const LatticeFrame<dim> &frame, const NodeBox<dim> &nodes, const double margin)
{
  Point<dim> lower = frame.origin, upper = frame.origin;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] += frame.spacing * (nodes.lower[d] - 1) - margin;
      upper[d] += frame.spacing * (nodes.lower[d] + nodes.n_nodes[d]) + margin;
    }
  return node_box(frame, lower, upper);
}

namespace
{
// A box that clips nothing.
template <int dim>
BoundingBox<dim>
everywhere(const Lattice<dim> &lattice)
{
  BoundingBox<dim> box = lattice.box();
  box.extend(2 * lattice.spacing());
  return box;
}
} // namespace

template <int dim>
NodeBox<dim>
node_box_of_body(const Lattice<dim> &lattice, const double margin)
{
  return node_box_of_body(lattice, margin, everywhere(lattice));
}

template <int dim>
NodeBox<dim>
node_box_of_body(const Lattice<dim> &lattice, const double margin, const BoundingBox<dim> &box)
{
  const double h        = lattice.spacing();
  Point<dim>   lower    = lattice.box().get_boundary_points().second,
             upper      = lattice.box().get_boundary_points().first;
  BoundingBox<dim> wide = box;
  wide.extend(1e-6 * h);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (lattice.values()[i] < 0)
      {
        const Point<dim> x = lattice.node(lattice.index(i));
        if (!wide.point_inside(x))
          continue;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      }
  for (unsigned int d = 0; d < dim; ++d)
    {
      Assert(lower[d] <= upper[d], ExcMessage("The lattice has no negative node."));
      lower[d] = lower[d] < box.lower_bound(d) + 1.5 * h ? lattice.box().lower_bound(d)
                                                         : lower[d] - margin - h;
      upper[d] = upper[d] > box.upper_bound(d) - 1.5 * h ? lattice.box().upper_bound(d)
                                                         : upper[d] + margin + h;
    }
  return node_box(lattice.frame(), lower, upper);
}

template <int dim>
Lattice<dim>
reboxed(const Lattice<dim> &lattice, const NodeBox<dim> &box)
{
  Lattice<dim> result(lattice.frame(), box.lower, box.n_nodes);
  for (std::size_t i = 0; i < result.values().size(); ++i)
    {
      const auto index = result.index(i);
      if (lattice.contains(index))
        {
          result.values()[i] = lattice(index);
          continue;
        }
      const Point<dim>        x       = result.node(index);
      const double            beyond  = lattice.nodal_value(x);
      const ClosestPoint<dim> closest = closest_point(lattice, x, 3);
      result.values()[i]
        = closest.converged && beyond > 0 ? std::min(beyond, closest.point.distance(x)) : beyond;
    }
  return result;
}

template <int dim>
bool
follow_body(Lattice<dim> &lattice, const double margin)
{
  return follow_body(lattice, margin, everywhere(lattice));
}

template <int dim>
bool
follow_body(Lattice<dim> &lattice, const double margin, const BoundingBox<dim> &box)
{
  const NodeBox<dim> narrow = node_box_of_body(lattice, margin, box),
                     wide   = node_box_of_body(lattice, 2 * margin + 4 * lattice.spacing(), box);
  bool fits                 = true;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int first = lattice.lower()[d], end = first + lattice.n_nodes()[d];
      fits &= first <= narrow.lower[d] && end >= narrow.lower[d] + narrow.n_nodes[d];
      fits &= first >= wide.lower[d] && end <= wide.lower[d] + wide.n_nodes[d];
    }
  if (!fits)
    lattice = reboxed(lattice, node_box_of_body(lattice, 1.5 * margin, box));
  return !fits;
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template NodeBox<dim> node_box(const LatticeFrame<dim> &, const Point<dim> &,                   \
                                 const Point<dim> &);                                             \
  template NodeBox<dim> node_box_around(const LatticeFrame<dim> &, const NodeBox<dim> &, double); \
  template NodeBox<dim> node_box_of_body(const Lattice<dim> &, double);                           \
  template NodeBox<dim> node_box_of_body(const Lattice<dim> &, double, const BoundingBox<dim> &); \
  template Lattice<dim> reboxed(const Lattice<dim> &, const NodeBox<dim> &);                      \
  template bool         follow_body(Lattice<dim> &, double);                                      \
  template bool         follow_body(Lattice<dim> &, double, const BoundingBox<dim> &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
