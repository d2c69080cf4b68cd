#include <scree/mechanics/projected_divergence.h>
#include <scree/mechanics/volume_projection.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <optional>

namespace scree
{
namespace
{
/** f_j: 1, x_1 - 1/2, ... */
template <int dim>
double
function(const unsigned int j, const dealii::Point<dim> &unit_point)
{
  return j == 0 ? 1. : unit_point[j - 1] - 0.5;
}

/** int f_j d_i N_a projected: sum_m c_mj int psi_m d_i N_a, j after j. */
template <int dim>
std::vector<double>
integrate_rows(const DisplacementSpace<dim> &space, const dealii::Point<dim> *points,
               const double *weights, const unsigned int n_points, const double gradient_scale)
{
  const VolumeModes<dim> modes(points, weights, n_points, space.volume_degree());
  const unsigned int     n_unknowns = space.basis.n_nodes * dim;
  std::vector<double>    integrals(modes.n * n_unknowns, 0.);
  ShapeValues<dim>       shape;
  for (unsigned int q = 0; q < n_points; ++q)
    {
      space.basis.evaluate_gradients(points[q], shape);
      const auto psi = modes(points[q]);
      for (unsigned int m = 0; m < modes.n; ++m)
        for (unsigned int i = 0; i < n_unknowns; ++i)
          integrals[m * n_unknowns + i]
            += weights[q] * gradient_scale * psi[m] * shape.gradient[i / dim][i % dim];
    }
  std::vector<double> rows(VolumeModes<dim>::n_max * n_unknowns, 0.);
  for (unsigned int m = 0; m < modes.n; ++m)
    for (unsigned int j = 0; j < VolumeModes<dim>::n_max; ++j)
      for (unsigned int i = 0; i < n_unknowns; ++i)
        rows[j * n_unknowns + i] += modes.coefficients[m][j] * integrals[m * n_unknowns + i];
  return rows;
}
} // namespace

template <int dim>
void
exchange_to_ghosts(const DisplacementSpace<dim> &space, std::vector<std::vector<double>> &of_cells)
{
  using Content = std::vector<std::pair<unsigned int, std::vector<double>>>;
  std::vector<Content> of_grid_cell(space.grid.cells().size());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    of_grid_cell[space.cells()[a].grid_cell].emplace_back(space.cells()[a].body, of_cells[a]);
  dealii::GridTools::exchange_cell_data_to_ghosts<Content, dealii::Triangulation<dim>>(
    space.grid.triangulation(),
    [&](const auto &cell) -> std::optional<Content> {
      return of_grid_cell[space.grid.local_index(*cell)];
    },
    [&](const auto &cell, const Content &content) {
      for (const auto &[body, numbers] : content)
        {
          const int a = space.active_cell(space.grid.local_index(*cell), body);
          if (a >= 0)
            of_cells[a] = numbers;
        }
    });
}

template <int dim>
ProjectedDivergence<dim>::ProjectedDivergence(const DisplacementSpace<dim> &space,
                                              const CutQuadrature<dim>     &quadrature,
                                              const std::vector<bool>      &is_projected)
    : space(space)
{
  if (std::find(is_projected.begin(), is_projected.end(), true) == is_projected.end())
    return;
  const auto &whole = quadrature.whole_cell;
  whole_rows
    = integrate_rows(space, whole.points.data(), whole.weights.data(), whole.points.size(), 1.);
  std::vector<std::vector<double>> of_cells(space.cells().size());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    if (space.cells()[a].is_cut && is_projected[space.cells()[a].body])
      {
        const auto        &cut   = quadrature.bulk;
        const unsigned int begin = cut.begin[a];
        of_cells[a]              = integrate_rows(space, &cut.points[begin], &cut.weights[begin],
                                                  cut.begin[a + 1] - begin, 1. / space.cell_size(a));
      }
  exchange_to_ghosts(space, of_cells);
  for (const auto &of_cell : of_cells)
    {
      first_row.push_back(rows.size());
      rows.insert(rows.end(), of_cell.begin(), of_cell.end());
    }
}

template <int dim>
std::pair<const double *, double>
ProjectedDivergence<dim>::rows_of(const unsigned int active_cell) const
{
  if (space.cells()[active_cell].is_cut)
    return {&rows[first_row[active_cell]], 1.};
  return {whole_rows.data(), 1. / space.cell_size(active_cell)};
}

template <int dim>
std::vector<double>
ProjectedDivergence<dim>::coefficients(const PointInCell<dim> &point) const
{
  const unsigned int n_unknowns = space.basis.n_nodes * dim;
  const auto [of_cell, scale]   = rows_of(point.active_cell);
  std::vector<double> result(n_unknowns, 0.);
  for (unsigned int j = 0; j < VolumeModes<dim>::n_max; ++j)
    {
      const double f = scale * function(j, point.unit_point);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        result[i] += f * of_cell[j * n_unknowns + i];
    }
  return result;
}

template <int dim>
double
ProjectedDivergence<dim>::value(const PointInCell<dim> &point, const PointEvaluator<dim> &u) const
{
  const unsigned int n_unknowns = space.basis.n_nodes * dim;
  const auto [of_cell, scale]   = rows_of(point.active_cell);
  const double *nodal           = u.nodal_values(point.active_cell);
  double        result          = 0.;
  for (unsigned int j = 0; j < VolumeModes<dim>::n_max; ++j)
    {
      const double f = scale * function(j, point.unit_point);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        result += f * of_cell[j * n_unknowns + i] * nodal[i];
    }
  return result;
}

#define SCREE_INSTANTIATE(dim)                                     \
  template class ProjectedDivergence<dim>;                         \
  template void exchange_to_ghosts(const DisplacementSpace<dim> &, \
                                   std::vector<std::vector<double>> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
