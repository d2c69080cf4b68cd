#pragma once

#include <scree/mechanics/boundary_regions.h>

#include <vector>

// What Nitsche's method does not hold where the material flows.
namespace scree
{
/**
 * Takes the points out of cells that flow (plastic strain beyond the elastic) on the outer edge of
 * a region: the kink at its edge is not in a cell's polynomial, so that each cell is held as a
 * whole, and the region would be wider by half a cell on average (collective).
 */
template <int dim>
void release_edges(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                   const std::vector<Body<dim>> &bodies, const Kinematics<dim> &kinematics,
                   std::vector<BoundaryRegion<dim>> &regions);

/**
 * Leaves of the difference u_n - ubar_n at the start of the step the secant ratio, so that the
 * motion in the step is held. The difference is small beside the plastic strain times h, but beta
 * times it is not small beside the yield stress.
 */
template <int dim>
void forgive_flow(const Kinematics<dim> &kinematics, std::vector<BoundaryRegion<dim>> &regions);
} // namespace scree
