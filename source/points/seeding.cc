#include <scree/discretization/polytope_rules.h>
#include <scree/points/seeding.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace scree
{
using namespace dealii;

namespace
{
/** Lower corner of sub-cell `i` of m^dim, x fastest, in unit coordinates. */
template <int dim>
Point<dim>
sub_cell_corner(unsigned int i, const unsigned int m)
{
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d, i /= m)
    corner[d] = double(i % m) / m;
  return corner;
}

/** The parts of a cell's sub-cells inside the body: their centroids and volumes. */
template <int dim>
CellPoints<dim>
sub_cell_parts(CutCellRules<dim> &rules, const double *scaled, const double size,
               const unsigned int m)
{
  const LagrangeBasis<dim> &basis = rules.basis;
  CellPoints<dim>           result;
  const unsigned int        n_sub_cells = dim == 2 ? m * m : m * m * m;
  for (unsigned int i = 0; i < n_sub_cells; ++i)
    {
      const Point<dim> corner = sub_cell_corner<dim>(i, m);
      double           values[max_nodes_per_cell<dim>], shape[max_nodes_per_cell<dim>];
      bool             is_positive = true;
      for (unsigned int node = 0; node < basis.n_nodes; ++node)
        {
          basis.evaluate_values(corner + Tensor<1, dim>(basis.node(node)) / m, shape);
          values[node] = m * std::inner_product(shape, shape + basis.n_nodes, scaled, 0.);
          is_positive  = is_positive && values[node] > 0.;
        }
      if (is_positive)
        continue;
      const CellPoints<dim> inside = rules.rules(values, size / m).inside;
      double                volume = 0.;
      Tensor<1, dim>        moment;
      for (std::size_t q = 0; q < inside.points.size(); ++q)
        {
          volume += inside.weights[q];
          moment += inside.weights[q] * Tensor<1, dim>(inside.points[q]);
        }
      if (!(volume > 0.))
        continue;
      result.points.push_back(corner + moment / (volume * m));
      result.weights.push_back(volume);
    }
  return result;
}

/** The same of a body that is a set of convex parts. */
template <int dim>
CellPoints<dim>
sub_cell_parts(const std::vector<Polytope<dim>> &parts, const unsigned int n_gauss,
               const double size, const unsigned int m)
{
  // Divided by the planes between the sub-cells, the pieces of each sub-cell gathered.
  std::vector<Polytope<dim>> pieces = parts;
  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int i = 1; i < m; ++i)
      {
        const CellPlane<dim>       plane{Point<dim>::unit_vector(d), -double(i) / m};
        std::vector<Polytope<dim>> next;
        for (const auto &piece : pieces)
          {
            auto [below, above] = piece.split(plane, -1);
            for (auto &part : {below, above})
              if (part)
                next.push_back(*part);
          }
        pieces = std::move(next);
      }
  std::map<unsigned int, std::pair<double, Tensor<1, dim>>> sums;
  for (const auto &piece : pieces)
    {
      const Point<dim> middle   = piece.middle();
      unsigned int     sub_cell = 0, stride = 1;
      for (unsigned int d = 0; d < dim; ++d, stride *= m)
        sub_cell += std::min(static_cast<unsigned int>(middle[d] * m), m - 1) * stride;
      CellPoints<dim> rule;
      append_rule(piece, n_gauss, size, rule);
      auto &[volume, moment] = sums[sub_cell];
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        {
          volume += rule.weights[q];
          moment += rule.weights[q] * Tensor<1, dim>(rule.points[q]);
        }
    }
  CellPoints<dim> result;
  for (const auto &[sub_cell, sum] : sums)
    if (sum.first > 0.)
      {
        result.points.push_back(Point<dim>(sum.second / sum.first));
        result.weights.push_back(sum.first);
      }
  return result;
}

/** Joins parts below `smallest` to the nearest larger one, or all to one if there is none. */
template <int dim>
CellPoints<dim>
join_small_parts(const CellPoints<dim> &parts, const double smallest)
{
  CellPoints<dim> result;
  for (std::size_t i = 0; i < parts.points.size(); ++i)
    if (parts.weights[i] >= smallest)
      {
        result.points.push_back(parts.points[i]);
        result.weights.push_back(parts.weights[i]);
      }
  if (result.points.empty() && !parts.points.empty())
    {
      const auto largest = std::max_element(parts.weights.begin(), parts.weights.end());
      result.points      = {parts.points[largest - parts.weights.begin()]};
      result.weights     = {std::accumulate(parts.weights.begin(), parts.weights.end(), 0.)};
      return result;
    }
  for (std::size_t i = 0; i < parts.points.size(); ++i)
    if (parts.weights[i] < smallest)
      {
        std::size_t nearest = 0;
        for (std::size_t j = 1; j < result.points.size(); ++j)
          if (parts.points[i].distance_square(result.points[j])
              < parts.points[i].distance_square(result.points[nearest]))
            nearest = j;
        result.weights[nearest] += parts.weights[i];
      }
  return result;
}
} // namespace

