#include <scree/mechanics/linear_bulk.h>
#include <scree/mechanics/volume_projection.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <map>

namespace scree
{
namespace
{
template <int dim>
std::vector<double>
shares_of_materials(const std::vector<Body<dim>> &bodies)
{
  std::vector<double> result;
  for (const auto &body : bodies)
    {
      const auto *material = body.material.get();
      result.push_back(
        material
          ? IsotropicModuli{material->lame_lambda(), material->shear_modulus()}.projected_share(dim)
          : 0.);
    }
  return result;
}
} // namespace

template <int dim>
LinearBulk<dim>::LinearBulk(const DisplacementSpace<dim> &space,
                            const CutQuadrature<dim>     &quadrature,
                            const std::vector<Body<dim>> &bodies,
                            const SmallCutTreatment<dim> &small_cuts)
    : Bulk<dim>(space, quadrature, bodies, small_cuts, shares_of_materials(bodies))
{
}

template <int dim>
void
LinearBulk<dim>::cell_stiffness(const unsigned int          active_cell,
                                dealii::FullMatrix<double> &matrix) const
{
  const ActiveCell  &cell   = space.cells()[active_cell];
  const double       scale  = 1. / space.cell_size(active_cell);
  const double       lambda = bodies[cell.body].material->lame_lambda();
  const double       mu     = bodies[cell.body].material->shear_modulus();
  const unsigned int n      = space.basis.n_nodes;
  const auto         points = this->rule(active_cell);

  // products[i][j](a, b) = int d_i N_a d_j N_b, then the isotropic tensor once.
  constexpr unsigned int n_max                            = max_nodes_per_cell<dim>;
  double                 products[dim][dim][n_max][n_max] = {};
  double                 gradient[dim][n_max];
  ShapeValues<dim>       shape;
  for (unsigned int q = 0; q < points.n_points; ++q)
    {
      space.basis.evaluate_gradients(points.points[q], shape);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d][a] = shape.gradient[a][d] * scale;
      const double weight = points.weights[q] * points.weight_scale;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int a = 0; a < n; ++a)
            {
              const double factor = weight * gradient[i][a];
              for (unsigned int b = 0; b < n; ++b)
                products[i][j][a][b] += factor * gradient[j][b];
            }
    }
  matrix.reinit(n * dim, n * dim);
  const double projected = this->projected_lambda(cell.body);
  if (projected > 0.)
    add_projected_stiffness(active_cell, projected, matrix);
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
      {
        double trace = 0.;
        for (unsigned int k = 0; k < dim; ++k)
          trace += products[k][k][a][b];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            matrix(a * dim + i, b * dim + j) += (lambda - projected) * products[i][j][a][b]
                                                + mu * products[j][i][a][b]
                                                + (i == j ? mu * trace : 0.);
      }
}

template <int dim>
void
LinearBulk<dim>::add_projected_stiffness(const unsigned int active_cell, const double lambda,
                                         dealii::FullMatrix<double> &matrix) const
{
  const auto             points = this->rule(active_cell);
  const unsigned int     n      = space.basis.n_nodes * dim;
  const double           scale  = 1. / space.cell_size(active_cell);
  const VolumeModes<dim> psi(points.points, points.weights, points.n_points, space.volume_degree());
  std::array<std::array<double, dim * max_nodes_per_cell<dim>>, VolumeModes<dim>::n_max> integrals
    = {};
  ShapeValues<dim> shape;
  for (unsigned int q = 0; q < points.n_points; ++q)
    {
      space.basis.evaluate_gradients(points.points[q], shape);
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
void
LinearBulk<dim>::add_to_matrix(Matrix &matrix) const
{
  const auto                &constraints = space.hanging_constraints();
  const unsigned int         n           = space.basis.n_nodes;
  dealii::FullMatrix<double> cell_matrix;
  // Whole cells of one body and size share their matrix.
  std::map<std::pair<unsigned int, double>, dealii::FullMatrix<double>> whole_cells;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell    = space.cells()[a];
      const auto        indices = unknowns_of_nodes<dim>(space.nodes(a), n);
      if (cell.is_cut)
        {
          cell_stiffness(a, cell_matrix);
          constraints.distribute_local_to_global(cell_matrix, indices, matrix);
          continue;
        }
      auto &shared = whole_cells[{cell.body, space.cell_size(a)}];
      if (shared.empty())
        cell_stiffness(a, shared);
      constraints.distribute_local_to_global(shared, indices, matrix);
    }
  Bulk<dim>::add_to_matrix(matrix);
}

template <int dim>
BulkSample<dim>
LinearBulk<dim>::sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                        const PointEvaluator<dim> &u) const
{
  const PointInCell<dim> point        = {active_cell, unit_point};
  const auto            &body         = bodies[space.cells()[active_cell].body];
  const double           share        = this->projected_shares[space.cells()[active_cell].body];
  const auto [displacement, gradient] = u.evaluate(point);
  BulkSample<dim> result;
  result.displacement = displacement;
  result.strain       = symmetrize(gradient);
  if (share > 0.)
    {
      const double correction = share / dim * (this->divergence.value(point, u) - trace(gradient));
      for (unsigned int d = 0; d < dim; ++d)
        result.strain[d][d] += correction;
    }
  result.stress = body.material->stress(result.strain);
  if (dim == 2)
    result.out_of_plane_stress = body.material->out_of_plane_stress(result.strain);
  result.energy_density = body.material->energy_density(result.strain);
  result.volume_ratio   = 1. + trace(result.strain);
  return result;
}

template <int dim>
typename LinearBulk<dim>::Work
LinearBulk<dim>::work(const PointEvaluator<dim> &u) const
{
  // As u K u/2 with the matrices of the cells, which whole cells share.
  const unsigned int                                                    n = space.basis.n_nodes;
  dealii::FullMatrix<double>                                            cut_cell;
  std::map<std::pair<unsigned int, double>, dealii::FullMatrix<double>> whole_cells;
  double                                                                energy = 0.;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      auto &matrix = cell.is_cut ? cut_cell : whole_cells[{cell.body, space.cell_size(a)}];
      if (cell.is_cut || matrix.empty())
        cell_stiffness(a, matrix);
      // Without the translation of the cell, which has no energy but round-off.
      const double                                     *nodal = u.nodal_values(a);
      std::array<double, dim * max_nodes_per_cell<dim>> relative;
      for (unsigned int i = 0; i < n * dim; ++i)
        relative[i] = nodal[i] - nodal[i % dim];
      for (unsigned int i = 0; i < n * dim; ++i)
        for (unsigned int j = 0; j < n * dim; ++j)
          energy += 0.5 * relative[i] * matrix(i, j) * relative[j];
    }
  return {dealii::Utilities::MPI::sum(energy, space.grid.communicator()), 0.};
}

template class LinearBulk<2>;
template class LinearBulk<3>;
} // namespace scree
