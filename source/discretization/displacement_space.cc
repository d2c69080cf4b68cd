#include <scree/base/sort_and_unite.h>
#include <scree/discretization/displacement_space.h>
#include <scree/grid/cell_bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace scree
{
template <int dim>
DisplacementSpace<dim>::DisplacementSpace(const BackgroundGrid<dim>    &grid,
                                          const unsigned int            degree,
                                          const LevelSetNodes<dim>     &level_set_nodes,
                                          const std::vector<Body<dim>> &bodies,
                                          const unsigned int            n_multipliers)
    : basis(degree)
    , grid(grid)
    , n_multipliers(n_multipliers)
{
  for (const auto &body : bodies)
    {
      rigid_offset.push_back(n_rigid);
      n_rigid += body.is_rigid() ? n_rigid_components<dim> : 0;
    }
  classify(level_set_nodes, bodies);
  colour_bodies(bodies.size());
  std::vector<FieldNodes> of_fields;
  for (const std::vector<int> &active : active_of_grid_cell)
    {
      std::vector<bool> is_active(active.size());
      std::transform(active.begin(), active.end(), is_active.begin(),
                     [](const int cell) { return cell >= 0; });
      of_fields.push_back(lagrange_nodes(grid, basis, is_active));
    }
  number(of_fields);
  list_nodes(of_fields);
  collect_constraints(of_fields);
}

template <int dim>
void
DisplacementSpace<dim>::classify(const LevelSetNodes<dim>     &level_set_nodes,
                                 const std::vector<Body<dim>> &bodies)
{
  bodies_of_cell.resize(grid.cells().size());
  CellBodies<dim>(bodies).visit(
    grid.triangulation(), [](const double size) { return size; },
    [&](const auto &cell, const std::vector<unsigned int> &near) {
      const unsigned int c = grid.local_index(*cell);
      for (const unsigned int b : near)
        {
          if (bodies[b].is_rigid())
            continue;
          const CellLocation location = level_set_nodes.cut(c, bodies[b]).location;
          if (location != CellLocation::outside)
            bodies_of_cell[c].emplace_back(b, location == CellLocation::cut);
        }
    });
  using Content = std::vector<std::pair<unsigned int, bool>>;
  dealii::GridTools::exchange_cell_data_to_ghosts<Content, dealii::Triangulation<dim>>(
    grid.triangulation(),
    [&](const auto &cell) -> std::optional<Content> {
      return bodies_of_cell[grid.local_index(*cell)];
    },
    [&](const auto &cell, const Content &content) {
      bodies_of_cell[grid.local_index(*cell)] = content;
    });
}

template <int dim>
void
DisplacementSpace<dim>::colour_bodies(const unsigned int n_bodies)
{
  // Bodies at each vertex; two bodies conflict where a cell has vertices of both.
  std::vector<std::vector<unsigned int>> bodies_at_vertex(grid.triangulation().n_vertices());
  for (unsigned int c = 0; c < grid.cells().size(); ++c)
    for (const auto &[body, is_cut] : bodies_of_cell[c])
      for (const unsigned int v : grid.cells()[c].iterator->vertex_indices())
        bodies_at_vertex[grid.cells()[c].iterator->vertex_index(v)].push_back(body);
  using Edge = std::pair<unsigned int, unsigned int>; // a < b
  std::vector<Edge>         conflicts;
  std::vector<unsigned int> near;
  for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
    {
      near.clear();
      for (const unsigned int v : grid.cells()[c].iterator->vertex_indices())
        {
          const auto &there = bodies_at_vertex[grid.cells()[c].iterator->vertex_index(v)];
          near.insert(near.end(), there.begin(), there.end());
        }
      sort_and_unite(near);
      for (const unsigned int b : near)
        for (const unsigned int a : near)
          if (a < b && (conflicts.empty() || conflicts.back() != Edge(a, b)))
            conflicts.emplace_back(a, b);
    }
  sort_and_unite(conflicts);
  // Below each body, those in conflict with it on some process.
  std::vector<std::vector<unsigned int>> below(n_bodies);
  for (const auto &of_process : dealii::Utilities::MPI::all_gather(grid.communicator(), conflicts))
    for (const auto &[a, b] : of_process)
      below[b].push_back(a);

  colour.resize(n_bodies);
  unsigned int n_colours = 0;
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      std::set<unsigned int> taken;
      for (const unsigned int a : below[b])
        taken.insert(colour[a]);
      while (taken.count(colour[b]))
        ++colour[b];
      n_colours = std::max(n_colours, colour[b] + 1);
    }

  active_of_grid_cell.assign(n_colours, std::vector<int>(grid.cells().size(), -1));
  for (unsigned int c = 0; c < grid.cells().size(); ++c)
    {
      if (c == grid.n_owned_cells())
        n_owned = active_cells.size();
      for (const auto &[body, is_cut] : bodies_of_cell[c])
        {
          active_of_grid_cell[colour[body]][c] = active_cells.size();
          active_cells.push_back({c, body, colour[body], is_cut});
        }
    }
  if (grid.cells().size() == grid.n_owned_cells())
    n_owned = active_cells.size();
}

