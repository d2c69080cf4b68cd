#include <scree/mechanics/bulk.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

// Projected volume changes of the bulk, and the stiffness of the ghost penalty.
namespace scree
{
namespace
{
/** Bodies that flow keep this part of the ghost penalty, for the condition number. */
constexpr double smallest_ratio = 1e-3;

/** f_j: 1, x_1 - 1/2, ... */
template <int dim>
double
function(const unsigned int j, const dealii::Point<dim> &unit_point)
{
  return j == 0 ? 1. : unit_point[j - 1] - 0.5;
}

/** Sends a list of numbers of every active cell of the owners to their ghosts. */
template <int dim>
void
exchange_to_ghosts(const Fields<dim> &fields, std::vector<std::vector<double>> &of_cells)
{
  using Content = std::vector<std::pair<unsigned int, std::vector<double>>>;
  std::vector<Content> of_grid_cell(fields.grid.cells().size());
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    of_grid_cell[fields.cells()[a].grid_cell].emplace_back(fields.cells()[a].body, of_cells[a]);
  dealii::GridTools::exchange_cell_data_to_ghosts<Content, dealii::Triangulation<dim>>(
    fields.grid.triangulation(),
    [&](const auto &cell) -> dealii::std_cxx17::optional<Content> {
      return of_grid_cell[fields.grid.local_index(*cell)];
    },
    [&](const auto &cell, const Content &content) {
      for (const auto &[body, numbers] : content)
        {
          const int a = fields.active_cell(fields.grid.local_index(*cell), body);
          if (a >= 0)
            of_cells[a] = numbers;
        }
    });
}

/** int f_j d_i N_a projected: sum_m c_mj int psi_m d_i N_a, j after j. */
template <int dim>
std::vector<double>
integrate_volume_rows(const LagrangeBasis<dim> &basis, const VolumeModes<dim> &modes,
                      const dealii::Point<dim> *points, const double *weights,
                      const unsigned int n_points, const double gradient_scale)
{
  const unsigned int  n_unknowns = basis.n_nodes * dim;
  std::vector<double> integrals(modes.n * n_unknowns, 0.);
  ShapeValues<dim>    shape;
  for (unsigned int q = 0; q < n_points; ++q)
    {
      basis.evaluate_gradients(points[q], shape);
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
Bulk<dim>::set_up_volume_rows()
{
  if (std::all_of(projected_shares.begin(), projected_shares.end(),
                  [](const double share) { return share == 0.; }))
    return;
  const unsigned int degree = fields.basis.degree - 1;
  const auto        &whole  = quadrature.whole_cell;
  whole_volume_rows         = integrate_volume_rows(
            fields.basis,
            VolumeModes<dim>(whole.points.data(), whole.weights.data(), whole.points.size(), degree),
            whole.points.data(), whole.weights.data(), whole.points.size(), 1.);
  std::vector<std::vector<double>> rows(fields.cells().size());
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    if (fields.cells()[a].is_cut && projected_shares[fields.cells()[a].body] > 0.)
      {
        const CellRule cell = rule(a);
        rows[a]             = integrate_volume_rows(
                      fields.basis, VolumeModes<dim>(cell.points, cell.weights, cell.n_points, degree),
                      cell.points, cell.weights, cell.n_points, 1. / fields.cell_size(a));
      }
  exchange_to_ghosts(fields, rows);
  for (const auto &row : rows)
    {
      first_row.push_back(volume_rows.size());
      volume_rows.insert(volume_rows.end(), row.begin(), row.end());
    }
}

template <int dim>
std::pair<const double *, double>
Bulk<dim>::volume_rows_of(const unsigned int active_cell) const
{
  if (fields.cells()[active_cell].is_cut)
    return {&volume_rows[first_row[active_cell]], 1.};
  return {whole_volume_rows.data(), 1. / fields.cell_size(active_cell)};
}

template <int dim>
bool
Bulk<dim>::projected_divergence(const unsigned int        active_cell,
                                const dealii::Point<dim> &unit_point,
                                std::vector<double>      &coefficients) const
{
  coefficients.clear();
  if (projected_shares[fields.cells()[active_cell].body] == 0.)
    return false;
  const unsigned int n_unknowns = fields.basis.n_nodes * dim;
  const auto [rows, scale]      = volume_rows_of(active_cell);
  coefficients.assign(n_unknowns, 0.);
  for (unsigned int j = 0; j < VolumeModes<dim>::n_max; ++j)
    {
      const double f = scale * function(j, unit_point);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        coefficients[i] += f * rows[j * n_unknowns + i];
    }
  return true;
}

template <int dim>
double
Bulk<dim>::projected_divergence(const PointInCell<dim> &point, const PointEvaluator<dim> &u) const
{
  const unsigned int n_unknowns = fields.basis.n_nodes * dim;
  const auto [rows, scale]      = volume_rows_of(point.active_cell);
  const double *nodal           = u.nodal_values(point.active_cell);
  double        result          = 0.;
  for (unsigned int j = 0; j < VolumeModes<dim>::n_max; ++j)
    {
      const double f = scale * function(j, point.unit_point);
      for (unsigned int i = 0; i < n_unknowns; ++i)
        result += f * rows[j * n_unknowns + i] * nodal[i];
    }
  return result;
}

template <int dim>
void
Bulk<dim>::add_projected_stiffness(const unsigned int active_cell, const double lambda,
                                   dealii::FullMatrix<double> &matrix) const
{
  const CellRule         points = rule(active_cell);
  const unsigned int     n      = fields.basis.n_nodes * dim;
  const double           scale  = 1. / fields.cell_size(active_cell);
  const VolumeModes<dim> psi(points.points, points.weights, points.n_points,
                             fields.basis.degree - 1);
  std::array<std::array<double, dim * max_nodes_per_cell<dim>>, VolumeModes<dim>::n_max> integrals
    = {};
  ShapeValues<dim> shape;
  for (unsigned int q = 0; q < points.n_points; ++q)
    {
      fields.basis.evaluate_gradients(points.points[q], shape);
      const auto values = psi(points.points[q]);
      for (unsigned int m = 0; m < psi.n; ++m)
        for (unsigned int i = 0; i < n; ++i)
          integrals[m][i]
            += points.weights[q] * scale * values[m] * shape.gradient[i / dim][i % dim];
    }
  for (unsigned int m = 0; m < psi.n; ++m)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) += lambda * points.weight_scale * integrals[m][i] * integrals[m][j];
}

template <int dim>
double
Bulk<dim>::projected_lambda(const unsigned int body) const
{
  const auto &material = *bodies[body].material;
  return std::min(std::max(0., material.lame_lambda()),
                  projected_shares[body]
                    * (material.lame_lambda() + 2. * material.shear_modulus() / dim));
}

template <int dim>
double
Bulk<dim>::ghost_stiffness(const GhostFace &face) const
{
  const auto  &material = *bodies[fields.cells()[face.cell].body].material;
  const double mu       = material.shear_modulus();
  const double secant   = std::min(secant_ratios[face.cell], secant_ratios[face.neighbor]);
  return gamma * (2. * mu + std::min(material.lame_lambda(), IsotropicModuli::largest_ratio * mu))
         * std::max(smallest_ratio, secant * secant);
}

template <int dim>
void
Bulk<dim>::find_secant_ratios()
{
  std::vector<std::vector<double>> of_cells(fields.cells().size(), {1.});
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule points = rule(a);
      double         volume = 0., alpha = 0.;
      for (unsigned int q = 0; q < points.n_points; ++q)
        {
          volume += points.weights[q];
          alpha += points.weights[q] * starts[first_point[a] + q].alpha;
        }
      if (alpha > 0.)
        of_cells[a] = {bodies[fields.cells()[a].body].law->secant_ratio(alpha / volume)};
    }
  exchange_to_ghosts(fields, of_cells);
  for (unsigned int a = 0; a < fields.cells().size(); ++a)
    secant_ratios[a] = of_cells[a].front();
}

template <int dim>
typename Bulk<dim>::Vector
Bulk<dim>::nodal_secant_ratios() const
{
  Vector smallest(fields.owned(), fields.grid.communicator());
  for (const DofIndex i : fields.owned())
    smallest(i) = 1.;
  for (unsigned int a = 0; a < fields.cells().size(); ++a)
    for (unsigned int i = 0; i < fields.basis.n_nodes; ++i)
      if (const DofIndex node = fields.nodes(a)[i]; fields.owned().is_element(node))
        smallest(node) = std::min<double>(smallest(node), secant_ratios[a]);
  smallest.compress(dealii::VectorOperation::insert);
  return smallest;
}

template <int dim>
void
Bulk<dim>::set_up_increment_modes()
{
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  std::vector<double>    weights;
  mode_values.reserve(starts.size() * n_max);
  modes.reserve(fields.n_owned_cells());
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule points = rule(a);
      weights.resize(points.n_points);
      for (unsigned int q = 0; q < points.n_points; ++q)
        weights[q]
          = points.weights[q] * points.weight_scale / starts[first_point[a] + q].volume_ratio;
      modes.emplace_back(points.points, weights.data(), points.n_points, fields.basis.degree - 1);
      for (unsigned int q = 0; q < points.n_points; ++q)
        for (const double value : modes.back()(points.points[q]))
          mode_values.push_back(value);
    }
}

template <int dim>
typename Bulk<dim>::CellVolume
Bulk<dim>::cell_volume(const unsigned int active_cell, const PointEvaluator<dim> &u) const
{
  const unsigned int body = fields.cells()[active_cell].body;
  CellVolume         result;
  if (active_cell >= fields.n_owned_cells() || projected_shares[body] == 0.)
    return result;
  result.is_projected          = true;
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  const CellRule         cell  = rule(active_cell);
  const double          *shape = unit_gradients(active_cell);
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += fields.basis.n_nodes * dim)
    {
      const std::size_t       point  = first_point[active_cell] + q;
      const double            weight = cell.weights[q] * cell.weight_scale;
      const VolumeChange<dim> change(bodies[body].law->work(), increment(active_cell, shape, u),
                                     starts[point]);
      for (unsigned int m = 0; m < n_max; ++m)
        result.values[m]
          += weight / starts[point].volume_ratio * mode_values[point * n_max + m] * change.value;
    }
  return result;
}

