#include <scree/base/log.h>
#include <scree/discretization/face_jumps.h>
#include <scree/discretization/own_nodes.h>
#include <scree/mechanics/reference_map.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <numeric>

namespace scree
{
namespace
{
using Vector = dealii::TrilinosWrappers::MPI::Vector;

/** The weight of the jumps against the distances of the points. */
constexpr double jump_weight = 1e-3;

/**
 * The nodes numbered one by one: node i is that of the unknowns dim i ... dim i + dim - 1, for the
 * components of a node are contiguous and other unknowns come last.
 */
template <int dim>
class NodeNumbering
{
public:
  explicit NodeNumbering(const DisplacementSpace<dim> &space)
      : space(space)
      , owned(nodes_of(space.owned()))
      , relevant(nodes_of(space.relevant()))
      , constraints(relevant)
  {
    for (const auto &line : space.hanging_constraints().get_lines())
      if (line.index % dim == 0)
        {
          constraints.add_line(line.index / dim);
          for (const auto &[master, weight] : line.entries)
            constraints.add_entry(line.index / dim, master / dim, weight);
        }
    constraints.close();
  }

  std::vector<DofIndex> of_cell(const unsigned int active_cell) const
  {
    const DofIndex       *nodes = space.nodes(active_cell);
    std::vector<DofIndex> result(nodes, nodes + space.basis.n_nodes);
    for (DofIndex &node : result)
      node /= dim;
    return result;
  }

  const DisplacementSpace<dim>     &space;
  dealii::IndexSet                  owned, relevant;
  dealii::AffineConstraints<double> constraints;

private:
  dealii::IndexSet nodes_of(const dealii::IndexSet &unknowns) const
  {
    const DofIndex   n_nodes = (space.n_dofs() - space.n_trailing()) / dim;
    dealii::IndexSet result(n_nodes);
    for (auto interval = unknowns.begin_intervals(); interval != unknowns.end_intervals();
         ++interval)
      result.add_range(std::min(*interval->begin() / dim, n_nodes),
                       std::min((interval->last() + 1) / dim, n_nodes));
    result.compress();
    return result;
  }
};

/** The matrix of the fit and its right-hand sides, one per component. */
template <int dim>
class Fit
{
public:
  Fit(const NodeNumbering<dim> &nodes, const MaterialPoints<dim> &points,
      const std::vector<PointInCell<dim>> &locations)
      : nodes(nodes)
      , communicator(nodes.space.grid.communicator())
      , jumps(nodes.space)
  {
    set_up_matrix();
    add_points(points, locations);
    add_jumps();
    matrix.compress(dealii::VectorOperation::add);
    for (Vector &load : loads)
      load.compress(dealii::VectorOperation::add);
    // Nodes of no point and no jump, as of hanging nodes.
    for (const DofIndex node : nodes.owned)
      if (matrix.diag_element(node) == 0.)
        matrix.set(node, node, 1.);
    matrix.compress(dealii::VectorOperation::insert);
  }

  void solve(const std::vector<Body<dim>> &bodies, Vector &displacement) const
  {
    dealii::TrilinosWrappers::PreconditionSSOR preconditioner;
    preconditioner.initialize(matrix);
    std::array<Vector, dim> guess = first_guess(bodies);
    for (unsigned int d = 0; d < dim; ++d)
      {
        Vector                  &values = guess[d];
        const double             norm   = loads[d].l2_norm();
        dealii::SolverControl    control(1000, 1e-14 * norm, false, false);
        dealii::SolverCG<Vector> solver(control);
        if (norm == 0.)
          values = 0.;
        else
          try
            {
              solver.solve(matrix, values, loads[d], preconditioner);
            }
          catch (const dealii::SolverControl::NoConvergence &failure)
            {
              // Round-off may end the iteration just above the tolerance.
              AssertThrow(failure.last_residual < 1e-10 * norm,
                          dealii::ExcMessage("the fit of the displacement did not converge"));
            }
        for (const DofIndex node : nodes.owned)
          displacement(node * dim + d) = values(node);
      }
    displacement.compress(dealii::VectorOperation::insert);
  }

private:
  /** What the lattices of the bodies hold of the displacement: right to their interpolation. */
  std::array<Vector, dim> first_guess(const std::vector<Body<dim>> &bodies) const
  {
    std::array<Vector, dim> result;
    for (Vector &values : result)
      values.reinit(nodes.owned, communicator);
    const DisplacementSpace<dim> &space = nodes.space;
    for_each_own_node(space, [&](const unsigned int a, const unsigned int i, const DofIndex node) {
      const auto &moved_by = bodies[space.cells()[a].body].displacement;
      if (moved_by.is_empty())
        return;
      const auto u = moved_by(space.position(a, space.basis.node(i)));
      for (unsigned int d = 0; d < dim; ++d)
        result[d](node / dim) = u[d];
    });
    for (Vector &values : result)
      values.compress(dealii::VectorOperation::insert);
    return result;
  }

