#include <scree/discretization/polytope.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
namespace
{
using dealii::Point;
using dealii::Tensor;

/** The parts of a facet on both sides of a plane, by the distances of its vertices. */
template <int dim>
std::array<Facet<dim>, 2>
clip(const Facet<dim> &facet, const std::vector<double> &distance)
{
  constexpr double          tolerance = Polytope<dim>::tolerance;
  std::array<Facet<dim>, 2> parts;
  for (auto &part : parts)
    {
      part.face  = facet.face;
      part.plane = facet.plane;
    }
  const std::size_t n       = facet.vertices.size();
  const std::size_t n_edges = dim == 2 ? 1 : n;
  for (std::size_t i = 0; i < n; ++i)
    {
      const Point<dim> &here = facet.vertices[i];
      if (distance[i] <= tolerance)
        parts[0].vertices.push_back(here);
      if (distance[i] >= -tolerance)
        parts[1].vertices.push_back(here);
      if (i >= n_edges)
        continue;
      const std::size_t j   = (i + 1) % n;
      const double      low = std::min(distance[i], distance[j]),
                   high     = std::max(distance[i], distance[j]);
      if (low < -tolerance && high > tolerance)
        {
          // From below to above, so that both facets of an edge find the same point.
          const Point<dim> &below   = distance[i] < 0. ? here : facet.vertices[j];
          const Point<dim> &above   = distance[i] < 0. ? facet.vertices[j] : here;
          const Point<dim>  between = below + low / (low - high) * (above - below);
          parts[0].vertices.push_back(between);
          parts[1].vertices.push_back(between);
        }
    }
  const auto [lowest, highest] = std::minmax_element(distance.begin(), distance.end());
  if (*lowest >= -tolerance)
    parts[0].vertices.clear();
  if (*highest <= tolerance)
    parts[1].vertices.clear();
  return parts;
}

/** Appends a point that is not there yet. */
template <int dim>
void
append_new(const Point<dim> &x, std::vector<Point<dim>> &points)
{
  if (std::none_of(points.begin(), points.end(), [&](const Point<dim> &y) {
        return x.distance_square(y) < std::pow(0.1 * Polytope<dim>::tolerance, 2);
      }))
    points.push_back(x);
}

/** Puts the corners of a convex polygon in order. */
template <int dim>
void
order_around([[maybe_unused]] const Tensor<1, dim>    &normal,
             [[maybe_unused]] std::vector<Point<dim>> &points)
{
  if constexpr (dim == 3)
    {
      Point<dim> middle;
      for (const auto &x : points)
        middle += Tensor<1, dim>(x) / double(points.size());
      const auto farthest
        = std::max_element(points.begin(), points.end(), [&](const auto &x, const auto &y) {
            return x.distance_square(middle) < y.distance_square(middle);
          });
      const Tensor<1, dim> s = (*farthest - middle) / farthest->distance(middle);
      const Tensor<1, dim> t = dealii::cross_product_3d(normal, s);
      const auto           angle
        = [&](const Point<dim> &x) { return std::atan2((x - middle) * t, (x - middle) * s); };
      std::sort(points.begin(), points.end(),
                [&](const auto &x, const auto &y) { return angle(x) < angle(y); });
    }
}

template <int dim>
double
volume_of(const std::vector<Point<dim>> &simplex)
{
  Tensor<2, dim> edges;
  for (unsigned int d = 0; d < dim; ++d)
    edges[d] = simplex[d + 1] - simplex[0];
  return std::abs(determinant(edges)) / (dim == 2 ? 2. : 6.);
}
} // namespace

template <int dim>
Polytope<dim>
Polytope<dim>::unit_cell()
{
  using Info = dealii::GeometryInfo<dim>;
  Polytope result;
  for (unsigned int f = 0; f < Info::faces_per_cell; ++f)
    {
      Facet<dim> facet;
      facet.face = f;
      for (unsigned int v = 0; v < Info::vertices_per_face; ++v)
        {
          const unsigned int around = dim == 3 && v >= 2 ? 5 - v : v;
          facet.vertices.push_back(Info::unit_cell_vertex(Info::face_to_cell_vertices(f, around)));
        }
      result.facets.push_back(facet);
    }
  return result;
}

template <int dim>
bool
Polytope<dim>::is_unit_cell() const
{
  if (facets.size() != dealii::GeometryInfo<dim>::faces_per_cell)
    return false;
  const auto box = as_box();
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = 1.;
  return box && box->first.norm() < tolerance && box->second.distance(corner) < tolerance;
}

