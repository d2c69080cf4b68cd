#include <scree/discretization/field_nodes.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/affine_constraints.h>

namespace scree
{
namespace
{
/** First unknowns of the nodes of the active cells, lexicographic in each. */
template <int dim>
std::vector<DofIndex>
nodes_of_cells(const BackgroundGrid<dim> &grid, const LagrangeBasis<dim> &basis,
               const std::vector<bool> &is_active, const dealii::DoFHandler<dim> &dof_handler)
{
  const auto &element = dof_handler.get_fe(0);
  const auto  lexicographic
    = dealii::FETools::hierarchic_to_lexicographic_numbering<dim>(basis.degree);
  const unsigned int    n = element.n_dofs_per_cell();
  std::vector<DofIndex> indices(n), result;
  for (unsigned int c = 0; c < grid.cells().size(); ++c)
    {
      if (!is_active[c])
        continue;
      const auto &iterator = grid.cells()[c].iterator;
      typename dealii::DoFHandler<dim>::active_cell_iterator(
        &grid.triangulation(), iterator->level(), iterator->index(), &dof_handler)
        ->get_dof_indices(indices);
      const std::size_t first = result.size();
      result.resize(first + basis.n_nodes);
      for (unsigned int i = 0; i < n; ++i)
        if (const auto [component, node] = element.system_to_component_index(i); component == 0)
          result[first + lexicographic[node]] = indices[i];
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto [component, node] = element.system_to_component_index(i);
          AssertThrow(indices[i] == result[first + lexicographic[node]] + component,
                      dealii::ExcMessage("the components of a node are not contiguous"));
        }
    }
  return result;
}

template <int dim>
std::vector<FieldNodes::Constraint>
hanging_nodes(const dealii::DoFHandler<dim> &dof_handler)
{
  if (dof_handler.n_dofs() == 0)
    return {}; // all bodies are rigid
  dealii::IndexSet relevant;
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  dealii::AffineConstraints<double> constraints(relevant);
  dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  constraints.close();
  std::vector<FieldNodes::Constraint> result;
  for (const auto &line : constraints.get_lines())
    result.push_back({line.index, {line.entries.begin(), line.entries.end()}});
  return result;
}
} // namespace

template <int dim>
FieldNodes
lagrange_nodes(const BackgroundGrid<dim> &grid, const LagrangeBasis<dim> &basis,
               const std::vector<bool> &is_active)
{
  const dealii::hp::FECollection<dim> elements(
    dealii::FESystem<dim>(dealii::FE_Q<dim>(basis.degree), dim),
    dealii::FESystem<dim>(dealii::FE_Nothing<dim>(), dim));
  dealii::DoFHandler<dim> dof_handler(grid.triangulation());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(is_active[grid.local_index(*cell)] ? 0 : 1);
  dof_handler.distribute_dofs(elements);
  return {dof_handler.n_locally_owned_dofs(), nodes_of_cells(grid, basis, is_active, dof_handler),
          hanging_nodes(dof_handler)};
}

template FieldNodes lagrange_nodes(const BackgroundGrid<2> &, const LagrangeBasis<2> &,
                                   const std::vector<bool> &);
template FieldNodes lagrange_nodes(const BackgroundGrid<3> &, const LagrangeBasis<3> &,
                                   const std::vector<bool> &);
} // namespace scree