  void set_up_matrix()
  {
    dealii::DynamicSparsityPattern pattern(nodes.owned.size(), nodes.owned.size(), nodes.relevant);
    for (unsigned int a = 0; a < nodes.space.n_owned_cells(); ++a)
      nodes.constraints.add_entries_local_to_global(nodes.of_cell(a), pattern, true);
    for (const GhostFace &face : jumps.faces())
      nodes.constraints.add_entries_local_to_global(numbers(jumps.block(face).nodes), pattern,
                                                    true);
    for (const DofIndex node : nodes.owned)
      pattern.add(node, node);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, nodes.owned, communicator,
                                                       nodes.relevant);
    matrix.reinit(nodes.owned, nodes.owned, pattern, communicator, true);
    for (Vector &load : loads)
      load.reinit(nodes.owned, communicator);
  }

  static std::vector<DofIndex> numbers(std::vector<DofIndex> first_unknowns)
  {
    for (DofIndex &node : first_unknowns)
      node /= dim;
    return first_unknowns;
  }

  void add_points(const MaterialPoints<dim> &points, const std::vector<PointInCell<dim>> &locations)
  {
    // The points in the order of their cells: one block of the matrix per cell.
    std::vector<unsigned int> order(locations.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](const unsigned int i, const unsigned int j) {
      return locations[i].active_cell < locations[j].active_cell;
    });
    const unsigned int                          n = nodes.space.basis.n_nodes;
    std::array<double, max_nodes_per_cell<dim>> shape;
    dealii::FullMatrix<double>                  block(n, n);
    std::array<dealii::Vector<double>, dim>     sides;
    for (auto &side : sides)
      side.reinit(n);
    for (std::size_t i = 0; i < order.size();)
      {
        const unsigned int cell = locations[order[i]].active_cell;
        block                   = 0.;
        for (auto &side : sides)
          side = 0.;
        for (; i < order.size() && locations[order[i]].active_cell == cell; ++i)
          {
            const unsigned int p = order[i];
            nodes.space.basis.evaluate_values(locations[p].unit_point, shape.data());
            const double                 volume = points.volume(p);
            const dealii::Tensor<1, dim> u      = points.position[p] - points.reference_position[p];
            for (unsigned int a = 0; a < n; ++a)
              {
                for (unsigned int b = 0; b < n; ++b)
                  block(a, b) += volume * shape[a] * shape[b];
                for (unsigned int d = 0; d < dim; ++d)
                  sides[d](a) += volume * shape[a] * u[d];
              }
          }
        const auto indices = nodes.of_cell(cell);
        nodes.constraints.distribute_local_to_global(block, indices, matrix);
        for (unsigned int d = 0; d < dim; ++d)
          nodes.constraints.distribute_local_to_global(sides[d], indices, loads[d]);
      }
  }

  void add_jumps()
  {
    for (const GhostFace &face : jumps.faces())
      {
        const double size  = nodes.space.cell_size(face.cell);
        auto         block = jumps.block(face);
        block.matrix *= jump_weight * size * size;
        nodes.constraints.distribute_local_to_global(block.matrix, numbers(block.nodes), matrix);
      }
  }

  const NodeNumbering<dim>              &nodes;
  MPI_Comm                               communicator;
  FaceJumps<dim>                         jumps;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  std::array<Vector, dim>                loads;
};
} // namespace

template <int dim>
std::vector<PointInCell<dim>>
locate_points(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
              const MaterialPoints<dim> &points)
{
  std::vector<PointInCell<dim>> result;
  result.reserve(points.size());
  std::vector<double> lost(bodies.size(), 0.);
  for (std::size_t p = 0; p < points.size(); ++p)
    {
      const int cell = space.nearest_active_cell(points.position[p], points.body[p]);
      if (cell < 0)
        lost[points.body[p]] += 1.;
      else
        result.push_back(
          {static_cast<unsigned int>(cell), space.unit_point(cell, points.position[p])});
    }
  dealii::Utilities::MPI::sum(lost, space.grid.communicator(), lost);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (lost[b] > 0.)
      throw TornBody(bodies[b].path,
                     std::to_string(std::lround(lost[b])) + " material points of the body '"
                       + bodies[b].name
                       + "' are farther than a cell from it: it is torn, or thinner than a cell",
                     "raise Grid/Finest level, so that its thinnest part is three cells wide, or "
                     "use more steps");
  return result;
}

template <int dim>
dealii::TrilinosWrappers::MPI::Vector
fit_displacement(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                 const MaterialPoints<dim> &points, const std::vector<PointInCell<dim>> &locations)
{
  Vector displacement(space.owned(), space.grid.communicator());
  if (space.n_dofs() == space.n_trailing()) // all bodies are rigid
    return displacement;
  const NodeNumbering<dim> nodes(space);
  Fit<dim>(nodes, points, locations).solve(bodies, displacement);
  return displacement;
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template std::vector<PointInCell<dim>> locate_points(                                           \
    const DisplacementSpace<dim> &, const std::vector<Body<dim>> &, const MaterialPoints<dim> &); \
  template dealii::TrilinosWrappers::MPI::Vector fit_displacement(                                \
    const DisplacementSpace<dim> &, const std::vector<Body<dim>> &, const MaterialPoints<dim> &,  \
    const std::vector<PointInCell<dim>> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
