#include <scree/mechanics/incremental_bulk.h>

#include <cmath>

// Projected volume changes of increments.
namespace scree
{
template <int dim>
void
IncrementalBulk<dim>::set_up_modes()
{
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  std::vector<double>    weights;
  mode_values.reserve(starts.size() * n_max);
  modes.reserve(fields.n_owned_cells());
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule<dim> points = rule(a);
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
void
IncrementalBulk<dim>::project(CellIncrement &cell) const
{
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  const unsigned int     body  = fields.cells()[cell.active_cell].body;
  const WorkOf           work  = bodies[body].law->work();
  // Elastic laws: r gives the energy of lambda (projected tr eps)^2/2 + mu eps : eps.
  const double r      = (1. - std::sqrt(1. - projected_shares[body])) / dim;
  auto        &values = last.volumes[cell.active_cell].values;
  values              = {};
  cell.changes.clear();
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      cell.changes.emplace_back(work, cell.increments[q], cell.starts[q]);
      const double weight = cell.weights[q] / cell.starts[q].volume_ratio;
      for (unsigned int m = 0; m < n_max; ++m)
        values[m] += weight * cell.mode_values[q * n_max + m] * cell.changes[q].value;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      double value = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        value += cell.mode_values[q * n_max + m] * values[m];
      cell.increments[q] = cell.changes[q].project(value, r);
    }
}

template <int dim>
void
IncrementalBulk<dim>::pull_back(CellIncrement &cell) const
{
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  const unsigned int     body  = fields.cells()[cell.active_cell].body;
  const double           r     = (1. - std::sqrt(1. - projected_shares[body])) / dim;
  const std::size_t      first = first_point[cell.active_cell];
  // Force on each mode.
  std::array<double, n_max> forces = {};
  if (last.has_tangents)
    last.mode_stiffness[cell.active_cell] = {};
  cell.pulled.resize(cell.n_points);
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      cell.pulled[q]  = cell.changes[q].stress(cell.responses[q].piola);
      const auto *psi = cell.mode_values + q * n_max;
      for (unsigned int m = 0; m < n_max; ++m)
        forces[m] += cell.weights[q] * r * cell.pulled[q].trace * psi[m] * cell.changes[q].slope;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      const auto &change = cell.changes[q];
      const auto &H      = change.H;
      const auto *psi    = cell.mode_values + q * n_max;
      double      force  = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        force += forces[m] * psi[m];
      // per weight of the point
      const double volume     = change.scale / cell.starts[q].volume_ratio;
      cell.responses[q].piola = cell.pulled[q].piola + force * volume * H;
      if (!last.has_tangents)
        continue;
      auto      &A       = last.tangents[first + q];
      const auto tangent = change.tangent(cell.pulled[q], A);
      A                  = tangent.piola;
      if (change.is_geometric())
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                A[i][j][k][l] += force * volume * (H[i][j] * H[k][l] - H[i][l] * H[k][j]);
      last.volume_tensors[first + q]
        = {{change.slope * tangent.piola_by_volume, r * change.slope * tangent.trace, volume * H}};
      const double stiffness
        = cell.weights[q] * r
          * (tangent.trace_by_volume - (change.is_geometric() ? cell.pulled[q].trace : 0.))
          * change.slope * change.slope;
      for (unsigned int m = 0; m < n_max; ++m)
        for (unsigned int p = 0; p < n_max; ++p)
          last.mode_stiffness[cell.active_cell][m][p] += stiffness * psi[m] * psi[p];
    }
}

template <int dim>
void
IncrementalBulk<dim>::add_volume_couplings(const unsigned int          active_cell,
                                           dealii::FullMatrix<double> &block) const
{
  constexpr unsigned int n_max   = VolumeModes<dim>::n_max;
  const unsigned int     n       = fields.basis.n_nodes;
  const unsigned int     n_modes = modes[active_cell].n;
  const CellRule<dim>    cell    = rule(active_cell);
  const double           scale   = 1. / fields.cell_size(active_cell);
  const double          *shape   = unit_gradients(active_cell);
  // Of each mode: the stress by its volume, the mode's force by F_D, its volume by F_D.
  using Rows     = std::array<std::array<double, dim * max_nodes_per_cell<dim>>, n_max>;
  Rows by_volume = {}, of_force = {}, of_volume = {};
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
    {
      const double *psi     = &mode_values[(first_point[active_cell] + q) * n_max];
      const auto   &tensors = last.volume_tensors[first_point[active_cell] + q];
      for (unsigned int i = 0; i < n * dim; ++i)
        {
          std::array<double, 3> sums = {};
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              sums[k] += tensors[k][i % dim][j] * shape[i / dim * dim + j];
          for (unsigned int m = 0; m < n_modes; ++m)
            {
              const double weight = cell.weights[q] * cell.weight_scale * scale * psi[m];
              by_volume[m][i] += weight * sums[0];
              of_force[m][i] += weight * sums[1];
              of_volume[m][i] += weight * sums[2];
            }
        }
    }
  const auto &stiffness = last.mode_stiffness[active_cell];
  for (unsigned int m = 0; m < n_modes; ++m)
    {
      std::array<double, dim * max_nodes_per_cell<dim>> row = of_force[m];
      for (unsigned int p = 0; p < n_modes; ++p)
        for (unsigned int i = 0; i < n * dim; ++i)
          row[i] += stiffness[m][p] * of_volume[p][i];
      for (unsigned int i = 0; i < n * dim; ++i)
        for (unsigned int j = 0; j < n * dim; ++j)
          block(i, j) += by_volume[m][i] * of_volume[m][j] + of_volume[m][i] * row[j];
    }
}

