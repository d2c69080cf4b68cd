#include <scree/base/exceptions.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/fast_marching.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
// A lattice between two corners, from an even node to an even node. Corners that are such nodes up
// to rounding stay so.
template <int dim>
Lattice<dim>
lattice_around(const LatticeFrame<dim> &frame, const Point<dim> &lower, const Point<dim> &upper)
{
  typename Lattice<dim>::Index first, n_nodes;
  for (unsigned int d = 0; d < dim; ++d)
    {
      constexpr double rounding = 1e-6;
      const double     cell     = 2 * frame.spacing;
      const double     s_lower  = (lower[d] - frame.origin[d]) / cell,
                   s_upper      = (upper[d] - frame.origin[d]) / cell;
      first[d]                  = 2 * static_cast<int>(std::floor(s_lower + rounding));
      n_nodes[d] = 2 * static_cast<int>(std::ceil(s_upper - rounding)) - first[d] + 1;
    }
  return Lattice<dim>(frame, first, n_nodes);
}

// The part of a lattice within `margin` of its negative nodes (there is at least one).
template <int dim>
Lattice<dim>
trimmed(const Lattice<dim> &lattice, const double margin)
{
  Point<dim> lower = lattice.box().get_boundary_points().second,
             upper = lattice.box().get_boundary_points().first;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (lattice.values()[i] < 0)
      {
        const Point<dim> x = lattice.node(lattice.index(i));
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      }
  for (unsigned int d = 0; d < dim; ++d)
    {
      // The contour is up to one spacing beyond the negative nodes.
      const double width = margin + lattice.spacing();
      lower[d]           = std::max(lower[d] - width, lattice.box().lower_bound(d));
      upper[d]           = std::min(upper[d] + width, lattice.box().upper_bound(d));
    }
  Lattice<dim> result = lattice_around(lattice.frame(), lower, upper);
  for (std::size_t i = 0; i < result.values().size(); ++i)
    result.values()[i] = lattice(result.index(i));
  return result;
}
} // namespace

template <int dim>
Lattice<dim>
make_lattice(const Shape<dim> &shape, const LatticeFrame<dim> &frame, const double margin,
             const std::string &where)
{
  const double           width = std::max(margin, 6 * frame.spacing);
  const BoundingBox<dim> box   = shape.bounding_box();
  Point<dim>             lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::max(box.lower_bound(d), frame.box.lower_bound(d));
      upper[d] = std::min(box.upper_bound(d), frame.box.upper_bound(d));
      require(lower[d] < upper[d], where, "the shape lies outside the background grid",
              "move it, or enlarge the grid");
      lower[d] -= width;
      upper[d] += width;
    }

  Lattice<dim> lattice = lattice_around(frame, lower, upper);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = shape.signed_distance(lattice.node(lattice.index(i)));
  require(std::any_of(lattice.values().begin(), lattice.values().end(),
                      [](const double value) { return value < 0; }),
          where, "the shape contains no node of the background grid",
          "it is empty, outside the grid, or needs smaller cells");
  lattice = trimmed(lattice, width);
  if (!shape.is_distance() && has_contour(lattice))
    compute_distances(lattice);
  return lattice;
}

template Lattice<2> make_lattice(const Shape<2> &, const LatticeFrame<2> &, double,
                                 const std::string &);
template Lattice<3> make_lattice(const Shape<3> &, const LatticeFrame<3> &, double,
                                 const std::string &);
} // namespace scree
