#include <scree/mechanics/bulk.h>

#include <deal.II/base/mpi.h>

#include <cmath>

// The bulk on a moving geometry: laws in increments on the configuration at the start of the step.
namespace scree
{
template <int dim>
struct Bulk<dim>::CellIncrement
{
  unsigned int                        active_cell;
  unsigned int                        n_points;
  std::vector<double>                 weights;   //!< physical, per point
  const double                       *gradients; //!< unit: times gradient_scale, per node
  double                              gradient_scale;
  const double                       *volume_ratios; //!< J_n
  const double                       *mode_values;   //!< of VolumeModes, per point
  const IncrementStart               *starts;
  std::vector<dealii::Tensor<2, dim>> increments; //!< F_D
  std::vector<IncrementResponse<dim>> responses;
  std::vector<dealii::Tensor<4, dim>> tangents;

  // Of projected volume changes.
  bool                                            is_projected = false;
  std::vector<typename VolumeChange<dim>::Stress> pulled;
  /** P by the mode's volume, its force by F_D, its volume by F_D; without psi. */
  std::vector<std::array<dealii::Tensor<2, dim>, 3>> volume_tensors;
  /** Force of a mode by the volume of another one. */
  std::array<std::array<double, VolumeModes<dim>::n_max>, VolumeModes<dim>::n_max> mode_stiffness;
};

namespace
{
/** Unit gradients of the basis at points, node by node. */
template <int dim>
void
append_gradients(const LagrangeBasis<dim> &basis, const dealii::Point<dim> *points,
                 const unsigned int n_points, std::vector<double> &gradients)
{
  ShapeValues<dim> shape;
  for (unsigned int q = 0; q < n_points; ++q)
    {
      basis.evaluate(points[q], shape);
      for (unsigned int a = 0; a < basis.n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          gradients.push_back(shape.gradient[a][d]);
    }
}
} // namespace

template <int dim>
void
Bulk<dim>::set_up_increments()
{
  append_gradients(fields.basis, quadrature.whole_cell.points.data(),
                   quadrature.whole_cell.points.size(), whole_gradients);
  std::vector<PointInCell<dim>> points;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule cell = rule(a);
      first_point.push_back(points.size());
      first_gradient.push_back(cut_gradients.size());
      for (unsigned int q = 0; q < cell.n_points; ++q)
        points.push_back({a, cell.points[q]});
      if (fields.cells()[a].is_cut)
        append_gradients(fields.basis, cell.points, cell.n_points, cut_gradients);
    }
  const auto histories = start->histories(points);
  starts.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto &body = bodies[fields.cells()[points[i].active_cell].body];
      starts.push_back(body.law->start(histories[i]));
      volume_ratios.push_back(determinant(histories[i].deformation_gradient));
    }
}

template <int dim>
template <typename Function>
void
Bulk<dim>::for_each_cell(const Vector &u, const bool with_tangents, const Function &f) const
{
  const unsigned int             n      = fields.basis.n_nodes;
  const std::vector<double>      values = values_by_cell(fields, u);
  CellIncrement                  cell;
  std::vector<VolumeChange<dim>> changes;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule points = rule(a);
      cell.active_cell      = a;
      cell.n_points         = points.n_points;
      cell.gradients
        = fields.cells()[a].is_cut ? &cut_gradients[first_gradient[a]] : whole_gradients.data();
      cell.gradient_scale = 1. / fields.grid.cells()[fields.cells()[a].grid_cell].size;
      cell.volume_ratios  = volume_ratios.data() + first_point[a];
      cell.mode_values    = mode_values.data() + first_point[a] * VolumeModes<dim>::n_max;
      cell.starts         = starts.data() + first_point[a];
      cell.is_projected   = projected_shares[fields.cells()[a].body] > 0.;
      cell.weights.resize(points.n_points);
      cell.increments.resize(points.n_points);
      cell.responses.resize(points.n_points);
      cell.tangents.resize(with_tangents ? points.n_points : 0);
      const double *nodal = &values[std::size_t(a) * n * dim];
      for (unsigned int q = 0; q < points.n_points; ++q)
        {
          cell.weights[q]                  = points.weights[q] * points.weight_scale;
          double        gradient[dim][dim] = {};
          const double *shape              = cell.gradients + q * n * dim;
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                gradient[i][j] += nodal[b * dim + i] * shape[b * dim + j];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              cell.increments[q][i][j] = (i == j) + cell.gradient_scale * gradient[i][j];
        }
      if (cell.is_projected)
        project(cell, changes);
      bodies[fields.cells()[a].body].law->respond(
        dealii::make_array_view(cell.increments.begin(), cell.increments.end()),
        dealii::ArrayView<const IncrementStart>(cell.starts, points.n_points),
        dealii::make_array_view(cell.responses.begin(), cell.responses.end()),
        dealii::make_array_view(cell.tangents.begin(), cell.tangents.end()));
      if (cell.is_projected)
        pull_back(cell, changes);
      f(cell);
    }
}

