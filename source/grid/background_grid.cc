#include <scree/base/exceptions.h>
#include <scree/grid/background_grid.h>
#include <scree/grid/cell_bodies.h>
#include <scree/parameters/expression_entry.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <unordered_map>

namespace scree
{
namespace
{
const EnumNames<GridRefinement> grid_refinement_names
  = {{GridRefinement::uniform, "uniform"}, {GridRefinement::contact, "contact"}};

/** Interleaves the bits of dim integers: the Morton key. */
template <int dim>
std::uint64_t
interleave(const std::array<std::uint32_t, dim> &index)
{
  std::uint64_t key = 0;
  for (unsigned int bit = 0; bit < 63 / dim; ++bit)
    for (unsigned int d = 0; d < dim; ++d)
      key |= std::uint64_t((index[d] >> bit) & 1u) << (bit * dim + d);
  return key;
}

std::string
number(const double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

/** The cell size limit at a point. */
template <int dim>
double
positive_value(const Expression<dim> &limit, const dealii::Point<dim> &x)
{
  const double result = limit.value(x);
  if (result > 0.)
    return result;
  std::ostringstream where;
  where << x;
  throw UserError("Grid/Cell size limit",
                  "'" + limit.text() + "' is " + number(result) + " at the point " + where.str(),
                  "it must be positive everywhere");
}

/** That cells are squares or cubes that rounding can tell apart. */
template <int dim>
void
check_shapes_of_cells(const GridParameters<dim> &p, ParameterSection &section)
{
  double largest_coordinate = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    largest_coordinate = std::max({largest_coordinate, std::abs(p.lower[d]), std::abs(p.upper[d])});
  if (!(largest_coordinate < 1e9 * p.cell_size(p.finest_level)) || !(largest_coordinate < 1e100)
      || !(p.cell_size(p.finest_level) > 1e-100))
    section.error("Upper corner",
                  "the box is so far from the origin, or so large or small, that cells of edge "
                    + number(p.cell_size(p.finest_level)) + " cannot be told apart at "
                    + number(largest_coordinate),
                  "move the origin of coordinates near the bodies, and choose usual units");
  for (unsigned int d = 1; d < dim; ++d)
    {
      const double edge = p.cell_size(0), other = (p.upper[d] - p.lower[d]) / p.cells[d];
      // Corners far from the origin are rounded more than their difference.
      const double rounding
        = 4. * std::numeric_limits<double>::epsilon() * largest_coordinate / p.cells[d];
      if (std::abs(edge - other) > 1e-10 * edge + rounding)
        section.error("Cells",
                      "cells are not squares or cubes: edges " + number(edge) + " and "
                        + number(other),
                      "change Cells or the corners until (upper - lower)/cells agrees");
    }
}

template <int dim>
void
check_number_of_cells(const GridParameters<dim> &p, ParameterSection &section)
{
  if (p.coarsest_level > p.finest_level)
    section.error("Coarsest level", "exceeds Finest level", "lower it");
  // A grid that no memory holds would only show as a run that never starts.
  double             n_cells = 1.;
  const unsigned int level
    = p.refinement == GridRefinement::uniform ? p.finest_level : p.coarsest_level;
  for (unsigned int d = 0; d < dim; ++d)
    n_cells *= double(p.cells[d]) * (1u << level);
  if (n_cells > 1e9)
    section.error(p.refinement == GridRefinement::uniform ? "Finest level" : "Coarsest level",
                  "the grid would start with " + number(n_cells) + " cells, more than 1e9",
                  "lower it or Cells, or set Refinement = contact");
  constexpr int key_bits = 63 / dim; // per direction
  for (unsigned int d = 0; d < dim; ++d)
    if (std::log2(double(p.cells[d])) + p.finest_level > key_bits - 1.)
      section.error("Finest level", "too many cells for a 64 bit Morton key", "lower it");
}
} // namespace

template <int dim>
void
GridParameters<dim>::declare(ParameterSection &section)
{
  const bool is_documentation = section.is_documentation();
  section.entry("Lower corner", lower, "Lower corner of the background box [L].");
  section.entry("Upper corner", upper, "Upper corner of the background box [L].");
  section.entry("Cells", cells,
                "Number of cells per direction at level 0; the cells must be squares or cubes.");
  section.entry("Finest level", finest_level, dealii::Patterns::Integer(0, 20),
                "Level of the finest cells; each level halves the edge of level 0.");
  section.entry("Coarsest level", coarsest_level, dealii::Patterns::Integer(0, 20),
                "Level of the coarsest cells of a refinement by contact.");
  section.entry("Refinement", refinement, grid_refinement_names,
                "uniform: all cells at the finest level; contact: finest where bodies may touch, "
                "coarser with the distance from there.");
  section.entry("Band", band, dealii::Patterns::Double(2.),
                "Width of the finest cells around possible contact, in finest cells.");
  section.entry("Grading", grading, dealii::Patterns::Double(0.),
                "Growth of the cell size per distance from the band; no dimension.");
  section.entry("Cell size limit", cell_size_limit,
                "Expression of x, y, z: no cell there is larger [L]; empty: no limit.");
  if (is_documentation)
    return;
  if (cells.size() != dim || *std::min_element(cells.begin(), cells.end()) == 0)
    {
      section.error("Cells", "needs " + std::to_string(dim) + " positive numbers", "Cells = 10, 4");
      return;
    }
  for (unsigned int d = 0; d < dim; ++d)
    if (!(lower[d] < upper[d]))
      {
        section.error("Upper corner", "must lie above Lower corner in every direction", "");
        return;
      }
  check_shapes_of_cells(*this, section);
  check_number_of_cells(*this, section);
  if (!cell_size_limit.empty() && refinement == GridRefinement::uniform)
    section.error("Cell size limit", "a uniform grid has no use for it",
                  "set Refinement = contact, or remove it");
  if (!cell_size_limit.empty())
    check_expression<dim>(section, "Cell size limit", cell_size_limit, 1);
}

template <int dim>
GridParameters<dim>
GridParameters<dim>::with(const std::shared_ptr<const WantedLevels> &levels) const
{
  GridParameters result = *this;
  result.refinement     = GridRefinement::contact;
  result.finest_level   = levels->finest_level;
  result.coarsest_level = levels->coarsest_level;
  result.wanted_levels  = levels;
  return result;
}

template <int dim>
BackgroundGrid<dim>::BackgroundGrid(const GridParameters<dim> &parameters,
                                    const MPI_Comm             communicator)
    : parameters(parameters)
    , tria(communicator, dealii::Triangulation<dim>::limit_level_difference_at_vertices,
           dealii::parallel::distributed::Triangulation<dim>::default_setting)
{
  dealii::GridGenerator::subdivided_hyper_rectangle(tria, parameters.cells, parameters.lower,
                                                    parameters.upper, true);
  tria.refine_global(parameters.refinement == GridRefinement::uniform ? parameters.finest_level
                                                                      : parameters.coarsest_level);
  list_cells();
}

template <int dim>
void
BackgroundGrid<dim>::refine(const std::vector<Body<dim>>                             &bodies,
                            const std::vector<std::pair<unsigned int, unsigned int>> &pairs)
{
  if (parameters.wanted_levels)
    refine_by(*parameters.wanted_levels);
  else if (parameters.refinement == GridRefinement::contact)
    refine_by_contact(bodies, pairs);
  share(bodies);
  list_cells();
}

template <int dim>
void
BackgroundGrid<dim>::share(const std::vector<Body<dim>> &bodies)
{
  if (dealii::Utilities::MPI::n_mpi_processes(communicator()) == 1)
    return;
  constexpr unsigned int    weight_of_cell = 1000, weight_of_body = 10000, weight_of_cut = 10000;
  std::vector<unsigned int> weights(tria.n_active_cells(), weight_of_cell);
  CellBodies<dim>(bodies).visit(
    tria, [](const double size) { return 0.5 * std::sqrt(double(dim)) * size; },
    [&](const auto &cell, const std::vector<unsigned int> &near) {
      const double  half_diagonal = 0.5 * cell->diameter();
      unsigned int &weight        = weights[cell->active_cell_index()];
      for (const unsigned int b : near)
        {
          if (bodies[b].is_rigid())
            continue;
          const double distance = bodies[b].level_set.value(cell->center(), 1);
          weight += (distance < half_diagonal ? weight_of_body : 0)
                    + (std::abs(distance) < half_diagonal ? weight_of_cut : 0);
        }
    });
  const auto connection = tria.signals.weight.connect(
    [&](const auto &cell, const auto) { return weights[cell->active_cell_index()]; });
  tria.repartition();
  connection.disconnect();
}

template <int dim>
double
BackgroundGrid<dim>::refinement_distance(const double size) const
{
  const double h = finest_size(), excess = size - h - 1e-10 * h;
  return excess <= 0. ? 0.
                      : 0.5 * std::sqrt(double(dim)) * size + parameters.band * h
                          + excess / parameters.grading;
}

template <int dim>
double
BackgroundGrid<dim>::reach_of_refinement() const
{
  return parameters.refinement == GridRefinement::uniform
           ? 0.
           : 2. * refinement_distance(parameters.cell_size(parameters.coarsest_level));
}

template <int dim>
void
BackgroundGrid<dim>::refine_by_contact(
  const std::vector<Body<dim>>                             &bodies,
  const std::vector<std::pair<unsigned int, unsigned int>> &pairs)
{
  std::unique_ptr<Expression<dim>> limit;
  if (!parameters.cell_size_limit.empty())
    limit = std::make_unique<Expression<dim>>(parameters.cell_size_limit, 1, "Cell size limit");
  const std::set<std::pair<unsigned int, unsigned int>> may_touch(pairs.begin(), pairs.end());
  const CellBodies<dim>                                 cell_bodies(bodies);
  std::vector<unsigned int>                             nearest;
  for (unsigned int level = parameters.coarsest_level; level < parameters.finest_level; ++level)
    {
      if (limit)
        for (const auto &cell : tria.active_cell_iterators())
          if (cell->is_locally_owned() && cell->level() < int(parameters.finest_level)
              && parameters.cell_size(cell->level())
                   > (1. + 1e-10) * positive_value(*limit, cell->center()))
            cell->set_refine_flag();
      cell_bodies.visit(
        tria, [&](const double size) { return refinement_distance(size); },
        [&](const auto &cell, const auto &near) {
          if (cell->level() == int(parameters.finest_level) || cell->refine_flag_set())
            return;
          // The level sets are distances; the place of contact is as far as the farther body.
          const double distance = refinement_distance(parameters.cell_size(cell->level()));
          nearest.clear();
          for (const unsigned int b : near)
            if (bodies[b].level_set.value(cell->center(), 1) < distance)
              {
                for (const unsigned int a : nearest)
                  if (may_touch.count({a, b}))
                    {
                      cell->set_refine_flag();
                      return;
                    }
                nearest.push_back(b);
              }
        });
      tria.execute_coarsening_and_refinement();
    }
}

template <int dim>
void
BackgroundGrid<dim>::refine_by(const WantedLevels &wanted)
{
  const auto &leaves = wanted.cells;
  // Whether an older cell inside or around this one wants to be finer than it.
  const auto wants_more = [&](const std::uint64_t begin, const unsigned int level) {
    const std::uint64_t end  = begin + (std::uint64_t(1) << (dim * (wanted.finest_level - level)));
    auto                leaf = std::upper_bound(
                                 leaves.begin(), leaves.end(), begin,
                                 [](const std::uint64_t key, const auto &entry) { return key < entry.first; })
                - 1;
    for (; leaf != leaves.end() && leaf->first < end; ++leaf)
      if (leaf->second > level)
        return true;
    return false;
  };
  for (unsigned int level = wanted.coarsest_level; level < wanted.finest_level; ++level)
    {
      for (const auto &cell : tria.active_cell_iterators())
        if (cell->is_locally_owned() && cell->level() == int(level))
          {
            dealii::Point<dim> inner = cell->vertex(0);
            for (unsigned int d = 0; d < dim; ++d)
              inner[d] += 0.5 * finest_size();
            if (wants_more(key_of(inner), level))
              cell->set_refine_flag();
          }
      tria.execute_coarsening_and_refinement();
    }
}

template <int dim>
WantedLevels
BackgroundGrid<dim>::wanted_levels(const std::vector<unsigned int> &levels) const
{
  AssertDimension(levels.size(), n_owned);
  std::vector<std::pair<std::uint64_t, unsigned int>> owned;
  for (unsigned int c = 0; c < n_owned; ++c)
    owned.emplace_back(local_cells[c].key, levels[c]);
  WantedLevels result;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator(), owned))
    result.cells.insert(result.cells.end(), of_rank.begin(), of_rank.end());
  std::sort(result.cells.begin(), result.cells.end());
  result.coarsest_level = parameters.finest_level;
  for (const auto &[key, level] : result.cells)
    {
      result.finest_level   = std::max(result.finest_level, level);
      result.coarsest_level = std::min(result.coarsest_level, level);
    }
  // Keys count in cells of the finest level of either grid.
  for (auto &[key, level] : result.cells)
    key = result.finest_level >= parameters.finest_level
            ? key << (dim * (result.finest_level - parameters.finest_level))
            : key >> (dim * (parameters.finest_level - result.finest_level));
  return result;
}