template <int dim>
typename IncrementalBulk<dim>::CellVolume
IncrementalBulk<dim>::cell_volume(const unsigned int         active_cell,
                                  const PointEvaluator<dim> &u) const
{
  const unsigned int body = fields.cells()[active_cell].body;
  CellVolume         result;
  if (active_cell >= fields.n_owned_cells() || projected_shares[body] == 0.)
    return result;
  result.is_projected          = true;
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  const CellRule<dim>    cell  = rule(active_cell);
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
const std::vector<typename IncrementalBulk<dim>::CellVolume> &
IncrementalBulk<dim>::cell_volumes(const PointEvaluator<dim> &u) const
{
  return answers(u, false).volumes;
}

template <int dim>
typename IncrementalBulk<dim>::VolumeDerivatives
IncrementalBulk<dim>::volume_derivatives(const unsigned int         active_cell,
                                         const PointEvaluator<dim> &u) const
{
  constexpr unsigned int n_max  = VolumeModes<dim>::n_max;
  const unsigned int     n      = fields.basis.n_nodes;
  const unsigned int     body   = fields.cells()[active_cell].body;
  const CellRule<dim>    cell   = rule(active_cell);
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
VolumeChange<dim>
IncrementalBulk<dim>::volume_change(const unsigned int        active_cell,
                                    const dealii::Point<dim> &unit_point, const CellVolume &volume,
                                    const dealii::Tensor<2, dim> &F_D,
                                    const IncrementStart         &start_here,
                                    dealii::Tensor<2, dim>       &projected) const
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
IncrementalBulk<dim>::projected_increment(const unsigned int            active_cell,
                                          const dealii::Point<dim>     &unit_point,
                                          const CellVolume             &volume,
                                          const dealii::Tensor<2, dim> &F_D,
                                          const IncrementStart         &start_here) const
{
  dealii::Tensor<2, dim> projected = F_D;
  if (volume.is_projected)
    volume_change(active_cell, unit_point, volume, F_D, start_here, projected);
  return projected;
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void IncrementalBulk<dim>::set_up_modes();                                              \
  template void IncrementalBulk<dim>::project(CellIncrement &) const;                              \
  template void IncrementalBulk<dim>::pull_back(CellIncrement &) const;                            \
  template void IncrementalBulk<dim>::add_volume_couplings(const unsigned int,                     \
                                                           dealii::FullMatrix<double> &) const;    \
  template typename IncrementalBulk<dim>::CellVolume IncrementalBulk<dim>::cell_volume(            \
    const unsigned int, const PointEvaluator<dim> &) const;                                        \
  template const std::vector<typename IncrementalBulk<dim>::CellVolume>                            \
    &IncrementalBulk<dim>::cell_volumes(const PointEvaluator<dim> &) const;                        \
  template typename IncrementalBulk<dim>::VolumeDerivatives                                        \
  IncrementalBulk<dim>::volume_derivatives(const unsigned int, const PointEvaluator<dim> &) const; \
  template VolumeChange<dim> IncrementalBulk<dim>::volume_change(                                  \
    const unsigned int, const dealii::Point<dim> &, const CellVolume &,                            \
    const dealii::Tensor<2, dim> &, const IncrementStart &, dealii::Tensor<2, dim> &) const;       \
  template dealii::Tensor<2, dim> IncrementalBulk<dim>::projected_increment(                       \
    const unsigned int, const dealii::Point<dim> &, const CellVolume &,                            \
    const dealii::Tensor<2, dim> &, const IncrementStart &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
