#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/mechanics/kinematics.h>

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
  // What the point was at the start of the run and did since then.
  dealii::Point<dim>     reference_position; //!< where formulas are evaluated
  dealii::Tensor<1, dim> start_displacement; //!< u_n [L]; what flows: forgive_flow()
  double                 area_ratio = 1.;    //!< of reference area to area at the start of the step

  PointInCell<dim> in_cell() const
  {
    return {active_cell, unit_point};
  }
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
  double                          polar_moment;     //!< int x^2 + y^2 about the centre, likewise
  unsigned int                    first_multiplier; //!< of a mean support
  bool                            follows_surface;  //!< see Kinematics
};

/** Whether Nitsche's method prescribes the displacement of a region. */
template <int dim>
bool
is_nitsche(const BoundaryRegion<dim> &region)
{
  return region.condition->prescribes_displacement()
         && region.condition->parameters.method != DisplacementMethod::penalty;
}

/** Squared distance of a point from the axis of the mean rotation: z through the centre. */
template <int dim>
double squared_arm(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point);

/**
 * The regions of all conditions that are integrals, on this process: points on the cut surface, or
 * of {phi < 0} on a face of the box. The formulas of the regions see the reference positions of the
 * kinematics, so that regions move with their bodies. Mean supports number their multipliers in
 * this order.
 *
 * @throws UserError if a region selects nothing
 */
template <int dim>
std::vector<BoundaryRegion<dim>> find_boundary_regions(const DisplacementSpace<dim> &space,
                                                       const LevelSetNodes<dim> &level_set_nodes,
                                                       const CutQuadrature<dim> &quadrature,
                                                       const std::vector<Body<dim>> &bodies,
                                                       const Kinematics<dim>        &kinematics);
} // namespace scree