template <int dim>
void
Bulk<dim>::project(CellIncrement &cell, std::vector<VolumeChange<dim>> &changes) const
{
  constexpr unsigned int n_max = VolumeModes<dim>::n_max;
  const unsigned int     body  = fields.cells()[cell.active_cell].body;
  const WorkOf           work  = bodies[body].law->work();
  // Elastic laws: r gives the energy of lambda (projected tr eps)^2/2 + mu eps : eps.
  const double              r      = (1. - std::sqrt(1. - projected_shares[body])) / dim;
  std::array<double, n_max> values = {};
  changes.clear();
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      changes.emplace_back(work, cell.increments[q], cell.starts[q]);
      const double weight = cell.weights[q] / cell.starts[q].volume_ratio;
      for (unsigned int m = 0; m < n_max; ++m)
        values[m] += weight * cell.mode_values[q * n_max + m] * changes[q].value;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      double value = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        value += cell.mode_values[q * n_max + m] * values[m];
      cell.increments[q] = changes[q].project(value, r);
    }
}

template <int dim>
void
Bulk<dim>::pull_back(CellIncrement &cell, const std::vector<VolumeChange<dim>> &changes) const
{
  constexpr unsigned int n_max         = VolumeModes<dim>::n_max;
  const unsigned int     body          = fields.cells()[cell.active_cell].body;
  const double           r             = (1. - std::sqrt(1. - projected_shares[body])) / dim;
  const bool             with_tangents = !cell.tangents.empty();
  // Force on each mode.
  std::array<double, n_max> forces = {};
  cell.mode_stiffness              = {};
  cell.volume_tensors.resize(with_tangents ? cell.n_points : 0);
  cell.pulled.resize(cell.n_points);
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      cell.pulled[q]  = changes[q].stress(cell.responses[q].piola);
      const auto *psi = cell.mode_values + q * n_max;
      for (unsigned int m = 0; m < n_max; ++m)
        forces[m] += cell.weights[q] * r * cell.pulled[q].trace * psi[m] * changes[q].slope;
    }
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      const auto &change = changes[q];
      const auto &H      = change.H;
      const auto *psi    = cell.mode_values + q * n_max;
      double      force  = 0.;
      for (unsigned int m = 0; m < n_max; ++m)
        force += forces[m] * psi[m];
      // per weight of the point
      const double volume     = change.scale / cell.starts[q].volume_ratio;
      cell.responses[q].piola = cell.pulled[q].piola + force * volume * H;
      if (!with_tangents)
        continue;
      const auto tangent = change.tangent(cell.pulled[q], cell.tangents[q]);
      cell.tangents[q]   = tangent.piola;
      if (change.is_geometric())
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                cell.tangents[q][i][j][k][l]
                  += force * volume * (H[i][j] * H[k][l] - H[i][l] * H[k][j]);
      cell.volume_tensors[q]
        = {change.slope * tangent.piola_by_volume, r * change.slope * tangent.trace, volume * H};
      const double stiffness
        = cell.weights[q] * r
          * (tangent.trace_by_volume - (change.is_geometric() ? cell.pulled[q].trace : 0.))
          * change.slope * change.slope;
      for (unsigned int m = 0; m < n_max; ++m)
        for (unsigned int p = 0; p < n_max; ++p)
          cell.mode_stiffness[m][p] += stiffness * psi[m] * psi[p];
    }
}

