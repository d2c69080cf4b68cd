#pragma once

#include <scree/discretization/level_set_nodes.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <utility>
#include <vector>

namespace scree
{
/** Global number of an unknown. */
using DofIndex = dealii::types::global_dof_index;

/** A cell that carries unknowns of a body: owned ones first, then ghosts. */
struct ActiveCell
{
  unsigned int grid_cell; //!< index in BackgroundGrid::cells()
  unsigned int body;
  unsigned int field;
  bool         is_cut;
};

/** A linear combination of nodes: sum_i weight_i u(node_i), node given by its first unknown. */
using NodeStencil = std::vector<std::pair<DofIndex, double>>;

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
 * The unknowns. Bodies that are apart share a field: one hp DoFHandler (Q_k or nothing) per colour
 * of the conflict graph, where two bodies conflict if their active cells plus one layer of vertex
 * neighbours intersect. All fields form one numbering: the unknowns of a process are contiguous,
 * field after field; the dim components of a node are contiguous too, so that a node is named by
 * its first unknown; the components of rigid bodies come last, then multipliers: the trailing
 * unknowns, all on the last process (theory.md section 5).
 */
template <int dim>
class DisplacementSpace
{
public:
  /** @param n_multipliers unknowns appended for mean supports, owned by the last process */
  DisplacementSpace(const BackgroundGrid<dim> &grid, const LevelSetNodes<dim> &level_set_nodes,
                    const std::vector<Body<dim>> &bodies, const unsigned int n_multipliers);

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
    return dof_handlers.size();
  }

  unsigned int field_of_body(const unsigned int body) const
  {
    return colour[body];
  }

  const LagrangeBasis<dim>   basis;
  const BackgroundGrid<dim> &grid;

private:
  void classify(const LevelSetNodes<dim> &level_set_nodes, const std::vector<Body<dim>> &bodies);
  void colour_bodies(const unsigned int n_bodies);
  void distribute();
  void list_nodes();
  void collect_constraints();
  DofIndex    global_index(const unsigned int field, const DofIndex local) const;
  NodeStencil local_stencil(const unsigned int body, const dealii::Point<dim> &point) const;

  unsigned int              n_multipliers;
  unsigned int              n_rigid = 0;  //!< unknowns of rigid bodies
  std::vector<unsigned int> rigid_offset; //!< of each body among them, only for rigid bodies
  unsigned int              n_owned = 0;
  /** Bodies in each grid cell of this process, with whether it is cut. */
  std::vector<std::vector<std::pair<unsigned int, bool>>> bodies_of_cell;
  std::vector<unsigned int>                               colour; //!< field of each body
  std::vector<std::unique_ptr<dealii::DoFHandler<dim>>>   dof_handlers;
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
