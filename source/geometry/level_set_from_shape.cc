#include <scree/base/exceptions.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/reboxing.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace scree
{
using namespace dealii;

namespace
{
// More nodes than these (128 MB) are stored in tiles, where the shape is a distance.
constexpr double largest_dense_lattice = 1 << 24;

// The values of the shape, dense or in tiles.
template <int dim>
Lattice<dim>
sampled(const Shape<dim> &shape, const LatticeFrame<dim> &frame, const NodeBox<dim> &box,
        const double margin)
{
  double n_nodes = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_nodes *= box.n_nodes[d];
  if (shape.is_distance() && n_nodes > largest_dense_lattice)
    return Lattice<dim>(
      frame, box.lower, box.n_nodes, [&](const Point<dim> &x) { return shape.signed_distance(x); },
      std::max(margin, Tiles<dim>::edge * frame.spacing));
  Lattice<dim> lattice(frame, box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = shape.signed_distance(lattice.node(lattice.index(i)));
  return lattice;
}

template <int dim>
void
check_finite(const Lattice<dim> &lattice, const std::string &where)
{
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (!std::isfinite(lattice.values()[i]))
      {
        std::ostringstream point;
        point << lattice.node(lattice.index(i));
        throw UserError(where, "the level set is no finite number at the point " + point.str(),
                        "check divisions, roots and logarithms of the expression");
      }
}

// A body of one spacing between two planes of nodes has no negative node: its zeros become those.
template <int dim>
void
fill_thin_body(const Shape<dim> &shape, Lattice<dim> &lattice)
{
  if (lattice.is_tiled())
    return;
  const double tiny = 1e-9 * lattice.spacing();
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    for (unsigned int side = 0; side < 2 * dim && std::abs(lattice.values()[i]) < 0.5 * tiny;
         ++side)
      {
        Point<dim> middle = lattice.node(lattice.index(i));
        middle[side / 2] += (side % 2 == 0 ? -0.5 : 0.5) * lattice.spacing();
        if (shape.signed_distance(middle) < 0)
          lattice.values()[i] = -tiny;
      }
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

// The part of a box that the body needs.
template <int dim>
NodeBox<dim>
trimmed(const Lattice<dim> &lattice, const double margin)
{
  NodeBox<dim> result = node_box_of_body(lattice, margin);
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int first   = std::max(result.lower[d], lattice.lower()[d]),
                end     = std::min(result.lower[d] + result.n_nodes[d],
                                   lattice.lower()[d] + lattice.n_nodes()[d]);
      result.lower[d]   = first;
      result.n_nodes[d] = end - first;
    }
  return result;
}
} // namespace

template <int dim>
std::optional<Lattice<dim>>
find_lattice(const Shape<dim> &shape, const LatticeFrame<dim> &frame, const double margin,
             const std::string &where)
{
  const double           width = std::max(margin, 6 * frame.spacing);
  const BoundingBox<dim> box   = shape.bounding_box();
  Point<dim>             lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::max(box.lower_bound(d), frame.box.lower_bound(d));
      upper[d] = std::min(box.upper_bound(d), frame.box.upper_bound(d));
      if (!(lower[d] < upper[d]))
        return {};
      lower[d] -= width;
      upper[d] += width;
    }

  Lattice<dim> lattice  = sampled(shape, frame, node_box(frame, lower, upper), width);
  const auto   is_empty = [&]() {
    return std::none_of(lattice.values().begin(), lattice.values().end(),
                          [](const double value) { return value < 0; });
  };
  if (is_empty())
    fill_thin_body(shape, lattice);
  if (is_empty())
    return {};
  const NodeBox<dim> needed = trimmed(lattice, width);
  if (needed.n_nodes != lattice.n_nodes())
    lattice = lattice.is_tiled() ? sampled(shape, frame, needed, width) : reboxed(lattice, needed);
  check_finite(lattice, where);
  if (!shape.is_distance() && has_contour(lattice))
    {
      scale_to_one(lattice);
      compute_distances(lattice);
    }
  return lattice;
}

template <int dim>
double
inscribed_radius(const Shape<dim> &shape, const Lattice<dim> &lattice)
{
  constexpr unsigned int   n_starts = 30;
  const double             h        = lattice.spacing();
  const auto              &values   = lattice.values();
  const double             lowest   = *std::min_element(values.begin(), values.end());
  std::vector<std::size_t> deep;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < lowest + 0.25 * h)
      deep.push_back(i);
  double     radius = 0;
  const auto stride = std::max<std::size_t>(1, deep.size() / n_starts);
  for (std::size_t i = 0; i < deep.size(); i += stride)
    {
      Point<dim> x     = lattice.node(lattice.index(deep[i]));
      double     depth = -shape.signed_distance(x);
      for (double step = 0.5 * h; step > 1e-9 * h; step *= 0.5)
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
make_lattice(const Shape<dim> &shape, const LatticeFrame<dim> &frame, const double margin,
             const std::string &where)
{
  const BoundingBox<dim> box = shape.bounding_box();
  for (unsigned int d = 0; d < dim; ++d)
    require(box.lower_bound(d) < frame.box.upper_bound(d)
              && frame.box.lower_bound(d) < box.upper_bound(d),
            where, "the shape lies outside the background grid", "move it, or enlarge the grid");
  std::optional<Lattice<dim>> lattice = find_lattice(shape, frame, margin, where);
  require(lattice.has_value(), where, "the shape contains no node of the background grid",
          "it is empty, outside the grid, or needs smaller cells");
  return *std::move(lattice);
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template double       inscribed_radius(const Shape<dim> &, const Lattice<dim> &);                \
  template Lattice<dim> make_lattice(const Shape<dim> &, const LatticeFrame<dim> &, double,        \
                                     const std::string &);                                         \
  template std::optional<Lattice<dim>> find_lattice(const Shape<dim> &, const LatticeFrame<dim> &, \
                                                    double, const std::string &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
