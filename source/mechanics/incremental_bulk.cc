#include <scree/material/increment_response.h>
#include <scree/material/logarithmic_strain.h>
#include <scree/mechanics/incremental_bulk.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree
{
namespace
{
template <int dim>
std::vector<double>
shares_of_laws(const std::vector<Body<dim>> &bodies)
{
  std::vector<double> result;
  result.reserve(bodies.size());
  for (const auto &body : bodies)
    result.push_back(body.law ? body.law->projected_share() : 0.);
  return result;
}
} // namespace

template <int dim>
IncrementalBulk<dim>::IncrementalBulk(const DisplacementSpace<dim> &space,
                                      const CutQuadrature<dim>     &quadrature,
                                      const std::vector<Body<dim>> &bodies,
                                      const SmallCutTreatment<dim> &small_cuts,
                                      const BulkQuadrature<dim>    &points,
                                      const PointEvaluator<dim>    &u_n)
    : Bulk<dim>(space, quadrature, bodies, small_cuts, shares_of_laws(bodies))
    , points(points)
    , u_n(u_n)
    , projection(space, bodies, points, projected_shares)
{
  find_secant_ratios();
}

template <int dim>
CellRule<dim>
IncrementalBulk<dim>::rule(const unsigned int active_cell) const
{
  return points.rule(active_cell);
}

template <int dim>
void
IncrementalBulk<dim>::find_secant_ratios()
{
  std::vector<std::vector<double>> of_cells(space.cells().size(), {1.});
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      // Called by the constructor: its own, whatever is derived.
      const CellRule<dim> cell   = IncrementalBulk<dim>::rule(a);
      double              volume = 0., alpha = 0.;
      for (unsigned int q = 0; q < cell.n_points; ++q)
        {
          volume += cell.weights[q];
          alpha += cell.weights[q] * points.starts(a)[q].alpha;
        }
      if (alpha > 0.)
        of_cells[a] = {bodies[space.cells()[a].body].law->secant_ratio(alpha / volume)};
    }
  exchange_to_ghosts(space, of_cells);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    this->secant_ratios[a] = of_cells[a].front();
}

template <int dim>
void
IncrementalBulk<dim>::set_reference_volumes(const unsigned int   active_cell,
                                            std::vector<double> &volumes) const
{
  Bulk<dim>::set_reference_volumes(active_cell, volumes);
  for (unsigned int q = 0; q < volumes.size(); ++q)
    volumes[q] /= points.volume_ratios(active_cell)[q];
}

template <int dim>
const typename IncrementalBulk<dim>::Answers &
IncrementalBulk<dim>::answers(const PointEvaluator<dim> &u, const bool with_tangents) const
{
  if (!last.renew(u, with_tangents))
    return last;
  last.work = {};
  last.piola.resize(points.n_points());
  last.volumes.resize(space.cells().size());
  if (with_tangents)
    {
      last.tangents.resize(points.n_points());
      const bool is_projected = std::any_of(projected_shares.begin(), projected_shares.end(),
                                            [](const double share) { return share > 0.; });
      last.of_volumes.of_points.resize(is_projected ? points.n_points() : 0);
      last.of_volumes.of_modes.resize(is_projected ? space.n_owned_cells() : 0);
    }
  CellIncrement cell;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    ask(a, cell);
  return last;
}