template <int dim>
std::pair<std::optional<Polytope<dim>>, std::optional<Polytope<dim>>>
Polytope<dim>::split(const CellPlane<dim> &plane, const int number) const
{
  std::vector<std::vector<double>> distances;
  double                           lowest = 0., highest = 0.;
  for (const auto &facet : facets)
    {
      distances.emplace_back();
      for (const auto &x : facet.vertices)
        {
          distances.back().push_back(plane.distance(x));
          lowest  = std::min(lowest, distances.back().back());
          highest = std::max(highest, distances.back().back());
        }
    }
  const auto whole = [&]() -> std::pair<std::optional<Polytope>, std::optional<Polytope>> {
    Polytope result = *this;
    for (std::size_t f = 0; f < facets.size(); ++f)
      if (std::all_of(distances[f].begin(), distances[f].end(),
                      [](const double value) { return std::abs(value) <= tolerance; }))
        result.facets[f].plane = number;
    if (highest > -lowest)
      return {std::nullopt, result};
    return {result, std::nullopt};
  };
  if (lowest >= -tolerance || highest <= tolerance)
    return whole();

  std::array<Polytope, 2> parts;
  Facet<dim>              cap;
  cap.plane = number;
  for (std::size_t f = 0; f < facets.size(); ++f)
    {
      std::array<Facet<dim>, 2> sides = clip(facets[f], distances[f]);
      for (unsigned int side = 0; side < 2; ++side)
        if (sides[side].vertices.size() >= dim)
          parts[side].facets.push_back(std::move(sides[side]));
      for (const auto &x : facets[f].vertices)
        if (std::abs(plane.distance(x)) <= tolerance)
          append_new(x, cap.vertices);
    }
  for (const auto &facet : parts[0].facets)
    for (const auto &x : facet.vertices)
      if (std::abs(plane.distance(x)) <= tolerance)
        append_new(x, cap.vertices);
  if (cap.vertices.size() < dim)
    return whole();
  order_around<dim>(plane.normal, cap.vertices);
  for (auto &part : parts)
    part.facets.push_back(cap);
  return {std::move(parts[0]), std::move(parts[1])};
}

template <int dim>
Point<dim>
Polytope<dim>::middle() const
{
  Tensor<1, dim> sum;
  unsigned int   n = 0;
  for (const auto &facet : facets)
    for (const auto &x : facet.vertices)
      {
        sum += x;
        ++n;
      }
  return Point<dim>(sum / n);
}

template <int dim>
std::optional<std::pair<Point<dim>, Point<dim>>>
Polytope<dim>::as_box() const
{
  if (facets.size() != 2 * dim)
    return {};
  Point<dim> lower = facets[0].vertices[0], upper = lower;
  for (const auto &facet : facets)
    for (const auto &x : facet.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
  // Each side of the box is a facet.
  unsigned int sides = 0;
  for (const auto &facet : facets)
    for (unsigned int d = 0; d < dim; ++d)
      for (const bool above : {false, true})
        if (const double plane = above ? upper[d] : lower[d];
            std::all_of(facet.vertices.begin(), facet.vertices.end(),
                        [&](const auto &x) { return std::abs(x[d] - plane) <= tolerance; }))
          sides |= 1u << (2 * d + above);
  if (sides != (1u << 2 * dim) - 1)
    return {};
  return std::make_pair(lower, upper);
}

template <int dim>
std::vector<std::vector<Point<dim>>>
Polytope<dim>::simplices() const
{
  // All from one vertex; facets that contain it add nothing.
  constexpr double                     negligible = 1e-20;
  const Point<dim>                    &apex       = facets[0].vertices[0];
  std::vector<std::vector<Point<dim>>> result;
  for (const auto &facet : facets)
    if (std::none_of(facet.vertices.begin(), facet.vertices.end(), [&](const Point<dim> &x) {
          return x.distance_square(apex) < tolerance * tolerance;
        }))
      for (auto &simplex : simplices_of(facet))
        {
          simplex.push_back(apex);
          if (volume_of(simplex) > negligible)
            result.push_back(std::move(simplex));
        }
  return result;
}

template <int dim>
double
Polytope<dim>::volume() const
{
  double result = 0.;
  for (const auto &simplex : simplices())
    result += volume_of(simplex);
  return result;
}

template <int dim>
std::vector<std::vector<Point<dim>>>
simplices_of(const Facet<dim> &facet)
{
  if (dim == 2)
    return {facet.vertices};
  std::vector<std::vector<Point<dim>>> result;
  for (std::size_t i = 1; i + 1 < facet.vertices.size(); ++i)
    result.push_back({facet.vertices[0], facet.vertices[i], facet.vertices[i + 1]});
  return result;
}

#define SCREE_INSTANTIATE(dim)  \
  template class Polytope<dim>; \
  template std::vector<std::vector<dealii::Point<dim>>> simplices_of(const Facet<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