template <int dim>
void
DisplacementSpace<dim>::number(const std::vector<FieldNodes> &of_fields)
{
  const unsigned int    rank    = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
  const unsigned int    n_ranks = dealii::Utilities::MPI::n_mpi_processes(grid.communicator());
  std::vector<DofIndex> n_of_process(n_ranks, 0);
  for (const FieldNodes &of_field : of_fields)
    {
      std::vector<DofIndex> starts(n_ranks + 1, 0);
      const auto counts = dealii::Utilities::MPI::all_gather(grid.communicator(), of_field.n_owned);
      for (unsigned int p = 0; p < n_ranks; ++p)
        starts[p + 1] = starts[p] + counts[p];
      global_start.push_back(n_of_process); // for now the offset inside the process
      for (unsigned int p = 0; p < n_ranks; ++p)
        n_of_process[p] += counts[p];
      field_start.push_back(starts);
    }
  n_of_process.back() += n_trailing();
  DofIndex process_offset = 0, owned_begin = 0;
  for (unsigned int p = 0; p < n_ranks; ++p)
    {
      for (auto &start : global_start)
        start[p] += process_offset;
      if (p == rank)
        owned_begin = process_offset;
      process_offset += n_of_process[p];
    }
  owned_dofs = dealii::IndexSet(process_offset);
  owned_dofs.add_range(owned_begin, owned_begin + n_of_process[rank]);
  owned_dofs.compress();
}

template <int dim>
DofIndex
DisplacementSpace<dim>::global_index(const unsigned int field, const DofIndex local) const
{
  const auto        &starts = field_start[field];
  const unsigned int process
    = std::upper_bound(starts.begin(), starts.end(), local) - starts.begin() - 1;
  return global_start[field][process] + local - starts[process];
}

template <int dim>
void
DisplacementSpace<dim>::list_nodes(const std::vector<FieldNodes> &of_fields)
{
  std::vector<DofIndex> relevant;
  cell_nodes.resize(active_cells.size() * basis.n_nodes);
  for (unsigned int f = 0; f < of_fields.size(); ++f)
    {
      auto local = of_fields[f].of_cells.begin();
      for (const int a : active_of_grid_cell[f])
        for (unsigned int i = 0; a >= 0 && i < basis.n_nodes; ++i)
          {
            const DofIndex node                            = global_index(f, *local++);
            cell_nodes[std::size_t(a) * basis.n_nodes + i] = node;
            for (unsigned int d = 0; d < dim; ++d)
              relevant.push_back(node + d);
          }
    }
  sort_and_unite(relevant);
  relevant_dofs = owned_dofs;
  relevant_dofs.add_indices(relevant.begin(), relevant.end());
  relevant_dofs.add_range(n_dofs() - n_trailing(), n_dofs());
}

template <int dim>
void
DisplacementSpace<dim>::collect_constraints(const std::vector<FieldNodes> &of_fields)
{
  std::vector<FieldNodes::Constraint> lines;
  for (unsigned int f = 0; f < of_fields.size(); ++f)
    for (const auto &[unknown, masters] : of_fields[f].constraints)
      {
        lines.push_back({global_index(f, unknown), {}});
        for (const auto &[master, weight] : masters)
          {
            lines.back().masters.emplace_back(global_index(f, master), weight);
            relevant_dofs.add_index(lines.back().masters.back().first);
          }
      }
  relevant_dofs.compress();
  constraints.reinit(relevant_dofs);
  for (const auto &[unknown, masters] : lines)
    {
      constraints.add_line(unknown);
      constraints.add_entries(unknown, masters);
    }
  constraints.close();
}

template <int dim>
int
DisplacementSpace<dim>::active_cell(const unsigned int grid_cell, const unsigned int body) const
{
  const int active = active_of_grid_cell[colour[body]][grid_cell];
  return active >= 0 && active_cells[active].body == body ? active : -1;
}

