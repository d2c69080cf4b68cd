#include <scree/mechanics/increment_volumes.h>

#include <cmath>

namespace scree
{
template <int dim>
IncrementVolumes<dim>::IncrementVolumes(const DisplacementSpace<dim> &space,
                                        const std::vector<Body<dim>> &bodies,
                                        const BulkQuadrature<dim>    &quadrature,
                                        const std::vector<double>    &shares)
    : space(space)
    , bodies(bodies)
    , quadrature(quadrature)
    , shares(shares)
{
  std::vector<double> weights;
  mode_values.reserve(quadrature.n_points() * n_max);
  cell_modes.reserve(space.n_owned_cells());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim> points = quadrature.rule(a);
      weights.resize(points.n_points);
      for (unsigned int q = 0; q < points.n_points; ++q)
        weights[q] = points.weights[q] * points.weight_scale / quadrature.starts(a)[q].volume_ratio;
      cell_modes.emplace_back(points.points, weights.data(), points.n_points,
                              space.volume_degree());
      for (unsigned int q = 0; q < points.n_points; ++q)
        for (const double value : cell_modes.back()(points.points[q]))
          mode_values.push_back(value);
    }
}

template <int dim>
double
IncrementVolumes<dim>::exponent(const unsigned int body) const
{
  return (1. - std::sqrt(1. - shares[body])) / dim;
}

template <int dim>
void
IncrementVolumes<dim>::project(CellIncrement &cell, CellVolume &volume) const
{
  const unsigned int    body   = space.cells()[cell.active_cell].body;
  const WorkOf          work   = bodies[body].law->work();
  const double          r      = exponent(body);
  const IncrementStart *starts = quadrature.starts(cell.active_cell);
  const double         *psi    = values_of_modes(cell.active_cell);
  auto                 &values = volume.values;
  volume                       = {true, {}};
  cell.changes.clear();
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      cell.changes.emplace_back(work, cell.increments[q], starts[q]);
      const double weight = cell.weights[q] / starts[q].volume_ratio;
      for (unsigned int m = 0; m < n_max; ++m)
        values[m] += weight * psi[q * n_max + m] * cell.changes[q].value;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      double value = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        value += psi[q * n_max + m] * values[m];
      cell.increments[q] = cell.changes[q].project(value, r);
    }
}

template <int dim>
void
IncrementVolumes<dim>::pull_back(CellIncrement &cell, dealii::Tensor<4, dim> *tangents,
                                 Tangents &of_volumes) const
{
  const unsigned int    body                = space.cells()[cell.active_cell].body;
  const double          r                   = exponent(body);
  const std::size_t     first               = quadrature.first_point(cell.active_cell);
  const IncrementStart *starts              = quadrature.starts(cell.active_cell);
  const double         *mode_values_of_cell = values_of_modes(cell.active_cell);
  // Force on each mode.
  std::array<double, n_max> forces = {};
  if (tangents != nullptr)
    of_volumes.of_modes[cell.active_cell] = {};
  cell.pulled.resize(cell.n_points);
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      cell.pulled[q]  = cell.changes[q].stress(cell.responses[q].piola);
      const auto *psi = mode_values_of_cell + q * n_max;
      for (unsigned int m = 0; m < n_max; ++m)
        forces[m] += cell.weights[q] * r * cell.pulled[q].trace * psi[m] * cell.changes[q].slope;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      const auto &change = cell.changes[q];
      const auto &H      = change.H;
      const auto *psi    = mode_values_of_cell + q * n_max;
      double      force  = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        force += forces[m] * psi[m];
      // per weight of the point
      const double volume     = change.scale / starts[q].volume_ratio;
      cell.responses[q].piola = cell.pulled[q].piola + force * volume * H;
      if (tangents == nullptr)
        continue;
      auto      &A       = tangents[q];
      const auto tangent = change.tangent(cell.pulled[q], A);
      A                  = tangent.piola;
      if (change.is_geometric())
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                A[i][j][k][l] += force * volume * (H[i][j] * H[k][l] - H[i][l] * H[k][j]);
      of_volumes.of_points[first + q]
        = {{change.slope * tangent.piola_by_volume, r * change.slope * tangent.trace, volume * H}};
      const double stiffness
        = cell.weights[q] * r
          * (tangent.trace_by_volume - (change.is_geometric() ? cell.pulled[q].trace : 0.))
          * change.slope * change.slope;
      for (unsigned int m = 0; m < n_max; ++m)
        for (unsigned int p = 0; p < n_max; ++p)
          of_volumes.of_modes[cell.active_cell][m][p] += stiffness * psi[m] * psi[p];
    }
}

