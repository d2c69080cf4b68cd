#include <scree/base/exceptions.h>
#include <scree/mechanics/bulk.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <map>
#include <sstream>

namespace scree
{
template <int dim>
Bulk<dim>::Bulk(const Fields<dim> &fields, const CutQuadrature<dim> &quadrature,
                const std::vector<Body<dim>> &bodies, const double ghost_penalty_factor,
                const StepStart<dim> *start)
    : fields(fields)
    , quadrature(quadrature)
    , bodies(bodies)
    , gamma(ghost_penalty_factor)
    , ghost_penalty(fields)
    , start(start)
{
  for (const auto &body : bodies)
    {
      const auto *material = body.material.get();
      projected_shares.push_back(
        !material ? 0.
        : start
          ? body.law->projected_share()
          : IsotropicModuli{material->lame_lambda(), material->shear_modulus()}.projected_share(
            dim));
    }
  set_up_volume_rows();
  secant_ratios.assign(fields.cells().size(), 1.);
  if (start)
    {
      set_up_increments();
      set_up_increment_modes();
      find_secant_ratios();
    }
}

template <int dim>
typename Bulk<dim>::CellRule
Bulk<dim>::rule(const unsigned int active_cell) const
{
  const ActiveCell &cell = fields.cells()[active_cell];
  if (!cell.is_cut)
    return {quadrature.whole_cell.points.data(), quadrature.whole_cell.weights.data(),
            static_cast<unsigned int>(quadrature.whole_cell.points.size()),
            std::pow(fields.grid.cells()[cell.grid_cell].size, dim)};
  const unsigned int begin = quadrature.bulk.begin[active_cell];
  return {quadrature.bulk.points.data() + begin, quadrature.bulk.weights.data() + begin,
          quadrature.bulk.begin[active_cell + 1] - begin, 1.};
}

template <int dim>
void
Bulk<dim>::cell_stiffness(const unsigned int active_cell, dealii::FullMatrix<double> &matrix) const
{
  const ActiveCell  &cell   = fields.cells()[active_cell];
  const double       scale  = 1. / fields.cell_size(active_cell);
  const double       lambda = bodies[cell.body].material->lame_lambda();
  const double       mu     = bodies[cell.body].material->shear_modulus();
  const unsigned int n      = fields.basis.n_nodes;
  const CellRule     points = rule(active_cell);

  // products[i][j](a, b) = int d_i N_a d_j N_b, then the isotropic tensor once.
  constexpr unsigned int n_max                            = max_nodes_per_cell<dim>;
  double                 products[dim][dim][n_max][n_max] = {};
  double                 gradient[dim][n_max];
  ShapeValues<dim>       shape;
  for (unsigned int q = 0; q < points.n_points; ++q)
    {
      fields.basis.evaluate_gradients(points.points[q], shape);
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
  const double projected = projected_lambda(cell.body);
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
Bulk<dim>::add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix)
{
  const auto                &constraints = fields.hanging_constraints();
  const unsigned int         n           = fields.basis.n_nodes;
  dealii::FullMatrix<double> cell_matrix;
  // Whole cells of one body and size share their matrix.
  std::map<std::pair<unsigned int, double>, dealii::FullMatrix<double>> whole_cells;
  for (unsigned int a = 0; a < fields.n_owned_cells() && !start; ++a)
    {
      const ActiveCell &cell    = fields.cells()[a];
      const auto        indices = unknowns_of_nodes<dim>(fields.nodes(a), n);
      if (cell.is_cut)
        {
          cell_stiffness(a, cell_matrix);
          constraints.distribute_local_to_global(cell_matrix, indices, matrix);
          continue;
        }
      auto &shared = whole_cells[{cell.body, fields.grid.cells()[cell.grid_cell].size}];
      if (shared.empty())
        cell_stiffness(a, shared);
      constraints.distribute_local_to_global(shared, indices, matrix);
    }

  if (gamma == 0.)
    return;
  for (const GhostFace &face : ghost_penalty.faces())
    {
      const double factor = ghost_stiffness(face);
      const auto   jumps  = ghost_penalty.block(face);
      cell_matrix.reinit(jumps.nodes.size() * dim, jumps.nodes.size() * dim);
      for (unsigned int i = 0; i < jumps.nodes.size(); ++i)
        for (unsigned int j = 0; j < jumps.nodes.size(); ++j)
          for (unsigned int d = 0; d < dim; ++d)
            cell_matrix(i * dim + d, j * dim + d) = factor * jumps.matrix(i, j);
      constraints.distribute_local_to_global(
        cell_matrix, unknowns_of_nodes<dim>(jumps.nodes.data(), jumps.nodes.size()), matrix);
    }
}

template <int dim>
dealii::Tensor<1, dim>
Bulk<dim>::body_force(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                      const double time) const
{
  const auto                  &body     = bodies[fields.cells()[active_cell].body];
  const auto                  &force    = body.body_force;
  const dealii::Point<dim>     position = fields.position(active_cell, unit_point);
  const dealii::Tensor<1, dim> b        = force.vector(position, time);
  if (!std::isfinite(b.norm_square()))
    {
      std::ostringstream where;
      where << position << ", t = " << time;
      throw UserError(body.path + "/Body force",
                      "'" + force.text() + "' is no finite number at the point " + where.str(),
                      "check divisions, roots and logarithms");
    }
  return b;
}

template <int dim>
void
Bulk<dim>::add_body_forces(Vector &loads, const double time) const
{
  const unsigned int     n = fields.basis.n_nodes;
  std::vector<double>    shape(n);
  dealii::Vector<double> cell_load(n * dim);
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = fields.cells()[a];
      if (bodies[cell.body].body_force.text() == (dim == 2 ? "0; 0" : "0; 0; 0"))
        continue;
      const CellRule points = rule(a);
      const double   size   = fields.grid.cells()[cell.grid_cell].size;
      double         volume = 0., reference_volume = 0.;
      cell_load      = 0.;
      const auto add = [&](const dealii::Point<dim> &unit_point, const double weight) {
        const dealii::Tensor<1, dim> b = weight * body_force(a, unit_point, time);
        fields.basis.evaluate_values(unit_point, shape.data());
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            cell_load(i * dim + d) += shape[i] * b[d];
      };
      for (unsigned int q = 0; q < points.n_points; ++q)
        {
          const double weight    = points.weights[q] * points.weight_scale;
          const double reference = start ? weight / volume_ratios[first_point[a] + q] : weight;
          add(points.points[q], reference);
          volume += weight;
          reference_volume += reference;
        }
      // The strip between the cut and the body's boundary.
      const auto &surface = quadrature.surface;
      for (unsigned int q = surface.begin[a]; q < surface.begin[a + 1] && volume > 0.; ++q)
        if (const double width = quadrature.strip_widths[q]; width != 0.)
          add(surface.points[q] + 0.5 * width / size * surface.normals[q],
              width * surface.weights[q] * reference_volume / volume);
      fields.hanging_constraints().distribute_local_to_global(
        cell_load, unknowns_of_nodes<dim>(fields.nodes(a), n), loads);
    }
}

template <int dim>
std::vector<std::vector<DofIndex>>
Bulk<dim>::couplings() const
{
  const unsigned int                 n = fields.basis.n_nodes;
  std::vector<std::vector<DofIndex>> result;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    result.emplace_back(fields.nodes(a), fields.nodes(a) + n);
  for (const GhostFace &face : ghost_penalty.faces())
    {
      std::vector<DofIndex> nodes(fields.nodes(face.cell), fields.nodes(face.cell) + n);
      nodes.insert(nodes.end(), fields.nodes(face.neighbor), fields.nodes(face.neighbor) + n);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      result.push_back(nodes);
    }
  return result;
}

template <int dim>
BulkSample<dim>
Bulk<dim>::sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                  const PointEvaluator<dim> &u) const
{
  const PointInCell<dim> point = {active_cell, unit_point};
  if (start)
    return increment_sample(point, u);
  const auto  &body                   = bodies[fields.cells()[active_cell].body];
  const double share                  = projected_shares[fields.cells()[active_cell].body];
  const auto [displacement, gradient] = u.evaluate(point);
  BulkSample<dim> result;
  result.displacement = displacement;
  result.strain       = symmetrize(gradient);
  if (share > 0.)
    {
      const double correction = share / dim * (projected_divergence(point, u) - trace(gradient));
      for (unsigned int d = 0; d < dim; ++d)
        result.strain[d][d] += correction;
    }
  result.stress = body.material->stress(result.strain);
  if (dim == 2)
    result.out_of_plane_stress = body.material->out_of_plane_stress(result.strain);
  return result;
}