template <int dim>
int
DisplacementSpace<dim>::nearest_active_cell(const dealii::Point<dim> &point,
                                            const unsigned int        body) const
{
  const auto here = grid.locate(point);
  if (here.local_cell < 0)
    return -1;
  int nearest = active_cell(here.local_cell, body);
  if (nearest >= 0)
    return nearest;
  // The point lies next to the body: try the cells around its own, nearest first.
  double       smallest = std::numeric_limits<double>::max();
  const double size     = grid.cells()[here.local_cell].size;
  for (const double reach : {1e-6 * size, 0.5 * grid.finest_size(), size})
    {
      for (unsigned int i = 0; i < dealii::Utilities::fixed_power<dim>(3u); ++i)
        {
          dealii::Point<dim> probe = point;
          unsigned int       rest  = i;
          for (unsigned int d = 0; d < dim; ++d, rest /= 3)
            probe[d] += (int(rest % 3) - 1) * reach;
          const auto there  = grid.locate(probe);
          const int  active = there.local_cell < 0 ? -1 : active_cell(there.local_cell, body);
          if (active < 0)
            continue;
          const GridCell<dim> &cell     = grid.cells()[there.local_cell];
          double               distance = 0.;
          for (unsigned int d = 0; d < dim; ++d)
            distance = std::max(
              {distance, cell.lower[d] - point[d], point[d] - cell.lower[d] - cell.size});
          if (distance < smallest)
            {
              smallest = distance;
              nearest  = active;
            }
        }
      if (nearest >= 0)
        return nearest;
    }
  return -1;
}

template <int dim>
dealii::Point<dim>
DisplacementSpace<dim>::unit_point(const unsigned int        active_cell,
                                   const dealii::Point<dim> &point) const
{
  const GridCell<dim> &cell = grid.cells()[active_cells[active_cell].grid_cell];
  return dealii::Point<dim>((point - cell.lower) / cell.size);
}

template <int dim>
void
DisplacementSpace<dim>::evaluate_basis(const unsigned int        active_cell,
                                       const dealii::Point<dim> &unit_point,
                                       ShapeValues<dim>         &shape) const
{
  const double scale = 1. / cell_size(active_cell);
  basis.evaluate_gradients(unit_point, shape);
  for (unsigned int a = 0; a < basis.n_nodes; ++a)
    shape.gradient[a] *= scale;
}

template <int dim>
NodeStencil
DisplacementSpace<dim>::local_stencil(const unsigned int        body,
                                      const dealii::Point<dim> &point) const
{
  const int cell = nearest_active_cell(point, body);
  if (cell < 0)
    return {};
  std::array<double, max_nodes_per_cell<dim>> values;
  basis.evaluate_values(unit_point(cell, point), values.data());
  std::map<DofIndex, double> combination;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    {
      const DofIndex node = nodes(cell)[i];
      if (const auto *entries = constraints.get_constraint_entries(node))
        for (const auto &[master, weight] : *entries)
          combination[master] += weight * values[i];
      else
        combination[node] += values[i];
    }
  return NodeStencil(combination.begin(), combination.end());
}

template <int dim>
std::vector<NodeStencil>
DisplacementSpace<dim>::stencils(const std::vector<unsigned int>       &bodies,
                                 const std::vector<dealii::Point<dim>> &points) const
{
  using Request           = std::pair<std::vector<unsigned int>, std::vector<dealii::Point<dim>>>;
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());

  std::vector<NodeStencil>                          result(points.size());
  std::map<unsigned int, Request>                   requests;
  std::map<unsigned int, std::vector<unsigned int>> origin;
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      const unsigned int owner = grid.locate(points[i]).rank;
      if (owner == rank)
        result[i] = local_stencil(bodies[i], points[i]);
      else
        {
          requests[owner].first.push_back(bodies[i]);
          requests[owner].second.push_back(points[i]);
          origin[owner].push_back(i);
        }
    }
  const auto received = dealii::Utilities::MPI::some_to_some(grid.communicator(), requests);
  std::map<unsigned int, std::vector<NodeStencil>> answers;
  for (const auto &[asker, request] : received)
    for (unsigned int i = 0; i < request.first.size(); ++i)
      answers[asker].push_back(local_stencil(request.first[i], request.second[i]));
  for (const auto &[owner, stencils] :
       dealii::Utilities::MPI::some_to_some(grid.communicator(), answers))
    for (unsigned int i = 0; i < stencils.size(); ++i)
      result[origin[owner][i]] = stencils[i];
  return result;
}

template class DisplacementSpace<2>;
template class DisplacementSpace<3>;
} // namespace scree
