#pragma once

#include <scree/mechanics/discrete_problem.h>

namespace scree
{
/**
 * After a step to `time` that was not solved: that contact can balance the loads on free bodies,
 * see FreeBodies::unbalanced(), with the geometry and the contact of the start of the step.
 * Collective; the equilibrium has another time afterwards.
 *
 * @throws UserError if it cannot, with the motion that the loads drive and the time, found by
 * bisection, up to which they could be balanced
 */
template <int dim>
void require_equilibrium_exists(const DiscreteProblem<dim> &problem, const State<dim> &state,
                                const double time);
} // namespace scree
