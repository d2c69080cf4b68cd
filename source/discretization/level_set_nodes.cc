#include <scree/discretization/level_set_nodes.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/affine_constraints.h>

#include <unordered_map>

namespace scree
{
template <int dim>
LevelSetNodes<dim>::LevelSetNodes(const BackgroundGrid<dim> &grid, const unsigned int degree)
    : grid(grid)
    , lagrange(degree)
    , hanging(grid.n_owned_cells())
{
  if (!grid.triangulation().has_hanging_nodes())
    return;
  using Index = dealii::types::global_dof_index;
  const dealii::FE_Q<dim> element(degree);
  dealii::DoFHandler<dim> dof_handler(grid.triangulation());
  dof_handler.distribute_dofs(element);
  dealii::IndexSet relevant;
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  dealii::AffineConstraints<double> constraints(relevant);
  dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  constraints.close();

  const auto lexicographic = dealii::FETools::hierarchic_to_lexicographic_numbering<dim>(degree);
  const auto indices_of    = [&](const GridCell<dim> &cell, std::vector<Index> &indices) {
    std::vector<Index> hierarchic(lagrange.n_nodes);
    typename dealii::DoFHandler<dim>::active_cell_iterator(
         &grid.triangulation(), cell.iterator->level(), cell.iterator->index(), &dof_handler)
      ->get_dof_indices(hierarchic);
    for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
      indices[lexicographic[i]] = hierarchic[i];
  };

  std::unordered_map<Index, dealii::Point<dim>> points;
  std::vector<Index>                            indices(lagrange.n_nodes);
  for (const auto &cell : grid.cells())
    {
      indices_of(cell, indices);
      for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
        points[indices[i]] = cell.lower + cell.size * dealii::Tensor<1, dim>(lagrange.node(i));
    }
  for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
    {
      indices_of(grid.cells()[c], indices);
      for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
        if (constraints.is_constrained(indices[i]))
          {
            HangingNode node{i, {}};
            for (const auto &[master, weight] : *constraints.get_constraint_entries(indices[i]))
              node.masters.emplace_back(points.at(master), weight);
            hanging[c].push_back(node);
          }
    }
}

template <int dim>
void
LevelSetNodes<dim>::cell_values(const unsigned int cell, const Lattice<dim> &lattice,
                                double *values) const
{
  const GridCell<dim> &geometry = grid.cells()[cell];
  for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
    values[i] = lattice.nodal_value(geometry.lower
                                    + geometry.size * dealii::Tensor<1, dim>(lagrange.node(i)));
  for (const auto &[node, masters] : hanging[cell])
    {
      values[node] = 0.;
      for (const auto &[point, weight] : masters)
        values[node] += weight * lattice.nodal_value(point);
    }
}

template <int dim>
void
LevelSetNodes<dim>::nudged(const double *values, const double cell_size, double *scaled) const
{
  for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
    {
      scaled[i] = values[i] / cell_size;
      if (std::abs(scaled[i]) < 1e-12)
        scaled[i] = 1e-12;
    }
}

template <int dim>
CellLocation
LevelSetNodes<dim>::classify(const unsigned int cell, const Lattice<dim> &lattice) const
{
  const GridCell<dim> &geometry = grid.cells()[cell];
  dealii::Point<dim>   centre   = geometry.lower;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] += 0.5 * geometry.size;
  const double at_centre = lattice.value(centre, 1);
  if (std::abs(at_centre) > 1.5 * std::sqrt(double(dim)) * geometry.size)
    return at_centre < 0. ? CellLocation::inside : CellLocation::outside;
  std::array<double, max_nodes_per_cell<dim>> values, scaled;
  cell_values(cell, lattice, values.data());
  nudged(values.data(), geometry.size, scaled.data());
  unsigned int n_negative = 0;
  for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
    n_negative += scaled[i] < 0.;
  return n_negative == 0                  ? CellLocation::outside
         : n_negative == lagrange.n_nodes ? CellLocation::inside
                                          : CellLocation::cut;
}

template class LevelSetNodes<2>;
template class LevelSetNodes<3>;
} // namespace scree
