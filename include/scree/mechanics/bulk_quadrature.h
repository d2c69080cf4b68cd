#pragma once

#include <scree/discretization/point_evaluator.h>
#include <scree/mechanics/cell_rule.h>
#include <scree/points/material_points.h>

#include <vector>

namespace scree
{
template <int dim>
class IncrementalBulk;

/**
 * The points at which the laws of a step in increments are asked: where they are in the cells, with
 * which histories they start, and where the histories go at the end. Derived classes say so; the
 * tables of what the laws need are the same for all.
 */
template <int dim>
class BulkQuadrature
{
public:
  BulkQuadrature(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies);
  virtual ~BulkQuadrature() = default;

  /** Of an owned active cell, all of one configuration: that of the start of the step. */
  virtual CellRule<dim> rule(const unsigned int active_cell) const = 0;

  /**
   * The histories at the start, anywhere in deformable bodies.
   *
   * @throws UserError where det F_n is not positive
   */
  virtual std::vector<PointHistory<dim>>
  histories(const std::vector<PointInCell<dim>> &points) const = 0;

  /** The material points after the increment u, with what the laws of `bulk` answer to it. */
  virtual MaterialPoints<dim> moved(const MaterialPoints<dim>  &points,
                                    const IncrementalBulk<dim> &bulk,
                                    const PointEvaluator<dim>  &u) const = 0;

  std::size_t n_points() const
  {
    return all_starts.size();
  }

  /** Number of the first point of an owned cell; points are numbered cell after cell. */
  std::size_t first_point(const unsigned int active_cell) const
  {
    return first_points[active_cell];
  }

  /** Of the points of an owned cell. */
  const IncrementStart *starts(const unsigned int active_cell) const
  {
    return all_starts.data() + first_points[active_cell];
  }

  /** J_n of the points of an owned cell. */
  const double *volume_ratios(const unsigned int active_cell) const
  {
    return all_volume_ratios.data() + first_points[active_cell];
  }

  /** Gradients of the basis in unit coordinates at the points of an owned cell, node by node. */
  const double *unit_gradients(const unsigned int active_cell) const
  {
    return all_gradients.data() + first_gradients[active_cell];
  }

  /** F_D with unit gradients of the basis at a point of a cell. */
  static dealii::Tensor<2, dim> increment(const PointEvaluator<dim> &u,
                                          const unsigned int active_cell, const double *gradients)
  {
    return u.gradient(active_cell, gradients)
           + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  }

protected:
  /** The histories at the points of the rules, cell after cell; histories() unless overridden. */
  virtual std::vector<PointHistory<dim>>
  histories_of_rules(const std::vector<PointInCell<dim>> &points) const;

  /** Sets up the tables, for constructors (collective). */
  void tabulate();

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;

private:
  std::vector<std::size_t>    first_points;
  std::vector<IncrementStart> all_starts;
  std::vector<double>         all_volume_ratios;
  std::vector<std::size_t>    first_gradients; //!< cells with the same rule share them
  std::vector<double>         all_gradients;
};
} // namespace scree
