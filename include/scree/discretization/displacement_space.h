#pragma once

#include <scree/discretization/field_nodes.h>
#include <scree/discretization/level_set_nodes.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

#include <utility>
#include <vector>

namespace scree
{
/** A cell that carries unknowns of a body: owned ones first, then ghosts. */
struct ActiveCell
{
  unsigned int grid_cell; //!< index in BackgroundGrid::cells()
  unsigned int body;
  unsigned int field;
  bool         is_cut;
};

/** Sets the unknowns of a list of nodes, component by component. */
template <int dim>
void
set_unknowns_of_nodes(const DofIndex *nodes, const unsigned int n_nodes,
                      std::vector<DofIndex> &indices)
{
  indices.resize(n_nodes * dim);
  for (unsigned int i = 0; i < n_nodes; ++i)
    for (unsigned int d = 0; d < dim; ++d)
      indices[i * dim + d] = nodes[i] + d;
}

template <int dim>
std::vector<DofIndex>
unknowns_of_nodes(const DofIndex *nodes, const unsigned int n_nodes)
{
  std::vector<DofIndex> indices;
  set_unknowns_of_nodes<dim>(nodes, n_nodes, indices);
  return indices;
}

/**
 * The space of displacements and its unknowns. Bodies that are apart share a field: one set of
 * nodes per colour of the conflict graph, where two bodies conflict if their active cells plus one
 * layer of vertex neighbours intersect. All fields form one numbering: the unknowns of a process
 * are contiguous, field after field; the dim components of a node are contiguous too, so that a
 * node is named by its first unknown; the components of rigid bodies come last, then multipliers:
 * the trailing unknowns, all on the last process (theory.md section 5).
 *
 * What the rest of the program asks of the basis are functions on the unit cell, the same in all
 * cells, in terms of its nodes: n_nodes, node(i), at which a linear function has its i-th
 * coefficient, evaluate_values(), evaluate_gradients(), evaluate(). It is a member, not an
 * interface, so that kernels are compiled for it. Another basis, B-splines on uniform cells, has
 * these functions and one that makes its FieldNodes, as lagrange_nodes() does; nothing else here or
 * in other modules depends on which one it is.
 */
template <int dim>
class DisplacementSpace
{
public:
  using Basis = LagrangeBasis<dim>;

  /**
   * @param degree          of the basis
   * @param level_set_nodes which tell where the bodies are
   * @param n_multipliers   unknowns appended for mean supports, owned by the last process
   */
  DisplacementSpace(const BackgroundGrid<dim> &grid, const unsigned int degree,
                    const LevelSetNodes<dim> &level_set_nodes, const std::vector<Body<dim>> &bodies,
                    const unsigned int n_multipliers);

  const std::vector<ActiveCell> &cells() const
  {
    return active_cells;
  }

  unsigned int n_owned_cells() const
  {
    return n_owned;
  }

  /** First unknowns of the nodes of an active cell, lexicographic. */
  const DofIndex *nodes(const unsigned int active_cell) const
  {
    return &cell_nodes[std::size_t(active_cell) * basis.n_nodes];
  }

  /** The active cell of `body` in a grid cell of this process, -1 if there is none. */
  int active_cell(const unsigned int grid_cell, const unsigned int body) const;

  /** The active cell of `body` in or nearest to the cell that contains `point`, -1 if there is
   * none. */
  int nearest_active_cell(const dealii::Point<dim> &point, const unsigned int body) const;

  /** Edge of an active cell [L]. */
  double cell_size(const unsigned int active_cell) const
  {
    return grid.cells()[active_cells[active_cell].grid_cell].size;
  }

  /** Where a point in unit coordinates of an active cell is. */
  dealii::Point<dim> position(const unsigned int        active_cell,
                              const dealii::Point<dim> &unit_point) const
  {
    const GridCell<dim> &cell = grid.cells()[active_cells[active_cell].grid_cell];
    return cell.lower + cell.size * dealii::Tensor<1, dim>(unit_point);
  }

  /** Values of the basis functions of an active cell and their gradients in space [1/L]. */
  void evaluate_basis(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                      ShapeValues<dim> &shape) const;