template <int dim>
double
Bulk<dim>::linear_strain_energy(const PointEvaluator<dim> &u) const
{
  // As u K u/2 with the matrices of the cells, which whole cells share.
  const unsigned int                                                    n = fields.basis.n_nodes;
  dealii::FullMatrix<double>                                            cut_cell;
  std::map<std::pair<unsigned int, double>, dealii::FullMatrix<double>> whole_cells;
  double                                                                energy = 0.;
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const ActiveCell &cell   = fields.cells()[a];
      auto             &matrix = cell.is_cut
                                   ? cut_cell
                                   : whole_cells[{cell.body, fields.grid.cells()[cell.grid_cell].size}];
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
  return energy;
}

template <int dim>
double
Bulk<dim>::ghost_energy(const PointEvaluator<dim> &u)
{
  const unsigned int n      = fields.basis.n_nodes;
  double             energy = 0.;
  if (gamma > 0.)
    for (const GhostFace &face : ghost_penalty.faces())
      {
        const auto   jumps  = ghost_penalty.matrix(face);
        const double factor = ghost_stiffness(face);
        for (unsigned int d = 0; d < dim; ++d)
          {
            dealii::Vector<double> nodal(2 * n);
            for (unsigned int i = 0; i < n; ++i)
              {
                nodal(i)     = u.nodal_values(face.cell)[i * dim + d];
                nodal(n + i) = u.nodal_values(face.neighbor)[i * dim + d];
              }
            energy += 0.5 * factor * jumps.matrix_norm_square(nodal);
          }
      }
  return dealii::Utilities::MPI::sum(energy, fields.grid.communicator());
}

