#pragma once

#include <scree/bodies/body.h>
#include <scree/discretization/point_evaluator.h>
#include <scree/points/material_points.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/**
 * The active cell in or nearest to each material point (collective); @throws TornBody if a point is
 * farther than a cell from all active cells of its body.
 */
template <int dim>
std::vector<PointInCell<dim>> locate_points(const DisplacementSpace<dim> &space,
                                            const std::vector<Body<dim>> &bodies,
                                            const MaterialPoints<dim>    &points);

/**
 * The displacement u = x - X of the bodies as a finite element field: the minimum of
 *
 *     sum_p V_p |u(x_p) - (x_p - X_p)|^2 + gamma h^2 s_h(u, u)
 *
 * over the nodes, s_h those of FaceJumps, which continue u to nodes of cut cells that have
 * no points; gamma = 1e-3 is small, so that a displacement of the space is its own fit but for
 * gamma times its jumps there. Since the reference positions X_p never change, no error of a
 * gradient adds up from step to step (reference map technique: Kamrin, Rycroft, Nave, J. Mech.
 * Phys. Solids 60, 2012, there with finite differences). Collective.
 *
 * @param bodies    whose BodyGeometry::displacement the search begins with
 * @param locations of the points, from locate_points()
 * @return owned unknowns [L]; zero for those that belong to no node
 */
template <int dim>
dealii::TrilinosWrappers::MPI::Vector
fit_displacement(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                 const MaterialPoints<dim> &points, const std::vector<PointInCell<dim>> &locations);
} // namespace scree