template <int dim>
std::uint64_t
BackgroundGrid<dim>::key_of(const dealii::Point<dim> &point) const
{
  const double                   h = finest_size();
  std::array<std::uint32_t, dim> index;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double last = double(parameters.cells[d] << parameters.finest_level) - 1.;
      index[d]          = std::clamp(std::floor((point[d] - parameters.lower[d]) / h), 0., last);
    }
  return interleave<dim>(index);
}

template <int dim>
void
BackgroundGrid<dim>::list_cells()
{
  local_cells.clear();
  local_of_active.assign(tria.n_active_cells(), -1);
  for (const bool owned : {true, false})
    {
      for (const auto &cell : tria.active_cell_iterators())
        if (owned ? cell->is_locally_owned() : cell->is_ghost())
          {
            const double size = parameters.cell_size(cell->level());
            // Exact multiples of the finest size, whatever the round-off of the vertices.
            dealii::Point<dim> lower;
            const double       h = finest_size();
            for (unsigned int d = 0; d < dim; ++d)
              lower[d] = parameters.lower[d]
                         + std::round((cell->vertex(0)[d] - parameters.lower[d]) / h) * h;
            dealii::Point<dim> inner = lower;
            for (unsigned int d = 0; d < dim; ++d)
              inner[d] += 0.5 * h;
            local_of_active[cell->active_cell_index()] = local_cells.size();
            local_cells.push_back({lower, size, key_of(inner), cell});
          }
      if (owned)
        n_owned = local_cells.size();
    }

  std::vector<std::uint64_t> keys;
  for (unsigned int c = 0; c < n_owned; ++c)
    keys.push_back(local_cells[c].key);
  const auto all_keys = dealii::Utilities::MPI::all_gather(communicator(), keys);
  std::unordered_map<std::uint64_t, int> local_of_key;
  for (unsigned int c = 0; c < local_cells.size(); ++c)
    local_of_key[local_cells[c].key] = c;
  map.clear();
  for (unsigned int rank = 0; rank < all_keys.size(); ++rank)
    for (const std::uint64_t key : all_keys[rank])
      {
        const auto found = local_of_key.find(key);
        map.push_back({key, rank, found == local_of_key.end() ? -1 : found->second});
      }
  std::sort(map.begin(), map.end(),
            [](const MapEntry &a, const MapEntry &b) { return a.key < b.key; });
}

template <int dim>
typename BackgroundGrid<dim>::Location
BackgroundGrid<dim>::locate(const dealii::Point<dim> &point) const
{
  const std::uint64_t key = key_of(point);
  const auto          after
    = std::upper_bound(map.begin(), map.end(), key,
                       [](const std::uint64_t k, const MapEntry &e) { return k < e.key; });
  const MapEntry &entry = *(after - 1);
  return {entry.rank, entry.local_cell};
}

template struct GridParameters<2>;
template struct GridParameters<3>;
template class BackgroundGrid<2>;
template class BackgroundGrid<3>;
} // namespace scree
