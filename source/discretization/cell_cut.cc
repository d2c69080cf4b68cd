#include <scree/discretization/cell_cut.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace scree
{
namespace
{
using dealii::Point;
using dealii::Tensor;

/** The arrangement of more planes than these in a cell costs too much. */
template <int dim>
constexpr unsigned int most_planes = dim == 2 ? 20 : 10;

/** A convex part of the cell: on which sides of the planes it lies, and whether inside. */
template <int dim>
struct Leaf
{
  Polytope<dim> polytope;
  std::uint64_t above = 0; // bit p: before plane p
  bool          is_inside;
};

/** Whether a contour passes so near to a node that Saye's rules may lose half the cell. */
template <int dim>
bool
is_close_to_node(const CellCut<dim> &cut, const unsigned int n_nodes)
{
  return std::any_of(cut.scaled.begin(), cut.scaled.begin() + n_nodes,
                     [](const double value) { return std::abs(value) < 1e-6; });
}

template <int dim>
class Cutter
{
public:
  Cutter(const Shape<dim> &shape, const LagrangeBasis<dim> &basis,
         const std::vector<Point<dim>> &nodes, const double cell_size)
      : shape(shape)
      , basis(basis)
      , nodes(nodes)
      , cell_size(cell_size)
  {
    dealii::BoundingBox<dim> box(nodes);
    box.extend((basis.degree == 1 ? 1e-9 : 0.05) * cell_size);
    shape.append_pieces(box, pieces);
  }

  CellCut<dim> cut();

private:
  /** The value of the shape at a point in unit coordinates, of the cell or near to it. */
  bool is_inside(const Point<dim> &unit_point) const
  {
    double     weight[max_nodes_per_cell<dim>];
    Point<dim> x;
    basis.evaluate_values(unit_point, weight);
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      x += weight[i] * Tensor<1, dim>(nodes[i]);
    return shape.signed_distance(x) < 0.;
  }

  CellCut<dim>                whole(const bool inside) const;
  std::optional<CellCut<dim>> smooth(const SmoothPiece<dim> &piece, const bool must_agree) const;
  void                        find_planes();
  void                        divide();
  unsigned int                mark_surface();

  const Shape<dim>              &shape;
  const LagrangeBasis<dim>      &basis;
  const std::vector<Point<dim>> &nodes;
  const double                   cell_size;
  std::vector<SmoothPiece<dim>>  pieces;
  std::vector<CellPlane<dim>>    planes;
  std::vector<unsigned int>      piece_of_plane;
  std::vector<Leaf<dim>>         leaves;
};

template <int dim>
CellCut<dim>
Cutter<dim>::whole(const bool inside) const
{
  CellCut<dim> result;
  result.location = inside ? CellLocation::inside : CellLocation::outside;
  return result;
}

/** The cut by one piece with values of degree k; none if they do not show that the cell is cut. */
template <int dim>
std::optional<CellCut<dim>>
Cutter<dim>::smooth(const SmoothPiece<dim> &piece, const bool must_agree) const
{
  std::array<double, max_nodes_per_cell<dim>> values;
  CellCut<dim>                                result;
  double                                      largest = 0.;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    {
      values[i] = piece.value(nodes[i]);
      largest   = std::max(largest, std::abs(values[i]));
    }
  // Of the size of a distance, whatever the slope.
  if (largest < 1e-3 * cell_size || largest > 1e3 * cell_size)
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      values[i] *= cell_size / largest;
  nudge(values.data(), basis.n_nodes, cell_size, result.scaled.data());
  result.location = location_of(result.scaled.data(), basis.n_nodes);
  if (result.location != CellLocation::cut)
    return {};
  for (unsigned int i = 0; must_agree && i < basis.n_nodes; ++i)
    if (std::abs(result.scaled[i]) > 1e-9
        && (result.scaled[i] < 0.) != (shape.signed_distance(nodes[i]) < 0.))
      return {};
  return result;
}

template <int dim>
void
Cutter<dim>::find_planes()
{
  constexpr unsigned int                      n_vertices = 1u << dim;
  constexpr double                            tolerance  = Polytope<dim>::tolerance;
  const unsigned int                          k          = basis.degree;
  std::vector<std::array<double, n_vertices>> known;
  for (unsigned int p = 0; p < pieces.size(); ++p)
    {
      CellPlane<dim> plane{{}, 0.};
      double         largest = 0.;
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          unsigned int node = 0, stride = k;
          for (unsigned int d = 0; d < dim; ++d, stride *= k + 1)
            node += (v >> d & 1u) * stride;
          const double value = pieces[p].value(nodes[node]) / (cell_size * n_vertices);
          plane.offset += value;
          largest = std::max(largest, std::abs(value));
          for (unsigned int d = 0; d < dim; ++d)
            plane.normal[d] += 2. * ((v >> d & 1u) != 0 ? value : -value);
        }
      const double slope = plane.normal.norm();
      if (!(slope > 1e-6 * largest))
        continue;
      plane.normal /= slope;
      plane.offset /= slope;
      for (unsigned int d = 0; d < dim; ++d)
        plane.offset -= 0.5 * plane.normal[d];

      std::array<double, n_vertices> distance;
      for (unsigned int v = 0; v < n_vertices; ++v)
        distance[v] = plane.distance(dealii::GeometryInfo<dim>::unit_cell_vertex(v));
      const auto [lowest, highest] = std::minmax_element(distance.begin(), distance.end());
      if (*lowest > tolerance || *highest < -tolerance)
        continue;
      const auto is_same = [&](const auto &other) {
        for (const double sign : {-1., 1.})
          {
            double largest = 0.;
            for (unsigned int v = 0; v < n_vertices; ++v)
              largest = std::max(largest, std::abs(distance[v] - sign * other[v]));
            if (largest < 2. * tolerance)
              return true;
          }
        return false;
      };
      if (std::any_of(known.begin(), known.end(), is_same))
        continue;
      known.push_back(distance);
      planes.push_back(plane);
      piece_of_plane.push_back(p);
    }
}

template <int dim>
void
Cutter<dim>::divide()
{
  leaves = {{Polytope<dim>::unit_cell(), 0, false}};
  for (unsigned int p = 0; p < planes.size(); ++p)
    {
      std::vector<Leaf<dim>> next;
      for (const auto &leaf : leaves)
        {
          auto [below, above] = leaf.polytope.split(planes[p], p);
          if (below)
            next.push_back({std::move(*below), leaf.above, false});
          if (above)
            next.push_back({std::move(*above), leaf.above | std::uint64_t(1) << p, false});
        }
      leaves = std::move(next);
    }
  for (auto &leaf : leaves)
    leaf.is_inside = is_inside(leaf.polytope.middle());
}

/** Marks the facets of parts inside that are surface; @return the planes with such facets. */
template <int dim>
unsigned int
Cutter<dim>::mark_surface()
{
  constexpr double              beyond = 1e-6;
  std::map<std::uint64_t, bool> inside_of;
  for (const auto &leaf : leaves)
    inside_of[leaf.above] = leaf.is_inside;
  std::uint64_t active = 0;
  for (auto &leaf : leaves)
    for (auto &facet : leaf.polytope.facets)
      {
        if (!leaf.is_inside || facet.plane < 0)
          continue;
        const std::uint64_t bit    = std::uint64_t(1) << facet.plane;
        Tensor<1, dim>      normal = planes[facet.plane].normal;
        if ((leaf.above & bit) != 0)
          normal *= -1.;
        const auto other = inside_of.find(leaf.above ^ bit);
        bool       is_covered;
        if (facet.face < 0 && other != inside_of.end())
          is_covered = other->second;
        else
          {
            Point<dim> middle;
            for (const auto &x : facet.vertices)
              middle += Tensor<1, dim>(x) / double(facet.vertices.size());
            is_covered = is_inside(middle + beyond * normal);
          }
        if (is_covered)
          continue;
        facet.normal = normal;
        active |= bit;
      }
  unsigned int n_active = 0;
  for (; active != 0; active &= active - 1)
    ++n_active;
  return n_active;
}

template <int dim>
CellCut<dim>
Cutter<dim>::cut()
{
  Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  if (pieces.empty())
    return whole(is_inside(middle));
  if (pieces.size() == 1 && !pieces[0].is_plane())
    if (const auto result = smooth(pieces[0], true))
      return *result;
  find_planes();
  if (planes.empty())
    return whole(is_inside(middle));
  if (planes.size() > most_planes<dim>)
    {
      const auto result = smooth(
        SmoothPiece<dim>([this](const Point<dim> &x) { return shape.signed_distance(x); }), false);
      return result ? *result : whole(is_inside(middle));
    }
  divide();
  const unsigned int n_active = mark_surface();
  const bool         is_filled
    = std::all_of(leaves.begin(), leaves.end(), [](const auto &leaf) { return leaf.is_inside; });
  const auto surface_of = [](const Leaf<dim> &leaf) {
    return std::find_if(leaf.polytope.facets.begin(), leaf.polytope.facets.end(),
                        [](const auto &facet) { return facet.is_surface(); });
  };
  if (n_active == 0)
    return whole(is_filled);
  if (n_active == 1 && !is_filled)
    for (const auto &leaf : leaves)
      if (const auto facet = surface_of(leaf); facet != leaf.polytope.facets.end())
        {
          const auto &piece       = pieces[piece_of_plane[facet->plane]];
          const bool  is_reversed = facet->normal * planes[facet->plane].normal < 0.;
          const auto  result      = smooth(is_reversed ? piece.reversed() : piece, false);
          if (result && !(piece.is_plane() && is_close_to_node(*result, basis.n_nodes)))
            return *result;
          break;
        }
  CellCut<dim> result;
  result.location = CellLocation::cut;
  for (auto &leaf : leaves)
    if (leaf.is_inside)
      result.parts.push_back(std::move(leaf.polytope));
  return result;
}
} // namespace

void
nudge(const double *values, const unsigned int n, const double cell_size, double *scaled)
{
  for (unsigned int i = 0; i < n; ++i)
    {
      scaled[i] = values[i] / cell_size;
      if (std::abs(scaled[i]) < 1e-12)
        scaled[i] = 1e-12;
    }
}

CellLocation
location_of(const double *scaled, const unsigned int n)
{
  const unsigned int n_negative
    = std::count_if(scaled, scaled + n, [](const double value) { return value < 0.; });
  return n_negative == 0   ? CellLocation::outside
         : n_negative == n ? CellLocation::inside
                           : CellLocation::cut;
}

template <int dim>
CellCut<dim>
cut_by_pieces(const Shape<dim> &shape, const LagrangeBasis<dim> &basis,
              const std::vector<Point<dim>> &nodes, const double cell_size)
{
  return Cutter<dim>(shape, basis, nodes, cell_size).cut();
}

#define SCREE_INSTANTIATE(dim)                                                        \
  template CellCut<dim> cut_by_pieces(const Shape<dim> &, const LagrangeBasis<dim> &, \
                                      const std::vector<dealii::Point<dim>> &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