  /** Of the polynomials to which volume changes are projected, against locking: k - 1. */
  unsigned int volume_degree() const
  {
    return basis.degree - 1;
  }

  /** How the constant c of int_F h |grad v|^2 <= c int |grad v|^2 grows with the degree: k^2. */
  double trace_factor() const
  {
    return double(basis.degree) * basis.degree;
  }

  /** Unit coordinates of a point in an active cell. */
  dealii::Point<dim> unit_point(const unsigned int        active_cell,
                                const dealii::Point<dim> &point) const;

  /**
   * Evaluation of the displacement of body `bodies[i]` at `points[i]`, with hanging nodes resolved,
   * in the nearest active cell of that body; empty where the body has none next to the point.
   * Points may lie on any process (collective call).
   */
  std::vector<NodeStencil> stencils(const std::vector<unsigned int>       &bodies,
                                    const std::vector<dealii::Point<dim>> &points) const;

  /** Hanging nodes of all fields, in the global numbering. */
  const dealii::AffineConstraints<double> &hanging_constraints() const
  {
    return constraints;
  }

  const dealii::IndexSet &owned() const
  {
    return owned_dofs;
  }

  const dealii::IndexSet &relevant() const
  {
    return relevant_dofs;
  }

  DofIndex n_dofs() const
  {
    return owned_dofs.size();
  }

  unsigned int n_bodies() const
  {
    return colour.size();
  }

  /** Unknowns that belong to no node: components of rigid bodies, then multipliers. */
  unsigned int n_trailing() const
  {
    return n_rigid + n_multipliers;
  }

  /** Global number of the first of the n_rigid_components of a rigid body. */
  DofIndex rigid_unknown(const unsigned int body) const
  {
    return n_dofs() - n_trailing() + rigid_offset[body];
  }

  /** Global number of multiplier `i`. */
  DofIndex multiplier(const unsigned int i) const
  {
    return n_dofs() - n_multipliers + i;
  }

  unsigned int n_fields() const
  {
    return active_of_grid_cell.size();
  }

  unsigned int field_of_body(const unsigned int body) const
  {
    return colour[body];
  }

  const Basis                basis;
  const BackgroundGrid<dim> &grid;

private:
  void classify(const LevelSetNodes<dim> &level_set_nodes, const std::vector<Body<dim>> &bodies);
  void colour_bodies(const unsigned int n_bodies);
  /** Joins the numberings of the fields to one. */
  void        number(const std::vector<FieldNodes> &of_fields);
  void        list_nodes(const std::vector<FieldNodes> &of_fields);
  void        collect_constraints(const std::vector<FieldNodes> &of_fields);
  DofIndex    global_index(const unsigned int field, const DofIndex local) const;
  NodeStencil local_stencil(const unsigned int body, const dealii::Point<dim> &point) const;

  unsigned int              n_multipliers;
  unsigned int              n_rigid = 0;  //!< unknowns of rigid bodies
  std::vector<unsigned int> rigid_offset; //!< of each body among them, only for rigid bodies
  unsigned int              n_owned = 0;
  /** Bodies in each grid cell of this process, with whether it is cut. */
  std::vector<std::vector<std::pair<unsigned int, bool>>> bodies_of_cell;
  std::vector<unsigned int>                               colour; //!< field of each body
  std::vector<ActiveCell>                                 active_cells;
  std::vector<std::vector<int>>      active_of_grid_cell; //!< [field][grid cell], -1: none
  std::vector<DofIndex>              cell_nodes;
  std::vector<std::vector<DofIndex>> field_start;  //!< [field][process], first unknown in the field
  std::vector<std::vector<DofIndex>> global_start; //!< [field][process], its global number
  dealii::IndexSet                   owned_dofs, relevant_dofs;
  dealii::AffineConstraints<double>  constraints;
};

/** The unknowns of a rigid body in a ghosted vector. */
template <int dim, typename Vector>
typename RigidPose<dim>::Unknowns
rigid_unknowns(const DisplacementSpace<dim> &space, const unsigned int body, const Vector &u)
{
  typename RigidPose<dim>::Unknowns q;
  for (unsigned int m = 0; m < q.size(); ++m)
    q[m] = u(space.rigid_unknown(body) + m);
  return q;
}
} // namespace scree
