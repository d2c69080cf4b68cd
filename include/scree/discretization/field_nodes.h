#pragma once

#include <scree/discretization/lagrange.h>
#include <scree/grid/background_grid.h>

#include <deal.II/base/types.h>

#include <utility>
#include <vector>

namespace scree
{
/** Global number of an unknown. */
using DofIndex = dealii::types::global_dof_index;

/** A linear combination of nodes: sum_i weight_i u(node_i), node given by its first unknown. */
using NodeStencil = std::vector<std::pair<DofIndex, double>>;

/**
 * The unknowns of one field, which has one body at most in a cell, numbered by themselves: those of
 * a process are contiguous, process after process, the dim components of a node follow each other.
 * With the functions of a cell that is all a DisplacementSpace has to know of a basis.
 */
struct FieldNodes
{
  /** An unknown that others determine. */
  struct Constraint
  {
    DofIndex    unknown;
    NodeStencil masters; //!< unknowns with their weights
  };

  DofIndex                n_owned = 0; //!< unknowns of this process
  std::vector<DofIndex>   of_cells;    //!< first unknowns of the nodes of cell after cell
  std::vector<Constraint> constraints;
};

/**
 * The nodes of continuous Lagrange functions, hanging ones constrained (collective).
 *
 * @param is_active of each cell of the grid on this process, whether it carries unknowns; those do
 *                  that are in `of_cells`, in this order
 */
template <int dim>
FieldNodes lagrange_nodes(const BackgroundGrid<dim> &grid, const LagrangeBasis<dim> &basis,
                          const std::vector<bool> &is_active);
} // namespace scree
