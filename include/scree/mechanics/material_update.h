#pragma once

#include <scree/mechanics/incremental_bulk.h>
#include <scree/mechanics/step_start.h>

#include <vector>

namespace scree
{
/**
 * The material points of the bodies at the start of a run, on the processes of their cells.
 */
template <int dim>
MaterialPoints<dim>
seed_points(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
            const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
            const MovingGeometryParameters &parameters);

/**
 * Sends points to the processes of their cells and divides those that are wide for them: of cells
 * finer than they were made for (collective). @throws TornBody
 */
template <int dim>
void distribute_points(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                       const MovingGeometryParameters &parameters, MaterialPoints<dim> &points);

/**
 * The material points after an increment u, with the laws' answers to F_D = I + grad u, projected
 * as those of `bulk`: x <- x + u, F <- F_D F, stresses and internal variables.
 *
 * @param points    those at the start of the step
 * @param places    where they are in their cells
 * @param histories of the points at the start, as their laws see them
 * @param laws_see_gradients whether laws see the F of the points, which then take the volume change
 *                  that their law saw; else they take that of u, which is right where they are
 */
template <int dim>
MaterialPoints<dim>
moved_points(const MaterialPoints<dim> &points, const std::vector<PointInCell<dim>> &places,
             const std::vector<PointHistory<dim>> &histories, const std::vector<Body<dim>> &bodies,
             const IncrementalBulk<dim> &bulk, const PointEvaluator<dim> &u,
             const bool laws_see_gradients);
} // namespace scree
