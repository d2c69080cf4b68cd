#pragma once

#include <scree/base/exceptions.h>
#include <scree/mechanics/discrete_problem.h>

#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * Why a converged increment on a moving geometry is too large: material points move by more than
 * `largest_motion`, or closed contact slides by more than `largest_slip`, both in finest cells;
 * empty: it is not (collective). Points of free bodies that nothing presses in the end, as of
 * grains that were pushed out of the way, may move by three quarters of the reach of contact:
 * whatever they could meet there has contact points. Not of the unknowns: nodes of cut cells off
 * the body may run ahead where it is strained much.
 *
 * @param negligible_force sum of the contact pressures on a body that is none [force]
 */
template <int dim>
std::string why_too_large(const DiscreteProblem<dim> &problem, const MaterialPoints<dim> &before,
                          const MaterialPoints<dim> &after, const double negligible_force);

/**
 * That the points are inside the background box, unless they may leave it (collective).
 * @throws UserError naming a body that is not
 */
template <int dim>
void require_inside_box(const DiscreteProblem<dim> &problem, const MaterialPoints<dim> &points,
                        const double time);

/**
 * That no mass and no initial volume was lost when points were sent and divided: of each body,
 * before and after. Their number may grow. Both come from exact sums, see PointTotals.
 */
template <int dim>
void require_no_loss(const std::vector<Body<dim>>        &bodies,
                     const std::vector<PointTotals<dim>> &before,
                     const std::vector<PointTotals<dim>> &after, const unsigned int n_processes);

/**
 * On a fixed geometry, where contact carries nothing any more: what to tell if bodies slipped along
 * each other in this step, where they are nearest, by more than a cell per nominal step.
 *
 * @param step_fraction of the step, of a nominal one
 */
template <int dim>
std::optional<UserError> slide(const DiscreteProblem<dim> &problem,
                               const ContactHistory<dim> &history, const double time,
                               const double step_fraction);
} // namespace scree
