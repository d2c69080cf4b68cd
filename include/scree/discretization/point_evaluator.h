#pragma once

#include <scree/discretization/displacement_space.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/** A point in unit coordinates of an active cell. */
template <int dim>
struct PointInCell
{
  unsigned int       active_cell;
  dealii::Point<dim> unit_point;
};

/**
 * The finite element displacement u = sum_a N_a u_a and its gradient at points of active cells. The
 * nodal values of a ghosted vector are gathered by cell once, into one array, so that no look-up of
 * an unknown is left to the points.
 */
template <int dim>
class PointEvaluator
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** u = 0. */
  explicit PointEvaluator(const DisplacementSpace<dim> &space);

  /** @param u ghosted, with the values of hanging nodes [L] */
  PointEvaluator(const DisplacementSpace<dim> &space, const Vector &u);

  /** Takes the values of another ghosted vector. */
  void gather(const Vector &u);

  /** Whether all values are the same to the last bit; false if some are NaN. */
  bool operator==(const PointEvaluator &other) const;

  /** u_a of the nodes of an active cell, component by component of node after node [L]. */
  const double *nodal_values(const unsigned int active_cell) const
  {
    return &values[std::size_t(active_cell) * space->basis.n_nodes * dim];
  }

  /** An unknown that belongs to no node, by its global number. */
  double trailing_value(const DofIndex index) const
  {
    return trailing[index - (space->n_dofs() - space->n_trailing())];
  }

  /** u [L]. */
  dealii::Tensor<1, dim> value(const PointInCell<dim> &point) const;

  /** grad u, entry (i, j) = du_i/dx_j [-]. */
  dealii::Tensor<2, dim> gradient(const PointInCell<dim> &point) const;

  struct ValueAndGradient
  {
    dealii::Tensor<1, dim> value;    //!< [L]
    dealii::Tensor<2, dim> gradient; //!< [-]
  };
  ValueAndGradient evaluate(const PointInCell<dim> &point) const;

  /** grad u with tabulated dN_a/dxi_j of the unit cell, direction by direction of node after node.
   */
  dealii::Tensor<2, dim> gradient(const unsigned int active_cell,
                                  const double      *unit_gradients) const
  {
    const double *nodal            = nodal_values(active_cell);
    double        result[dim][dim] = {};
    for (unsigned int a = 0; a < space->basis.n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] += nodal[a * dim + i] * unit_gradients[a * dim + j];
    return dealii::Tensor<2, dim>(result) / space->cell_size(active_cell);
  }

private:
  const DisplacementSpace<dim> *space;
  std::vector<double>           values;   //!< cell after cell
  std::vector<double>           trailing; //!< of the unknowns that belong to no node
};
} // namespace scree