template <int dim>
void
Bulk<dim>::add_volume_couplings(const CellIncrement &cell, dealii::FullMatrix<double> &block) const
{
  constexpr unsigned int n_max   = VolumeModes<dim>::n_max;
  const unsigned int     n       = fields.basis.n_nodes;
  const unsigned int     n_modes = modes[cell.active_cell].n;
  // Of each mode: the stress by its volume, the mode's force by F_D, its volume by F_D.
  using Rows     = std::array<std::array<double, dim * max_nodes_per_cell<dim>>, n_max>;
  Rows by_volume = {}, of_force = {}, of_volume = {};
  for (unsigned int q = 0; q < cell.n_points; ++q)
    {
      const double *psi   = cell.mode_values + q * n_max;
      const double *shape = cell.gradients + q * n * dim;
      for (unsigned int i = 0; i < n * dim; ++i)
        {
          std::array<double, 3> sums = {};
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              sums[k] += cell.volume_tensors[q][k][i % dim][j] * shape[i / dim * dim + j];
          for (unsigned int m = 0; m < n_modes; ++m)
            {
              const double weight = cell.weights[q] * cell.gradient_scale * psi[m];
              by_volume[m][i] += weight * sums[0];
              of_force[m][i] += weight * sums[1];
              of_volume[m][i] += weight * sums[2];
            }
        }
    }
  for (unsigned int m = 0; m < n_modes; ++m)
    {
      std::array<double, dim * max_nodes_per_cell<dim>> row = of_force[m];
      for (unsigned int p = 0; p < n_modes; ++p)
        for (unsigned int i = 0; i < n * dim; ++i)
          row[i] += cell.mode_stiffness[m][p] * of_volume[p][i];
      for (unsigned int i = 0; i < n * dim; ++i)
        for (unsigned int j = 0; j < n * dim; ++j)
          block(i, j) += by_volume[m][i] * of_volume[m][j] + of_volume[m][i] * row[j];
    }
}
template <int dim>
void
Bulk<dim>::add_internal_forces(const Vector &u, Vector &forces) const
{
  if (!start)
    return;
  const unsigned int     n = fields.basis.n_nodes;
  dealii::Vector<double> cell_forces(n * dim);
  for_each_cell(u, false, [&](const CellIncrement &cell) {
    cell_forces = 0.;
    for (unsigned int q = 0; q < cell.n_points; ++q)
      {
        const dealii::Tensor<2, dim> P
          = cell.weights[q] * cell.gradient_scale * cell.responses[q].piola;
        const double *shape = cell.gradients + q * n * dim;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              cell_forces(a * dim + i) += P[i][j] * shape[a * dim + j];
      }
    fields.hanging_constraints().distribute_local_to_global(
      cell_forces, unknowns_of_nodes<dim>(fields.nodes(cell.active_cell), n), forces);
  });
}

