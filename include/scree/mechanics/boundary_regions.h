#pragma once

#include <scree/discretization/cut_quadrature.h>

#include <vector>

namespace scree
{
/** A quadrature point where a boundary condition acts. */
template <int dim>
struct BoundaryPoint
{
  unsigned int           active_cell;
  dealii::Point<dim>     unit_point;
  dealii::Point<dim>     position;
  dealii::Tensor<1, dim> normal; //!< out of the body
  double                 weight; //!< length or area
};

/** One boundary condition of one body, with the points of its region on this process. */
template <int dim>
struct BoundaryRegion
{
  unsigned int                    body;
  const BoundaryCondition<dim>   *condition;
  std::vector<BoundaryPoint<dim>> points;
  double                          area;             //!< over all processes
  dealii::Point<dim>              centre;           //!< of the region, over all processes
  unsigned int                    first_multiplier; //!< of a mean support
};

/**
 * The regions of all conditions that are integrals, on this process: points on the cut surface, or
 * of {phi < 0} on a face of the box. Mean supports number their multipliers in this order.
 *
 * @throws UserError if a region selects nothing
 */
template <int dim>
std::vector<BoundaryRegion<dim>>
find_boundary_regions(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                      const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies);
} // namespace scree