template <int dim>
typename Bulk<dim>::VolumeDerivatives
Bulk<dim>::volume_derivatives(const unsigned int active_cell, const PointEvaluator<dim> &u) const
{
  constexpr unsigned int n_max  = VolumeModes<dim>::n_max;
  const unsigned int     n      = fields.basis.n_nodes;
  const unsigned int     body   = fields.cells()[active_cell].body;
  const CellRule         cell   = rule(active_cell);
  const double           scale  = 1. / fields.cell_size(active_cell);
  const double          *shape  = unit_gradients(active_cell);
  VolumeDerivatives      result = {};
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
    {
      const std::size_t       point = first_point[active_cell] + q;
      const VolumeChange<dim> change(bodies[body].law->work(), increment(active_cell, shape, u),
                                     starts[point]);
      const double weight = cell.weights[q] * cell.weight_scale / starts[point].volume_ratio;
      for (unsigned int i = 0; i < n * dim; ++i)
        {
          double sum = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            sum += change.H[i % dim][j] * shape[i / dim * dim + j];
          for (unsigned int m = 0; m < n_max; ++m)
            result[m][i] += weight * mode_values[point * n_max + m] * change.scale * scale * sum;
        }
    }
  return result;
}

template <int dim>
const std::vector<typename Bulk<dim>::CellVolume> &
Bulk<dim>::cell_volumes(const PointEvaluator<dim> &u) const
{
  return answers(u, false).volumes;
}

