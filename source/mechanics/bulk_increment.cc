#include <scree/mechanics/bulk.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <utility>

// The bulk on a moving geometry: laws in increments on the configuration at the start of the step.
namespace scree
{
template <int dim>
struct Bulk<dim>::CellIncrement
{
  unsigned int          active_cell;
  unsigned int          n_points;
  std::vector<double>   weights;     //!< physical, per point
  const double         *mode_values; //!< of VolumeModes, per point
  const IncrementStart *starts;

  std::vector<dealii::Tensor<2, dim>>             increments; //!< F_D, projected
  std::vector<IncrementResponse<dim>>             responses;
  std::vector<VolumeChange<dim>>                  changes;
  std::vector<typename VolumeChange<dim>::Stress> pulled;
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
      basis.evaluate_gradients(points[q], shape);
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
const typename Bulk<dim>::Answers &
Bulk<dim>::answers(const PointEvaluator<dim> &u, const bool with_tangents) const
{
  if (!last.renew(u, with_tangents))
    return last;
  last.work = {};
  last.piola.resize(starts.size());
  last.volumes.resize(fields.cells().size());
  if (with_tangents)
    {
      last.tangents.resize(starts.size());
      const bool is_projected = !whole_volume_rows.empty();
      last.volume_tensors.resize(is_projected ? starts.size() : 0);
      last.mode_stiffness.resize(is_projected ? fields.n_owned_cells() : 0);
    }
  CellIncrement cell;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    ask(a, cell);
  return last;
}

template <int dim>
void
Bulk<dim>::ask(const unsigned int active_cell, CellIncrement &cell) const
{
  const CellRule     points = rule(active_cell);
  const unsigned int n      = points.n_points;
  const unsigned int body   = fields.cells()[active_cell].body;
  const std::size_t  first  = first_point[active_cell];
  cell.active_cell          = active_cell;
  cell.n_points             = n;
  cell.mode_values          = mode_values.data() + first * VolumeModes<dim>::n_max;
  cell.starts               = starts.data() + first;
  cell.weights.resize(n);
  cell.increments.resize(n);
  cell.responses.resize(n);
  const double *shape = unit_gradients(active_cell);
  for (unsigned int q = 0; q < n; ++q, shape += fields.basis.n_nodes * dim)
    {
      cell.weights[q]    = points.weights[q] * points.weight_scale;
      cell.increments[q] = increment(active_cell, shape, *last.u);
    }
  const bool is_projected                = projected_shares[body] > 0.;
  last.volumes[active_cell].is_projected = is_projected;
  if (is_projected)
    project(cell);
  bodies[body].law->respond(
    dealii::make_array_view(cell.increments.begin(), cell.increments.end()),
    dealii::ArrayView<const IncrementStart>(cell.starts, n),
    dealii::make_array_view(cell.responses.begin(), cell.responses.end()),
    dealii::ArrayView<dealii::Tensor<4, dim>>(
      last.tangents.data() + (last.has_tangents ? first : 0), last.has_tangents ? n : 0));
  if (is_projected)
    pull_back(cell);
  for (unsigned int q = 0; q < n; ++q)
    {
      const double reference_weight = cell.weights[q] / volume_ratios[first + q];
      last.work.energy += reference_weight * cell.responses[q].energy;
      last.work.dissipation += reference_weight * cell.responses[q].dissipation;
      last.piola[first + q] = cell.responses[q].piola;
    }
}

template <int dim>
void
Bulk<dim>::project(CellIncrement &cell) const
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
Bulk<dim>::pull_back(CellIncrement &cell) const
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
Bulk<dim>::add_volume_couplings(const unsigned int          active_cell,
                                dealii::FullMatrix<double> &block) const
{
  constexpr unsigned int n_max   = VolumeModes<dim>::n_max;
  const unsigned int     n       = fields.basis.n_nodes;
  const unsigned int     n_modes = modes[active_cell].n;
  const CellRule         cell    = rule(active_cell);
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
void
Bulk<dim>::add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const
{
  if (!start)
    return;
  const auto            &piola = answers(u, std::exchange(last.expects_tangent, false)).piola;
  const unsigned int     n     = fields.basis.n_nodes;
  dealii::Vector<double> cell_forces(n * dim);
  std::vector<DofIndex>  unknowns;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule cell  = rule(a);
      const double   scale = cell.weight_scale / fields.cell_size(a);
      const double  *shape = unit_gradients(a);
      cell_forces          = 0.;
      for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
        {
          const dealii::Tensor<2, dim> P = cell.weights[q] * scale * piola[first_point[a] + q];
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                cell_forces(b * dim + i) += P[i][j] * shape[b * dim + j];
        }
      set_unknowns_of_nodes<dim>(fields.nodes(a), n, unknowns);
      fields.hanging_constraints().distribute_local_to_global(cell_forces, unknowns, forces);
    }
}

namespace
{
/** Adds weight A_ijkl dN_a/dx_j dN_b/dx_l in row (a, i) and column (b, k). */
template <int dim>
void
add_stiffness(const dealii::Tensor<4, dim> &A, const double *shape, const unsigned int n,
              const double weight, dealii::FullMatrix<double> &block)
{
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
} // namespace

template <int dim>
void
Bulk<dim>::add_tangent(const PointEvaluator<dim>              &u,
                       dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  if (!start)
    return;
  const auto &tangents         = answers(u, true).tangents;
  last.expects_tangent         = true;
  const unsigned int         n = fields.basis.n_nodes;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  std::vector<DofIndex>      unknowns;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule cell  = rule(a);
      const double   scale = cell.weight_scale / std::pow(fields.cell_size(a), 2);
      const double  *shape = unit_gradients(a);
      block                = 0.;
      for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
        add_stiffness<dim>(tangents[first_point[a] + q], shape, n, cell.weights[q] * scale, block);
      if (projected_shares[fields.cells()[a].body] > 0.)
        add_volume_couplings(a, block);
      set_unknowns_of_nodes<dim>(fields.nodes(a), n, unknowns);
      fields.hanging_constraints().distribute_local_to_global(block, unknowns, matrix);
    }
}

template <int dim>
typename Bulk<dim>::Work
Bulk<dim>::work(const PointEvaluator<dim> &u) const
{
  Work result;
  if (!start)
    result.energy = linear_strain_energy(u);
  else
    result = answers(u, false).work;
  const MPI_Comm communicator = fields.grid.communicator();
  result.energy               = dealii::Utilities::MPI::sum(result.energy, communicator);
  result.dissipation          = dealii::Utilities::MPI::sum(result.dissipation, communicator);
  return result;
}

template <int dim>
BulkSample<dim>
Bulk<dim>::increment_sample(const PointInCell<dim> &point, const PointEvaluator<dim> &u) const
{
  const auto &law                     = *bodies[fields.cells()[point.active_cell].body].law;
  const auto  history                 = start->histories({point}).front();
  const auto  at_start                = law.start(history);
  const auto [displacement, gradient] = u.evaluate(point);

  const dealii::Tensor<2, dim> F_D
    = gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  const dealii::Tensor<2, dim> projected = projected_increment(
    point.active_cell, point.unit_point, cell_volume(point.active_cell, u), F_D, at_start);
  IncrementResponse<dim> response;
  law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(&projected, 1),
              dealii::ArrayView<const IncrementStart>(&at_start, 1),
              dealii::ArrayView<IncrementResponse<dim>>(&response, 1), {});
  BulkSample<dim> result;
  result.displacement = start->displacement_field().value(point) + displacement;
  // Green's strain
  const dealii::Tensor<2, dim> F = F_D * history.deformation_gradient;
  result.strain = 0.5 * (symmetrize(transpose(F) * F) - dealii::unit_symmetric_tensor<dim>());
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result.stress[i][j] = response.cauchy[i][j];
  if (dim == 2)
    result.out_of_plane_stress = response.cauchy[2][2];
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template void                               Bulk<dim>::set_up_increments();                 \
  template const typename Bulk<dim>::Answers &Bulk<dim>::answers(const PointEvaluator<dim> &, \
                                                                 const bool) const;           \
  template void Bulk<dim>::add_internal_forces(const PointEvaluator<dim> &, Vector &) const;  \
  template void Bulk<dim>::add_tangent(const PointEvaluator<dim> &,                           \
                                       dealii::TrilinosWrappers::SparseMatrix &) const;       \
  template typename Bulk<dim>::Work Bulk<dim>::work(const PointEvaluator<dim> &) const;       \
  template BulkSample<dim>          Bulk<dim>::increment_sample(const PointInCell<dim> &,     \
                                                                const PointEvaluator<dim> &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
