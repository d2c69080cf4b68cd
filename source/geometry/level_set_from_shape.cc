#include <scree/base/exceptions.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/node_search.h>
#include <scree/level_set/reboxing.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
using PointFunction = std::function<double(const Point<dim> &)>;

// Throws UserError where a function is no finite number.
template <int dim>
PointFunction<dim>
checked(const PointFunction<dim> &phi, const std::string &where)
{
  return [phi, where](const Point<dim> &x) {
    const double value = phi(x);
    if (!std::isfinite(value))
      {
        std::ostringstream point;
        point << x;
        throw UserError(where, "the level set is no finite number at the point " + point.str(),
                        "check divisions, roots and logarithms of the expression");
      }
    return value;
  };
}

// A body of one spacing between two planes of nodes has no negative node: its zeros become those.
template <int dim>
PointFunction<dim>
filled(const PointFunction<dim> &phi, const double spacing)
{
  return [phi, spacing](const Point<dim> &x) {
    const double tiny = 1e-9 * spacing, value = phi(x);
    for (unsigned int side = 0; side < 2 * dim && std::abs(value) < 0.5 * tiny; ++side)
      {
        Point<dim> middle = x;
        middle[side / 2] += (side % 2 == 0 ? -0.5 : 0.5) * spacing;
        if (phi(middle) < 0)
          return -tiny;
      }
    return value;
  };
}

template <int dim>
double
n_nodes(const NodeBox<dim> &box)
{
  double result = 1;
  for (unsigned int d = 0; d < dim; ++d)
    result *= box.n_nodes[d];
  return result;
}

template <int dim>
Lattice<dim>
dense_lattice(const PointFunction<dim> &phi, const LatticeFrame<dim> &frame,
              const NodeBox<dim> &box)
{
  Lattice<dim> lattice(frame, box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = phi(lattice.node(lattice.index(i)));
  return lattice;
}

// A level set that is no distance may have values whose squares are no numbers.
template <int dim>
void
scale_to_one(Lattice<dim> &lattice)
{
  double largest = 0.;
  for (const double value : lattice.values())
    largest = std::max(largest, std::abs(value));
  for (double &value : lattice.values())
    value /= largest;
}

template <int dim>
NodeBox<dim>
common_part(const NodeBox<dim> &a, const NodeBox<dim> &b)
{
  NodeBox<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result.lower[d] = std::max(a.lower[d], b.lower[d]);
      result.n_nodes[d]
        = std::min(a.lower[d] + a.n_nodes[d], b.lower[d] + b.n_nodes[d]) - result.lower[d];
    }
  return result;
}

// The lattice of a distance in a box, found without a look at all nodes.
template <int dim>
std::optional<Lattice<dim>>
lattice_of_distance(PointFunction<dim> phi, const LatticeFrame<dim> &frame, const NodeBox<dim> &box,
                    const double margin, const std::string &where, const double most_nodes)
{
  std::optional<NodeBox<dim>> negative = box_of_negative_nodes(frame, box, phi);
  if (!negative)
    {
      phi      = filled<dim>(phi, frame.spacing);
      negative = box_of_negative_nodes(frame, box, phi);
    }
  if (!negative)
    return {};
  const NodeBox<dim> needed      = common_part(box, node_box_around(frame, *negative, margin));
  const auto         checked_phi = checked<dim>(phi, where);
  if (n_nodes(needed) > most_nodes)
    return Lattice<dim>(frame, needed.lower, needed.n_nodes, checked_phi);
  return dense_lattice<dim>(checked_phi, frame, needed);
}

// The lattice of another level set in a box, by fast marching if there is a contour.
template <int dim>
std::optional<Lattice<dim>>
lattice_of_level_set(const PointFunction<dim> &phi, const LatticeFrame<dim> &frame,
                     const NodeBox<dim> &box, const double margin, const std::string &where)
{
  Lattice<dim> lattice  = dense_lattice(phi, frame, box);
  const auto   is_empty = [&]() {
    return std::none_of(lattice.values().begin(), lattice.values().end(),
                          [](const double value) { return value < 0; });
  };
  if (is_empty())
    lattice = dense_lattice(filled<dim>(phi, frame.spacing), frame, box);
  if (is_empty())
    return {};
  const NodeBox<dim> needed = common_part(box, node_box_of_body(lattice, margin));
  if (needed.n_nodes != lattice.n_nodes())
    lattice = reboxed(lattice, needed);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (!std::isfinite(lattice.values()[i]))
      checked<dim>(phi, where)(lattice.node(lattice.index(i)));
  if (has_contour(lattice))
    {
      scale_to_one(lattice);
      compute_distances(lattice);
    }
  return lattice;
}
} // namespace

