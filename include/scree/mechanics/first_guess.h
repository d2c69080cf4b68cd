#pragma once

#include <scree/mechanics/discrete_problem.h>

#include <functional>

namespace scree
{
/**
 * The displacement at `time` if bodies go on as in the last step: on a fixed geometry u_n plus the
 * last increment, on a moving one the extended increment of the last step where it has carried the
 * material, both scaled to the step; rigid bodies likewise.
 */
template <int dim>
typename Equilibrium<dim>::Vector extrapolated(const DiscreteProblem<dim> &problem,
                                               const State<dim> &state, const double time);

/**
 * First guess of the step to `time`: of the old displacement, the extrapolated() one and, with
 * rigid bodies, the linear_prediction(), that with the smallest residual. Sets the time of the
 * equilibrium.
 *
 * @param solve solves K x = b at the u of the last residual; may throw LinearSolverFailure
 */
template <int dim>
typename Equilibrium<dim>::Vector
first_guess(const DiscreteProblem<dim> &problem, const State<dim> &state, const double time,
            const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                     typename Equilibrium<dim>::Vector       &x)> &solve);
} // namespace scree