template <int dim>
void
IncrementVolumes<dim>::add_couplings(const unsigned int active_cell, const Tangents &tangents,
                                     dealii::FullMatrix<double> &block) const
{
  const unsigned int  n       = space.basis.n_nodes;
  const unsigned int  n_modes = cell_modes[active_cell].n;
  const CellRule<dim> cell    = quadrature.rule(active_cell);
  const double        scale   = 1. / space.cell_size(active_cell);
  const double       *shape   = quadrature.unit_gradients(active_cell);
  // Of each mode: the stress by its volume, the mode's force by F_D, its volume by F_D.
  using Rows     = std::array<std::array<double, dim * max_nodes_per_cell<dim>>, n_max>;
  Rows by_volume = {}, of_force = {}, of_volume = {};
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
    {
      const double *psi     = values_of_modes(active_cell) + q * n_max;
      const auto   &tensors = tangents.of_points[quadrature.first_point(active_cell) + q];
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
  const auto &stiffness = tangents.of_modes[active_cell];
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
typename IncrementVolumes<dim>::CellVolume
IncrementVolumes<dim>::cell_volume(const unsigned int         active_cell,
                                   const PointEvaluator<dim> &u) const
{
  const unsigned int body = space.cells()[active_cell].body;
  CellVolume         result;
  if (active_cell >= space.n_owned_cells() || shares[body] == 0.)
    return result;
  result.is_projected          = true;
  const CellRule<dim>   cell   = quadrature.rule(active_cell);
  const double         *shape  = quadrature.unit_gradients(active_cell);
  const IncrementStart *starts = quadrature.starts(active_cell);
  const double         *psi    = values_of_modes(active_cell);
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += space.basis.n_nodes * dim)
    {
      const double            weight = cell.weights[q] * cell.weight_scale;
      const VolumeChange<dim> change(bodies[body].law->work(),
                                     quadrature.increment(u, active_cell, shape), starts[q]);
      for (unsigned int m = 0; m < n_max; ++m)
        result.values[m] += weight / starts[q].volume_ratio * psi[q * n_max + m] * change.value;
    }
  return result;
}

template <int dim>
typename IncrementVolumes<dim>::Derivatives
IncrementVolumes<dim>::derivatives(const unsigned int         active_cell,
                                   const PointEvaluator<dim> &u) const
{
  const unsigned int    n      = space.basis.n_nodes;
  const unsigned int    body   = space.cells()[active_cell].body;
  const CellRule<dim>   cell   = quadrature.rule(active_cell);
  const double          scale  = 1. / space.cell_size(active_cell);
  const double         *shape  = quadrature.unit_gradients(active_cell);
  const IncrementStart *starts = quadrature.starts(active_cell);
  const double         *psi    = values_of_modes(active_cell);
  Derivatives           result = {};
  for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
    {
      const VolumeChange<dim> change(bodies[body].law->work(),
                                     quadrature.increment(u, active_cell, shape), starts[q]);
      const double            weight = cell.weights[q] * cell.weight_scale / starts[q].volume_ratio;
      for (unsigned int i = 0; i < n * dim; ++i)
        {
          double sum = 0.;
          for (unsigned int j = 0; j < dim; ++j)
            sum += change.H[i % dim][j] * shape[i / dim * dim + j];
          for (unsigned int m = 0; m < n_max; ++m)
            result[m][i] += weight * psi[q * n_max + m] * change.scale * scale * sum;
        }
    }
  return result;
}

template <int dim>
VolumeChange<dim>
IncrementVolumes<dim>::change(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                              const CellVolume &volume, const dealii::Tensor<2, dim> &F_D,
                              const IncrementStart   &start_here,
                              dealii::Tensor<2, dim> &projected) const
{
  const unsigned int body = space.cells()[active_cell].body;
  VolumeChange<dim>  result(bodies[body].law->work(), F_D, start_here);
  const auto         psi   = cell_modes[active_cell](unit_point);
  double             value = 0.;
  for (unsigned int m = 0; m < psi.size(); ++m)
    value += psi[m] * volume.values[m];
  projected = result.project(value, shares[body] / dim);
  return result;
}

template <int dim>
dealii::Tensor<2, dim>
IncrementVolumes<dim>::projected_increment(const unsigned int            active_cell,
                                           const dealii::Point<dim>     &unit_point,
                                           const CellVolume             &volume,
                                           const dealii::Tensor<2, dim> &F_D,
                                           const IncrementStart         &start_here) const
{
  dealii::Tensor<2, dim> projected = F_D;
  if (volume.is_projected)
    change(active_cell, unit_point, volume, F_D, start_here, projected);
  return projected;
}

template class IncrementVolumes<2>;
template class IncrementVolumes<3>;
} // namespace scree