template <int dim>
std::optional<Lattice<dim>>
find_lattice(const std::shared_ptr<const Shape<dim>> &shape, const LatticeFrame<dim> &frame,
             const double margin, const std::string &where, const double most_nodes)
{
  const double           width  = std::max(margin, 6 * frame.spacing);
  const BoundingBox<dim> bounds = shape->bounding_box();
  Point<dim>             lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::max(bounds.lower_bound(d), frame.box.lower_bound(d));
      upper[d] = std::min(bounds.upper_bound(d), frame.box.upper_bound(d));
      if (!(lower[d] < upper[d]))
        return {};
      lower[d] -= width;
      upper[d] += width;
    }
  const NodeBox<dim> box = node_box(frame, lower, upper);
  const auto         phi = [shape](const Point<dim> &x) { return shape->signed_distance(x); };
  return shape->is_distance() ? lattice_of_distance<dim>(phi, frame, box, width, where, most_nodes)
                              : lattice_of_level_set<dim>(phi, frame, box, width, where);
}

template <int dim>
double
inscribed_radius(const Shape<dim> &shape, const Lattice<dim> &lattice)
{
  constexpr unsigned int n_starts = 30;
  const double           h        = lattice.spacing();
  const auto             deep     = nodes_below(lattice, smallest_value(lattice) + 0.25 * h);
  double                 radius   = 0;
  const auto             stride   = std::max<std::size_t>(1, deep.size() / n_starts);
  for (std::size_t i = 0; i < deep.size(); i += stride)
    {
      Point<dim> x     = lattice.node(deep[i]);
      double     depth = -shape.signed_distance(x);
      for (int halvings = 1; halvings < 30; ++halvings)
        {
          const double step = std::ldexp(h, -halvings);
          for (unsigned int side = 0; side < 2 * dim; ++side)
            {
              Point<dim> trial = x;
              trial[side / 2] += side % 2 == 0 ? -step : step;
              if (const double there = -shape.signed_distance(trial); there > depth)
                {
                  depth = there;
                  x     = trial;
                }
            }
        }
      // The slope of a level set that is no distance, on the steeper side of ridges.
      double square = 0;
      for (unsigned int d = 0; d < dim && !shape.is_distance(); ++d)
        {
          const Tensor<1, dim> step = 1e-3 * h * Point<dim>::unit_vector(d);
          square += std::pow(std::max(std::abs(shape.signed_distance(x + step) + depth),
                                      std::abs(shape.signed_distance(x - step) + depth))
                               / step.norm(),
                             2);
        }
      radius = std::max(radius, shape.is_distance() ? depth : depth / std::sqrt(square));
    }
  return radius;
}

template <int dim>
Lattice<dim>
make_lattice(const std::shared_ptr<const Shape<dim>> &shape, const LatticeFrame<dim> &frame,
             const double margin, const std::string &where, const double most_nodes)
{
  const BoundingBox<dim> box = shape->bounding_box();
  for (unsigned int d = 0; d < dim; ++d)
    require(box.lower_bound(d) < frame.box.upper_bound(d)
              && frame.box.lower_bound(d) < box.upper_bound(d),
            where, "the shape lies outside the background grid", "move it, or enlarge the grid");
  std::optional<Lattice<dim>> lattice = find_lattice(shape, frame, margin, where, most_nodes);
  require(lattice.has_value(), where, "the shape contains no node of the background grid",
          "it is empty, outside the grid, or needs smaller cells");
  return *std::move(lattice);
}

#define SCREE_INSTANTIATE(dim)                                                                              \
  template double                      inscribed_radius(const Shape<dim> &, const Lattice<dim> &);          \
  template Lattice<dim>                make_lattice(const std::shared_ptr<const Shape<dim>> &,              \
                                                    const LatticeFrame<dim> &, double, const std::string &, \
                                                    double);                                                \
  template std::optional<Lattice<dim>> find_lattice(const std::shared_ptr<const Shape<dim>> &,              \
                                                    const LatticeFrame<dim> &, double,                      \
                                                    const std::string &, double);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
