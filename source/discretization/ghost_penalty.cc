#include <scree/base/sort_and_unite.h>
#include <scree/discretization/ghost_penalty.h>

#include <algorithm>

namespace scree
{
namespace
{
/** The nodes of a face's two cells, those that they share twice. */
template <int dim>
std::vector<DofIndex>
nodes_of(const DisplacementSpace<dim> &space, const GhostFace &face)
{
  const unsigned int    n = space.basis.n_nodes;
  std::vector<DofIndex> nodes(space.nodes(face.cell), space.nodes(face.cell) + n);
  nodes.insert(nodes.end(), space.nodes(face.neighbor), space.nodes(face.neighbor) + n);
  return nodes;
}
} // namespace

template <int dim>
GhostPenalty<dim>::GhostPenalty(const DisplacementSpace<dim> &space, const double factor)
    : space(space)
    , gamma(factor)
    , jumps(space)
{
}

template <int dim>
double
GhostPenalty<dim>::factor_of(const GhostFace &face, const CutStiffness &stiffness) const
{
  return gamma * stiffness.of_bodies[space.cells()[face.cell].body]
         * std::min(stiffness.ratios[face.cell], stiffness.ratios[face.neighbor]);
}

template <int dim>
std::vector<std::vector<DofIndex>>
GhostPenalty<dim>::couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const GhostFace &face : jumps.faces())
    {
      std::vector<DofIndex> nodes = nodes_of(space, face);
      sort_and_unite(nodes);
      result.push_back(nodes);
    }
  return result;
}

template <int dim>
void
GhostPenalty<dim>::add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const
{
  dealii::FullMatrix<double> block;
  for (const GhostFace &face : jumps.faces())
    {
      const double factor  = factor_of(face, stiffness);
      const auto   of_face = jumps.block(face);
      block.reinit(of_face.nodes.size() * dim, of_face.nodes.size() * dim);
      for (unsigned int i = 0; i < of_face.nodes.size(); ++i)
        for (unsigned int j = 0; j < of_face.nodes.size(); ++j)
          for (unsigned int d = 0; d < dim; ++d)
            block(i * dim + d, j * dim + d) = factor * of_face.matrix(i, j);
      space.hanging_constraints().distribute_local_to_global(
        block, unknowns_of_nodes<dim>(of_face.nodes.data(), of_face.nodes.size()), matrix);
    }
}

template <int dim>
std::vector<dealii::Vector<double>>
GhostPenalty<dim>::carried(const GhostFace &face, const PointEvaluator<dim> &start) const
{
  const unsigned int                  n = space.basis.n_nodes;
  std::vector<dealii::Vector<double>> result(dim, dealii::Vector<double>(2 * n));
  const auto                          is_zero = [&](const unsigned int cell) {
    const double *values = start.nodal_values(cell);
    return std::all_of(values, values + n * dim, [](const double value) { return value == 0.; });
  };
  if (is_zero(face.cell) && is_zero(face.neighbor)) // as on a fixed geometry
    return result;
  dealii::Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = d == face.face / 2 ? face.face % 2 : 0.5;
  const auto             x = space.position(face.cell, middle);
  dealii::Tensor<2, dim> G = dealii::unit_symmetric_tensor<dim>();
  for (const unsigned int cell : {face.cell, face.neighbor})
    G -= 0.5 * start.gradient({cell, space.unit_point(cell, x)});
  const dealii::Tensor<2, dim> R = transpose(project_onto_orthogonal_tensors(G));

  for (unsigned int i = 0; i < 2 * n; ++i)
    {
      const double *u_n
        = start.nodal_values(i < n ? face.cell : face.neighbor) + (i < n ? i : i - n) * dim;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          result[d](i) += R[d][e] * u_n[e];
    }
  return result;
}

template <int dim>
void
GhostPenalty<dim>::add_start_forces(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                                    Vector &forces) const
{
  const unsigned int     n = space.basis.n_nodes;
  dealii::Vector<double> of_component(2 * n), of_face(2 * n * dim);
  for (const GhostFace &face : jumps.faces())
    {
      const auto   matrix = jumps.matrix(face);
      const auto   u_n    = carried(face, start);
      const double factor = factor_of(face, stiffness);
      for (unsigned int d = 0; d < dim; ++d)
        {
          matrix.vmult(of_component, u_n[d]);
          for (unsigned int i = 0; i < 2 * n; ++i)
            of_face(i * dim + d) = factor * of_component(i);
        }
      const std::vector<DofIndex> nodes = nodes_of(space, face);
      space.hanging_constraints().distribute_local_to_global(
        of_face, unknowns_of_nodes<dim>(nodes.data(), nodes.size()), forces);
    }
}

template <int dim>
double
GhostPenalty<dim>::energy(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                          const PointEvaluator<dim> &u) const
{
  const unsigned int n      = space.basis.n_nodes;
  double             energy = 0.;
  for (const GhostFace &face : jumps.faces())
    {
      const auto matrix = jumps.matrix(face);
      auto       nodal  = carried(face, start);
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int i = 0; i < n; ++i)
            {
              nodal[d](i) += u.nodal_values(face.cell)[i * dim + d];
              nodal[d](n + i) += u.nodal_values(face.neighbor)[i * dim + d];
            }
          energy += 0.5 * factor_of(face, stiffness) * matrix.matrix_norm_square(nodal[d]);
        }
    }
  return energy;
}

template class GhostPenalty<2>;
template class GhostPenalty<3>;
} // namespace scree