template <int dim>
VolumeChange<dim>
Bulk<dim>::volume_change(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const CellVolume &volume, const dealii::Tensor<2, dim> &F_D,
                         const IncrementStart &start_here, dealii::Tensor<2, dim> &projected) const
{
  const unsigned int body = fields.cells()[active_cell].body;
  VolumeChange<dim>  change(bodies[body].law->work(), F_D, start_here);
  const auto         psi   = modes[active_cell](unit_point);
  double             value = 0.;
  for (unsigned int m = 0; m < psi.size(); ++m)
    value += psi[m] * volume.values[m];
  projected = change.project(value, projected_shares[body] / dim);
  return change;
}

template <int dim>
dealii::Tensor<2, dim>
Bulk<dim>::projected_increment(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                               const CellVolume &volume, const dealii::Tensor<2, dim> &F_D,
                               const IncrementStart &start_here) const
{
  dealii::Tensor<2, dim> projected = F_D;
  if (volume.is_projected)
    volume_change(active_cell, unit_point, volume, F_D, start_here, projected);
  return projected;
}

#define SCREE_INSTANTIATE(dim)                                                                                \
  template void   Bulk<dim>::set_up_volume_rows();                                                            \
  template bool   Bulk<dim>::projected_divergence(const unsigned int, const dealii::Point<dim> &,             \
                                                  std::vector<double> &) const;                               \
  template double Bulk<dim>::projected_lambda(const unsigned int) const;                                      \
  template void   Bulk<dim>::add_projected_stiffness(const unsigned int, const double,                        \
                                                     dealii::FullMatrix<double> &) const;                     \
  template double Bulk<dim>::ghost_stiffness(const GhostFace &) const;                                        \
  template void   Bulk<dim>::find_secant_ratios();                                                            \
  template typename Bulk<dim>::Vector     Bulk<dim>::nodal_secant_ratios() const;                             \
  template void                           Bulk<dim>::set_up_increment_modes();                                \
  template double                         Bulk<dim>::projected_divergence(const PointInCell<dim> &,           \
                                                                          const PointEvaluator<dim> &) const; \
  template typename Bulk<dim>::CellVolume Bulk<dim>::cell_volume(                                             \
    const unsigned int, const PointEvaluator<dim> &) const;                                                   \
  template typename Bulk<dim>::VolumeDerivatives Bulk<dim>::volume_derivatives(                               \
    const unsigned int, const PointEvaluator<dim> &) const;                                                   \
  template const std::vector<typename Bulk<dim>::CellVolume> &Bulk<dim>::cell_volumes(                        \
    const PointEvaluator<dim> &) const;                                                                       \
  template VolumeChange<dim> Bulk<dim>::volume_change(                                                        \
    const unsigned int, const dealii::Point<dim> &, const CellVolume &,                                       \
    const dealii::Tensor<2, dim> &, const IncrementStart &, dealii::Tensor<2, dim> &) const;                  \
  template dealii::Tensor<2, dim> Bulk<dim>::projected_increment(                                             \
    const unsigned int, const dealii::Point<dim> &, const CellVolume &,                                       \
    const dealii::Tensor<2, dim> &, const IncrementStart &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