template <int dim>
void
Bulk<dim>::add_tangent(const Vector &u, dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  if (!start)
    return;
  const unsigned int         n = fields.basis.n_nodes;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  for_each_cell(u, true, [&](const CellIncrement &cell) {
    block = 0.;
    for (unsigned int q = 0; q < cell.n_points; ++q)
      {
        const double  weight = cell.weights[q] * cell.gradient_scale * cell.gradient_scale;
        const double *shape  = cell.gradients + q * n * dim;
        const auto   &A      = cell.tangents[q];
        for (unsigned int b = 0; b < n; ++b)
          {
            // dP/du_k at node b
            double dP[dim][dim][dim];
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  {
                    double sum = 0.;
                    for (unsigned int l = 0; l < dim; ++l)
                      sum += A[i][j][k][l] * shape[b * dim + l];
                    dP[k][i][j] = weight * sum;
                  }
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int k = 0; k < dim; ++k)
                  {
                    double sum = 0.;
                    for (unsigned int j = 0; j < dim; ++j)
                      sum += dP[k][i][j] * shape[a * dim + j];
                    block(a * dim + i, b * dim + k) += sum;
                  }
          }
      }
    if (cell.is_projected)
      add_volume_couplings(cell, block);
    fields.hanging_constraints().distribute_local_to_global(
      block, unknowns_of_nodes<dim>(fields.nodes(cell.active_cell), n), matrix);
  });
}

template <int dim>
typename Bulk<dim>::Work
Bulk<dim>::work(const Vector &u) const
{
  Work result;
  if (!start)
    result.energy = linear_strain_energy(u);
  else
    for_each_cell(u, false, [&](const CellIncrement &cell) {
      for (unsigned int q = 0; q < cell.n_points; ++q)
        {
          const double reference_weight = cell.weights[q] / cell.volume_ratios[q];
          result.energy += reference_weight * cell.responses[q].energy;
          result.dissipation += reference_weight * cell.responses[q].dissipation;
        }
    });
  const MPI_Comm communicator = fields.grid.communicator();
  result.energy               = dealii::Utilities::MPI::sum(result.energy, communicator);
  result.dissipation          = dealii::Utilities::MPI::sum(result.dissipation, communicator);
  return result;
}

template <int dim>
BulkSample<dim>
Bulk<dim>::increment_sample(const PointInCell<dim>       &point,
                            const dealii::Tensor<1, dim> &displacement,
                            const dealii::Tensor<2, dim> &gradient, const Vector &u) const
{
  const auto &law     = *bodies[fields.cells()[point.active_cell].body].law;
  const auto  history = start->histories({point}).front();

  const dealii::Tensor<2, dim> F_D
    = gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  const std::vector<IncrementStart>   at_start = {law.start(history)};
  std::vector<dealii::Tensor<2, dim>> increment
    = {projected_increment(point.active_cell, point.unit_point,
                           cell_volume(point.active_cell, u, false), F_D, at_start.front())};
  std::vector<IncrementResponse<dim>> response(1);
  std::vector<dealii::Tensor<4, dim>> no_tangent;
  law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(increment.data(), 1),
              dealii::ArrayView<const IncrementStart>(at_start.data(), 1),
              dealii::make_array_view(response.begin(), response.end()),
              dealii::make_array_view(no_tangent.begin(), no_tangent.end()));
  BulkSample<dim> result;
  result.displacement = start->deformation(point).displacement + displacement;
  // Green's strain
  const dealii::Tensor<2, dim> F = F_D * history.deformation_gradient;
  result.strain = 0.5 * (symmetrize(transpose(F) * F) - dealii::unit_symmetric_tensor<dim>());
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result.stress[i][j] = response[0].cauchy[i][j];
  if (dim == 2)
    result.out_of_plane_stress = response[0].cauchy[2][2];
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                         \
  template void Bulk<dim>::set_up_increments();                                                        \
  template void Bulk<dim>::add_internal_forces(const Vector &, Vector &) const;                        \
  template void Bulk<dim>::add_tangent(const Vector &, dealii::TrilinosWrappers::SparseMatrix &)       \
    const;                                                                                             \
  template typename Bulk<dim>::Work Bulk<dim>::work(const Vector &) const;                             \
  template BulkSample<dim>          Bulk<dim>::increment_sample(                                       \
             const PointInCell<dim> &, const dealii::Tensor<1, dim> &, const dealii::Tensor<2, dim> &, \
             const Vector &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
