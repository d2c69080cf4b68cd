#include <scree/base/exceptions.h>
#include <scree/contact/grid_node_contact.h>
#include <scree/contact/node_gap.h>
#include <scree/grid/cell_bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace scree
{
namespace
{
/** The number of a pair, and the place of a node in the lattice of the finest cells. */
template <int dim>
using PairAndNode = std::array<std::int64_t, dim + 1>;

/** What the cells around a node know of the bodies of a pair. */
template <int dim>
struct NodeOfPair
{
  double                                cell_size = std::numeric_limits<double>::max();
  std::array<bool, 2>                   is_reached{};
  std::array<dealii::Tensor<1, dim>, 2> gradient; //!< of the nodal volume [L^(dim-1)]

  void add(const NodeOfPair &other)
  {
    cell_size = std::min(cell_size, other.cell_size);
    for (const unsigned int side : {0, 1})
      {
        is_reached[side] = is_reached[side] || other.is_reached[side];
        gradient[side] += other.gradient[side];
      }
  }
};

template <int dim>
using NodesOfPairs = std::map<PairAndNode<dim>, NodeOfPair<dim>>;

/** Collects what the cells of this process know of nodes near which both bodies of a pair are. */
template <int dim>
class NodesInCells
{
public:
  NodesInCells(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
               const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
               const NodeNormal normal)
      : space(space)
      , level_set_nodes(level_set_nodes)
      , bodies(bodies)
      , normal(normal)
      , rules(level_set_nodes.rules())
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      numbers[{pairs[p].a, pairs[p].b}] = p;
  }

  NodesOfPairs<dim> collect();

private:
  /** What a cell has of a body. */
  struct BodyInCell
  {
    unsigned int    body;
    bool            is_here;
    CellPoints<dim> surface;
  };

  using Gradients = std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>>;

  BodyInCell in_cell(const unsigned int c, const unsigned int body);
  Gradients  gradients(const unsigned int c, const BodyInCell &here, const unsigned int other);
  void       add_nodes(const unsigned int c, const unsigned int pair, const BodyInCell &a,
                       const BodyInCell &b);

  const DisplacementSpace<dim>                                 &space;
  const LevelSetNodes<dim>                                     &level_set_nodes;
  const std::vector<Body<dim>>                                 &bodies;
  const NodeNormal                                              normal;
  CutCellRules<dim>                                             rules;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> numbers; //!< of the pairs
  NodesOfPairs<dim>                                             nodes;
};

template <int dim>
typename NodesInCells<dim>::BodyInCell
NodesInCells<dim>::in_cell(const unsigned int c, const unsigned int body)
{
  const CellCut<dim> cut = level_set_nodes.cut(c, bodies[body]);
  BodyInCell         result{body, cut.location != CellLocation::outside, {}};
  if (cut.location == CellLocation::cut)
    result.surface = rules.rules(cut, space.grid.cells()[c].size).surface;
  return result;
}

/** At the nodes int N_i n over the surface in a cell, or over what of it faces the other body. */
template <int dim>
typename NodesInCells<dim>::Gradients
NodesInCells<dim>::gradients(const unsigned int c, const BodyInCell &here, const unsigned int other)
{
  const GridCell<dim>                        &cell = space.grid.cells()[c];
  Gradients                                   result;
  std::array<double, max_nodes_per_cell<dim>> shape;
  for (unsigned int q = 0; q < here.surface.points.size(); ++q)
    {
      const dealii::Tensor<1, dim> &n      = here.surface.normals[q];
      double                        weight = here.surface.weights[q];
      if (normal == NodeNormal::facing_surfaces)
        {
          const dealii::Point<dim> x
            = cell.lower + cell.size * dealii::Tensor<1, dim>(here.surface.points[q]);
          weight *= std::max(0., -n * bodies[other].level_set.value_and_gradient(x, 1).second);
        }
      space.basis.evaluate_values(here.surface.points[q], shape.data());
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        result[i] += shape[i] * weight * n;
    }
  return result;
}

template <int dim>
void
NodesInCells<dim>::add_nodes(const unsigned int c, const unsigned int pair, const BodyInCell &a,
                             const BodyInCell &b)
{
  const GridCell<dim>     &cell   = space.grid.cells()[c];
  const dealii::Point<dim> origin = space.grid.box().get_boundary_points().first;
  const Gradients          of_a = gradients(c, a, b.body), of_b = gradients(c, b, a.body);
  for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
    {
      const dealii::Tensor<1, dim> arm
        = cell.lower + cell.size * dealii::Tensor<1, dim>(space.basis.node(i)) - origin;
      PairAndNode<dim> key;
      key[0] = pair;
      for (unsigned int d = 0; d < dim; ++d)
        key[1 + d] = std::llround(arm[d] / space.grid.finest_size());
      nodes[key].add({cell.size, {{a.is_here, b.is_here}}, {{of_a[i], of_b[i]}}});
    }
}

template <int dim>
NodesOfPairs<dim>
NodesInCells<dim>::collect()
{
  const auto reach = [](const double size) { return 2. * std::sqrt(double(dim)) * size; };
  CellBodies<dim>(bodies).visit(
    space.grid.triangulation(), reach,
    [&](const auto &iterator, const std::vector<unsigned int> &near) {
      const unsigned int      c    = space.grid.local_index(*iterator);
      const GridCell<dim>    &cell = space.grid.cells()[c];
      std::vector<BodyInCell> here;
      for (const unsigned int body : near)
        {
          if (bodies[body].level_set.value(cell.centre(), 1) > reach(cell.size))
            continue;
          here.push_back(in_cell(c, body));
          for (const BodyInCell &other : here)
            if (const auto pair = numbers.find({other.body, body});
                pair != numbers.end() && (other.is_here || here.back().is_here))
              add_nodes(c, pair->second, other, here.back());
        }
    });
  return std::move(nodes);
}

/** The nodes of all processes, on all of them (collective). */
template <int dim>
NodesOfPairs<dim>
gathered(const NodesOfPairs<dim> &own, const MPI_Comm communicator)
{
  std::vector<std::vector<double>> rows;
  for (const auto &[key, node] : own)
    {
      rows.emplace_back(key.begin(), key.end());
      rows.back().push_back(node.cell_size);
      for (const unsigned int side : {0, 1})
        {
          rows.back().push_back(node.is_reached[side]);
          rows.back().insert(rows.back().end(), node.gradient[side].begin_raw(),
                             node.gradient[side].end_raw());
        }
    }
  NodesOfPairs<dim> result;
  for (const auto &of_process : dealii::Utilities::MPI::all_gather(communicator, rows))
    for (const auto &row : of_process)
      {
        const double    *next = row.data();
        PairAndNode<dim> key;
        for (auto &entry : key)
          entry = static_cast<std::int64_t>(*next++);
        NodeOfPair<dim> node;
        node.cell_size = *next++;
        for (const unsigned int side : {0, 1})
          {
            node.is_reached[side] = *next++ != 0.;
            std::copy_n(next, dim, node.gradient[side].begin_raw());
            next += dim;
          }
        result[key].add(node);
      }
  return result;
}

/** The densities with which the gradients of nodal volume make normals. */
template <int dim>
std::array<double, 2>
factors_of_normals(const ContactPair &pair, const std::vector<Body<dim>> &bodies,
                   const NodeNormal normal)
{
  if (normal != NodeNormal::mass_gradient)
    return {{1., 1.}};
  for (const unsigned int b : {pair.a, pair.b})
    require(bodies[b].density > 0., "Contact/Grid nodes/Normal",
            "the body '" + bodies[b].name + "' has no mass, whose gradient is asked for",
            "set Density in the section of its material, or Normal = facing surfaces");
  return {{bodies[pair.a].density, bodies[pair.b].density}};
}

/** The normal of a node [-, times a power of L and M]. */
template <int dim>
dealii::Tensor<1, dim>
normal_of(const NodeOfPair<dim> &node, std::array<double, 2> factors, const NodeNormal normal)
{
  // At the end of a body the surface of the other one goes on, and has the right normal.
  if (normal == NodeNormal::facing_surfaces)
    factors = {{node.gradient[0].norm_square(), node.gradient[1].norm_square()}};
  return factors[0] * node.gradient[0] - factors[1] * node.gradient[1];
}

/** The contact points of this process. */
template <int dim>
std::vector<ContactPoint<dim>>
contact_nodes(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
              const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
              const NodeNormal normal_of_nodes, const IncrementPrediction<dim> &prediction)
{
  constexpr double           negligible = 1e-8;
  const BackgroundGrid<dim> &grid       = space.grid;
  const unsigned int         rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
  std::vector<std::array<double, 2>> factors;
  factors.reserve(pairs.size());
  for (const ContactPair &pair : pairs)
    factors.push_back(factors_of_normals(pair, bodies, normal_of_nodes));
  const NodeGaps<dim>            gaps(bodies, prediction);
  std::vector<ContactPoint<dim>> points;
  for (const auto &[key, node] : gathered<dim>(
         NodesInCells<dim>(space, level_set_nodes, bodies, pairs, normal_of_nodes).collect(),
         grid.communicator()))
    {
      const unsigned int number = key[0];
      const auto         normal = normal_of(node, factors[number], normal_of_nodes);
      const double       area   = 0.5 * (node.gradient[0] - node.gradient[1]).norm();
      const bool         is_seen
        = area > negligible * std::pow(node.cell_size, dim - 1) && normal.norm() > 0.;
      if (!node.is_reached[0] || !node.is_reached[1] || !is_seen)
        continue;
      dealii::Point<dim> x = grid.box().get_boundary_points().first;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += key[1 + d] * grid.finest_size();
      if (grid.locate(x).rank != rank)
        continue;
      const auto   n   = normal / normal.norm();
      const double gap = gaps.at_start(pairs[number], x, n, node.cell_size);
      points.push_back({number, x, n, area, gap, node.cell_size, n, gap});
      points.back().is_node = true;
      points.back().feet    = {{x, x}};
      gaps.expect_motion(pairs[number], points.back());
    }
  return points;
}
} // namespace

