#include <scree/discretization/level_set_nodes.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace scree
{
template <int dim>
LevelSetNodes<dim>::LevelSetNodes(const BackgroundGrid<dim> &grid, const unsigned int degree,
                                  const GaussPoints gauss)
    : grid(grid)
    , lagrange(degree)
    , gauss_points(gauss)
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
LevelSetNodes<dim>::facing_values(const unsigned int cell, const Body<dim> &body,
                                  const dealii::Tensor<1, dim> &towards, double *values) const
{
  cell_values(cell, body.level_set, values);
  if (!body.shape || body.shape->is_smooth())
    return;
  const GridCell<dim>                  &geometry = grid.cells()[cell];
  const double                          size     = geometry.size;
  const std::vector<dealii::Point<dim>> nodes    = initial_nodes(cell, body);
  // The pieces near a node: their distances where the body is now, and whether they look towards.
  struct Side
  {
    double distance;
    bool   faces;
  };
  const auto sides_near = [&](const unsigned int i, const double reach) {
    dealii::BoundingBox<dim> box({nodes[i], nodes[i]});
    box.extend(reach);
    std::vector<SmoothPiece<dim>> pieces;
    body.shape->append_pieces(box, pieces);
    const dealii::Point<dim> x = geometry.lower + size * dealii::Tensor<1, dim>(lagrange.node(i));
    std::vector<Side>        result;
    for (const auto &piece : pieces)
      {
        const dealii::Tensor<1, dim> slope    = value_and_gradient(body, piece, x).second;
        const double                 distance = piece.value(nodes[i]) / slope.norm();
        if (std::abs(distance) <= 1.001 * reach)
          result.push_back({distance, slope * towards > -0.5 * slope.norm() * towards.norm()});
      }
    return result;
  };
  // Nodes of cells on the side that is seen lie no farther behind a body of one cell.
  constexpr double behind = 0.5;
  for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
    {
      if (values[i] > behind * size)
        continue;
      const double reach  = std::abs(values[i]) + 1e-9 * size;
      const auto   looks  = [](const Side &side) { return side.faces; };
      const auto   nearby = reach > 3. * size ? std::vector<Side>() : sides_near(i, reach);
      if (nearby.empty() || std::any_of(nearby.begin(), nearby.end(), looks))
        continue;
      double largest = std::numeric_limits<double>::lowest();
      for (const auto &side : sides_near(i, reach + 2. * size))
        if (side.faces)
          largest = std::max(largest, side.distance);
      if (largest > std::numeric_limits<double>::lowest())
        values[i] = largest;
    }
}

template <int dim>
void
LevelSetNodes<dim>::nudged(const double *values, const double cell_size, double *scaled) const
{
  nudge(values, lagrange.n_nodes, cell_size, scaled);
}

template <int dim>
std::vector<dealii::Point<dim>>
LevelSetNodes<dim>::initial_nodes(const unsigned int cell, const Body<dim> &body) const
{
  const GridCell<dim>            &geometry = grid.cells()[cell];
  std::vector<dealii::Point<dim>> result;
  for (unsigned int i = 0; i < lagrange.n_nodes; ++i)
    result.push_back(geometry.lower + geometry.size * dealii::Tensor<1, dim>(lagrange.node(i)));
  if (!body.is_rigid() && body.displacement.is_empty())
    return result;
  for (auto &x : result)
    x = initial_position(body, x);
  for (const auto &[node, masters] : hanging[cell])
    {
      result[node] = dealii::Point<dim>();
      for (const auto &[point, weight] : masters)
        result[node] += weight * dealii::Tensor<1, dim>(initial_position(body, point));
    }
  return result;
}

template <int dim>
CellCut<dim>
LevelSetNodes<dim>::cut(const unsigned int cell, const Body<dim> &body) const
{
  const GridCell<dim> &geometry  = grid.cells()[cell];
  const double         at_centre = body.level_set.value(geometry.centre(), 1);
  CellCut<dim>         result;
  if (std::abs(at_centre) > 1.5 * std::sqrt(double(dim)) * geometry.size)
    {
      result.location = at_centre < 0. ? CellLocation::inside : CellLocation::outside;
      return result;
    }
  if (body.shape && !body.shape->is_smooth())
    return cut_by_pieces(*body.shape, lagrange, initial_nodes(cell, body), geometry.size);
  std::array<double, max_nodes_per_cell<dim>> values;
  cell_values(cell, body.level_set, values.data());
  nudged(values.data(), geometry.size, result.scaled.data());
  result.location = location_of(result.scaled.data(), lagrange.n_nodes);
  return result;
}

template class LevelSetNodes<2>;
template class LevelSetNodes<3>;
} // namespace scree
