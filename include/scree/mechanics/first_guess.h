#pragma once

#include <scree/mechanics/discrete_problem.h>
#include <scree/mechanics/time_scheme.h>

#include <functional>

namespace scree
{
/**
 * First guess of the step to `time`: of the old displacement, TimeScheme::predicted() and, with
 * rigid bodies, the linear_prediction(), that with the smallest residual. Sets the time of the
 * equilibrium.
 *
 * @param solve solves K x = b at the u of the last residual; may throw LinearSolverFailure
 */
template <int dim>
typename Equilibrium<dim>::Vector
first_guess(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
            const State<dim> &state, const double time,
            const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                     typename Equilibrium<dim>::Vector       &x)> &solve);
} // namespace scree