template <int dim>
void
IncrementalBulk<dim>::ask(const unsigned int active_cell, CellIncrement &cell) const
{
  const CellRule<dim> rule         = points.rule(active_cell);
  const unsigned int  n            = rule.n_points;
  const unsigned int  body         = space.cells()[active_cell].body;
  const std::size_t   first        = points.first_point(active_cell);
  const bool          is_projected = projected_shares[body] > 0.;
  cell.active_cell                 = active_cell;
  cell.n_points                    = n;
  cell.weights.resize(n);
  cell.increments.resize(n);
  cell.responses.resize(n);
  const double *shape = points.unit_gradients(active_cell);
  for (unsigned int q = 0; q < n; ++q, shape += space.basis.n_nodes * dim)
    {
      cell.weights[q]    = rule.weights[q] * rule.weight_scale;
      cell.increments[q] = points.increment(*last.u, active_cell, shape);
    }
  if (is_projected)
    projection.project(cell, last.volumes[active_cell]);
  dealii::Tensor<4, dim> *tangents = last.has_tangents ? last.tangents.data() + first : nullptr;
  bodies[body].law->respond(
    dealii::make_array_view(cell.increments),
    dealii::ArrayView<const IncrementStart>(points.starts(active_cell), n),
    dealii::make_array_view(cell.responses),
    dealii::ArrayView<dealii::Tensor<4, dim>>(tangents, last.has_tangents ? n : 0));
  if (is_projected)
    projection.pull_back(cell, tangents, last.of_volumes);
  for (unsigned int q = 0; q < n; ++q)
    {
      const double reference_weight = cell.weights[q] / points.volume_ratios(active_cell)[q];
      last.work.energy += reference_weight * cell.responses[q].energy;
      last.work.dissipation += reference_weight * cell.responses[q].dissipation;
      last.piola[first + q] = cell.responses[q].piola;
    }
}

template <int dim>
void
IncrementalBulk<dim>::add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const
{
  const auto            &piola = answers(u, std::exchange(last.expects_tangent, false)).piola;
  const unsigned int     n     = space.basis.n_nodes;
  dealii::Vector<double> cell_forces(n * dim);
  std::vector<DofIndex>  unknowns;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim> cell  = points.rule(a);
      const double        scale = cell.weight_scale / space.cell_size(a);
      const double       *shape = points.unit_gradients(a);
      cell_forces               = 0.;
      for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
        {
          const dealii::Tensor<2, dim> P
            = cell.weights[q] * scale * piola[points.first_point(a) + q];
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                cell_forces(b * dim + i) += P[i][j] * shape[b * dim + j];
        }
      set_unknowns_of_nodes<dim>(space.nodes(a), n, unknowns);
      space.hanging_constraints().distribute_local_to_global(cell_forces, unknowns, forces);
    }
}

namespace
{
/** A cell's stiffness, a matrix over the nodes for each pair of components: the inner loops run
 * over neighbouring numbers. */
template <int dim>
struct StiffnessByComponents
{
  static constexpr unsigned int n_max = max_nodes_per_cell<dim>;

  double entries[dim][dim][n_max][n_max];
  double shape[dim][n_max];

  void clear(const unsigned int n)
  {
    for (auto &row : entries)
      for (auto &matrix : row)
        for (unsigned int a = 0; a < n; ++a)
          std::fill_n(matrix[a], n, 0.);
  }

  /** Adds weight A_ijkl dN_a/dx_j dN_b/dx_l for the components i, k and the nodes a, b. */
  void add(const dealii::Tensor<4, dim> &A, const double *gradients, const unsigned int n,
           const double weight)
  {
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int l = 0; l < dim; ++l)
        shape[l][b] = gradients[b * dim + l];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int a = 0; a < n; ++a)
          {
            double *row = entries[i][k][a];
            double  factor[dim];
            for (unsigned int l = 0; l < dim; ++l)
              {
                double sum = 0.;
                for (unsigned int j = 0; j < dim; ++j)
                  sum += A[i][j][k][l] * shape[j][a];
                factor[l] = weight * sum;
              }
            for (unsigned int b = 0; b < n; ++b)
              {
                double sum = factor[0] * shape[0][b];
                for (unsigned int l = 1; l < dim; ++l)
                  sum += factor[l] * shape[l][b];
                row[b] += sum;
              }
          }
  }

  void copy_to(dealii::FullMatrix<double> &block, const unsigned int n) const
  {
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int k = 0; k < dim; ++k)
            block(a * dim + i, b * dim + k) = entries[i][k][a][b];
  }
};
} // namespace