template <int dim>
ContactDiscretisation<dim>
grid_node_contact(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                  const GridNodeParameters &parameters, const IncrementPrediction<dim> &prediction,
                  const dealii::TrilinosWrappers::MPI::Vector *start_displacement,
                  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios, StartGaps *start_gaps)
{
  AssertDimension(space.basis.degree, 1);
  InitialGaps<dim> initial_gaps(bodies, pairs, GridNodeParameters::reach(space.grid.finest_size()),
                                level_set_nodes.basis().degree);
  auto             points = contact_nodes(space, level_set_nodes, bodies, pairs, parameters.normal,
                              parameters.has_gaps ? prediction : IncrementPrediction<dim>());
  auto result = discretise_contact(space, bodies, pairs, std::move(points), initial_gaps,
                                   start_displacement, secant_ratios, start_gaps);
  if (!parameters.has_gaps)
    for (ContactPoint<dim> &point : result.points)
      point.initial_gap = 0.;
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template ContactDiscretisation<dim> grid_node_contact(                                        \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &, \
    const std::vector<ContactPair> &, const GridNodeParameters &,                               \
    const IncrementPrediction<dim> &, const dealii::TrilinosWrappers::MPI::Vector *,            \
    const dealii::TrilinosWrappers::MPI::Vector *, StartGaps *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