template <int dim>
std::vector<double>
Bulk<dim>::volumes() const
{
  std::vector<double> volume(bodies.size(), 0.);
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const CellRule points = rule(a);
      for (unsigned int q = 0; q < points.n_points; ++q)
        volume[fields.cells()[a].body] += points.weights[q] * points.weight_scale;
    }
  dealii::Utilities::MPI::sum(volume, fields.grid.communicator(), volume);
  return volume;
}

template <int dim>
void
Bulk<dim>::add_lumped_volumes(Vector &volumes, const std::vector<double> &factor_of_body) const
{
  const unsigned int     n = fields.basis.n_nodes;
  dealii::Vector<double> lumped(n * dim);
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const double factor = factor_of_body[fields.cells()[a].body];
      if (factor == 0.)
        continue;
      // Equal shares: those of the basis functions are not all positive for degree 2.
      const CellRule points = rule(a);
      double         volume = 0.;
      for (unsigned int q = 0; q < points.n_points; ++q)
        volume += points.weights[q] * points.weight_scale;
      lumped = factor * volume / n;
      fields.hanging_constraints().distribute_local_to_global(
        lumped, unknowns_of_nodes<dim>(fields.nodes(a), n), volumes);
    }
}

template class Bulk<2>;
template class Bulk<3>;
} // namespace scree