template <int dim>
void
IncrementalBulk<dim>::add_tangent(const PointEvaluator<dim> &u, Matrix &matrix) const
{
  const auto &tangents         = answers(u, true).tangents;
  last.expects_tangent         = true;
  const unsigned int         n = space.basis.n_nodes;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  StiffnessByComponents<dim> stiffness;
  if (!scatter || !scatter->fits(matrix)) // contact may be sought again on the same bulk
    scatter.emplace(space, matrix);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim> cell  = points.rule(a);
      const double        scale = cell.weight_scale / std::pow(space.cell_size(a), 2);
      const double       *shape = points.unit_gradients(a);
      stiffness.clear(n);
      for (unsigned int q = 0; q < cell.n_points; ++q, shape += n * dim)
        stiffness.add(tangents[points.first_point(a) + q], shape, n, cell.weights[q] * scale);
      stiffness.copy_to(block, n);
      if (projected_shares[space.cells()[a].body] > 0.)
        projection.add_couplings(a, last.of_volumes, block);
      scatter->add(a, block, matrix);
    }
}

template <int dim>
typename IncrementalBulk<dim>::Work
IncrementalBulk<dim>::work(const PointEvaluator<dim> &u) const
{
  Work           result       = answers(u, false).work;
  const MPI_Comm communicator = space.grid.communicator();
  result.energy               = dealii::Utilities::MPI::sum(result.energy, communicator);
  result.dissipation          = dealii::Utilities::MPI::sum(result.dissipation, communicator);
  return result;
}

template <int dim>
BulkSample<dim>
IncrementalBulk<dim>::sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                             const PointEvaluator<dim> &u) const
{
  const PointInCell<dim> point        = {active_cell, unit_point};
  const auto            &law          = *bodies[space.cells()[active_cell].body].law;
  const auto             history      = points.histories({point}).front();
  const auto             at_start     = law.start(history);
  const auto [displacement, gradient] = u.evaluate(point);

  const dealii::Tensor<2, dim> F_D
    = gradient + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  const dealii::Tensor<2, dim> projected = projection.projected_increment(
    active_cell, unit_point, projection.cell_volume(active_cell, u), F_D, at_start);
  IncrementResponse<dim> response;
  law.respond(dealii::ArrayView<const dealii::Tensor<2, dim>>(&projected, 1),
              dealii::ArrayView<const IncrementStart>(&at_start, 1),
              dealii::ArrayView<IncrementResponse<dim>>(&response, 1), {});
  BulkSample<dim> result;
  result.displacement                  = u_n.value(point) + displacement;
  const dealii::Tensor<2, 3> F         = embed<dim>(projected * history.deformation_gradient);
  const dealii::Tensor<2, 3> logarithm = LogarithmicStrain(eigensystem(F * transpose(F))).value();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      {
        result.strain[i][j] = logarithm[i][j];
        result.stress[i][j] = response.cauchy[i][j];
      }
  if (dim == 2)
    result.out_of_plane_stress = response.cauchy[2][2];
  result.plastic_strain = response.alpha;
  result.energy_density = response.energy;
  result.volume_ratio   = determinant(F);
  return result;
}

template <int dim>
std::vector<StressIntegral<dim>>
IncrementalBulk<dim>::stress_integrals(const PointEvaluator<dim> &u) const
{
  const auto                      &piola = answers(u, false).piola;
  std::vector<StressIntegral<dim>> result(bodies.size());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim>  cell  = points.rule(a);
      const double        *shape = points.unit_gradients(a);
      StressIntegral<dim> &sum   = result[space.cells()[a].body];
      for (unsigned int q = 0; q < cell.n_points; ++q, shape += space.basis.n_nodes * dim)
        {
          const dealii::Tensor<2, dim> F_D    = points.increment(u, a, shape);
          const double                 volume = cell.weights[q] * cell.weight_scale;
          sum.moved_volume += volume * determinant(F_D);
          sum.stress += volume * symmetrize(piola[points.first_point(a) + q] * transpose(F_D));
        }
      sum.volume = sum.moved_volume;
    }
  return result;
}

template <int dim>
const std::vector<typename IncrementVolumes<dim>::CellVolume> &
IncrementalBulk<dim>::cell_volumes(const PointEvaluator<dim> &u) const
{
  return answers(u, false).volumes;
}

template class IncrementalBulk<2>;
template class IncrementalBulk<3>;
} // namespace scree