template <int dim>
PointSeeding<dim>::PointSeeding(const DisplacementSpace<dim> &space,
                                const LevelSetNodes<dim>     &level_set_nodes,
                                const std::vector<Body<dim>> &bodies,
                                const CutQuadrature<dim>     &quadrature,
                                const std::vector<double>    &density)
    : space(space)
    , level_set_nodes(level_set_nodes)
    , bodies(bodies)
    , quadrature(quadrature)
    , density(density)
{
  AssertDimension(density.size(), bodies.size());
}

template <int dim>
void
PointSeeding<dim>::add_cell(MaterialPoints<dim> &points, const unsigned int active_cell,
                            const CellPoints<dim> &cell_points,
                            const unsigned int     n_per_direction) const
{
  const unsigned int body    = space.cells()[active_cell].body;
  const double       spacing = space.cell_size(active_cell) / n_per_direction;
  const double       rho     = density[body] * whole_volume_ratio(active_cell, cell_points);
  for (std::size_t q = 0; q < cell_points.points.size(); ++q)
    points.add(space.position(active_cell, cell_points.points[q]), body, cell_points.weights[q],
               spacing, rho * cell_points.weights[q]);
}

template <int dim>
double
PointSeeding<dim>::whole_volume_ratio(const unsigned int     active_cell,
                                      const CellPoints<dim> &cell_points) const
{
  const auto &surface = quadrature.surface;
  double      strips  = 0.;
  for (unsigned int q = surface.begin[active_cell]; q < surface.begin[active_cell + 1]; ++q)
    strips += quadrature.strip_widths[q] * surface.weights[q];
  const double volume = std::accumulate(cell_points.weights.begin(), cell_points.weights.end(), 0.);
  return volume > 0. ? std::max(0., 1. + strips / volume) : 1.;
}

/** The bulk quadrature of an active cell, weights in physical measure. */
template <int dim>
CellPoints<dim>
PointSeeding<dim>::quadrature_points(const unsigned int active_cell) const
{
  const ActiveCell &cell = space.cells()[active_cell];
  CellPoints<dim>   result;
  if (cell.is_cut)
    {
      const auto &bulk  = quadrature.bulk;
      const auto  first = bulk.begin[active_cell], last = bulk.begin[active_cell + 1];
      result.points.assign(bulk.points.begin() + first, bulk.points.begin() + last);
      result.weights.assign(bulk.weights.begin() + first, bulk.weights.begin() + last);
      return result;
    }
  result              = quadrature.whole_cell;
  const double volume = std::pow(space.grid.cells()[cell.grid_cell].size, dim);
  for (double &weight : result.weights)
    weight *= volume;
  return result;
}

template <int dim>
MaterialPoints<dim>
PointSeeding<dim>::at_quadrature_points(const unsigned int n_internal) const
{
  MaterialPoints<dim> points(n_internal);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    add_cell(points, a, quadrature_points(a), level_set_nodes.gauss().bulk);
  return points;
}

template <int dim>
MaterialPoints<dim>
PointSeeding<dim>::on_sub_grid(const unsigned int m, const unsigned int n_internal) const
{
  Assert(m > 0, ExcMessage("A cell needs a point."));
  MaterialPoints<dim> points(n_internal);
  CutCellRules<dim>   rules = level_set_nodes.rules();
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell       = space.cells()[a];
      const double      size       = space.grid.cells()[cell.grid_cell].size;
      const double      sub_volume = std::pow(size / m, dim);
      CellPoints<dim>   parts;
      if (cell.is_cut)
        {
          const CellPoints<dim> exact = quadrature_points(a);
          if (exact.points.empty())
            continue;
          const CellCut<dim> cut = level_set_nodes.cut(cell.grid_cell, bodies[cell.body]);
          parts                  = join_small_parts(cut.parts.empty()
                                                      ? sub_cell_parts(rules, cut.scaled.data(), size, m)
                                                      : sub_cell_parts(cut.parts, rules.gauss.bulk, size, m),
                                   0.1 * sub_volume);
          if (parts.points.empty())
            parts = exact;
          const double factor = std::accumulate(exact.weights.begin(), exact.weights.end(), 0.)
                                / std::accumulate(parts.weights.begin(), parts.weights.end(), 0.);
          for (double &weight : parts.weights)
            weight *= factor;
        }
      else
        {
          const unsigned int n_sub_cells = dim == 2 ? m * m : m * m * m;
          for (unsigned int i = 0; i < n_sub_cells; ++i)
            {
              parts.points.push_back(sub_cell_corner<dim>(i, m));
              for (unsigned int d = 0; d < dim; ++d)
                parts.points.back()[d] += 0.5 / m;
              parts.weights.push_back(sub_volume);
            }
        }
      add_cell(points, a, parts, m);
    }
  return points;
}

template class PointSeeding<2>;
template class PointSeeding<3>;
} // namespace scree
