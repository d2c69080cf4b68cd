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
  std::vector<dealii::Tensor<2, dim>> increments;    //!< F_D
  std::vector<IncrementResponse<dim>> responses;
  std::vector<dealii::Tensor<4, dim>> tangents;
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
  const unsigned int        n      = fields.basis.n_nodes;
  const std::vector<double> values = values_by_cell(fields, u);
  CellIncrement             cell;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule points = rule(a);
      cell.active_cell      = a;
      cell.n_points         = points.n_points;
      cell.gradients
        = fields.cells()[a].is_cut ? &cut_gradients[first_gradient[a]] : whole_gradients.data();
      cell.gradient_scale = 1. / fields.grid.cells()[fields.cells()[a].grid_cell].size;
      cell.volume_ratios  = &volume_ratios[first_point[a]];
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
      bodies[fields.cells()[a].body].law->respond(
        dealii::make_array_view(cell.increments.begin(), cell.increments.end()),
        dealii::ArrayView<const IncrementStart>(&starts[first_point[a]], points.n_points),
        dealii::make_array_view(cell.responses.begin(), cell.responses.end()),
        dealii::make_array_view(cell.tangents.begin(), cell.tangents.end()));
      f(cell);
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
                            const dealii::Tensor<2, dim> &gradient) const
{
  const auto &law     = *bodies[fields.cells()[point.active_cell].body].law;
  const auto  history = start->histories({point}).front();

  std::vector<dealii::Tensor<2, dim>> increment
    = {gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>())};
  const std::vector<IncrementStart>   at_start = {law.start(history)};
  std::vector<IncrementResponse<dim>> response(1);
  std::vector<dealii::Tensor<4, dim>> no_tangent;
  law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(increment.data(), 1),
              dealii::ArrayView<const IncrementStart>(at_start.data(), 1),
              dealii::make_array_view(response.begin(), response.end()),
              dealii::make_array_view(no_tangent.begin(), no_tangent.end()));
  BulkSample<dim> result;
  result.displacement = start->deformation(point).displacement + displacement;
  // Green's strain
  const dealii::Tensor<2, dim> F = increment[0] * history.deformation_gradient;
  result.strain = 0.5 * (symmetrize(transpose(F) * F) - dealii::unit_symmetric_tensor<dim>());
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result.stress[i][j] = response[0].cauchy[i][j];
  if (dim == 2)
    result.out_of_plane_stress = response[0].cauchy[2][2];
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                   \
  template void Bulk<dim>::set_up_increments();                                                  \
  template void Bulk<dim>::add_internal_forces(const Vector &, Vector &) const;                  \
  template void Bulk<dim>::add_tangent(const Vector &, dealii::TrilinosWrappers::SparseMatrix &) \
    const;                                                                                       \
  template typename Bulk<dim>::Work Bulk<dim>::work(const Vector &) const;                       \
  template BulkSample<dim>          Bulk<dim>::increment_sample(const PointInCell<dim> &,        \
                                                                const dealii::Tensor<1, dim> &,  \
                                                                const dealii::Tensor<2, dim> &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
