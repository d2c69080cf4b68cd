#pragma once

#include <scree/mechanics/discrete_problem.h>
#include <scree/mechanics/time_scheme.h>

namespace scree
{
/**
 * Sets the rates of what is prescribed: the velocity by its formula just before `time`, the mean
 * acceleration of the step. Schemes would let them oscillate where a motion begins at once.
 *
 * @param before rates at the start of the step; null: at the start of the run, the velocity just
 *               after it
 * @param dt     of the step
 */
template <int dim>
void set_prescribed_rates(const Equilibrium<dim> &equilibrium, const double time, const double dt,
                          const Rates *before, Rates &rates);

/**
 * The rates at the end of a step to `time`, at the u of the last residual(), with those of what is
 * prescribed (collective).
 *
 * @param state at the start of the step
 */
template <int dim>
Rates rates_at_end(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
                   const State<dim> &state, const typename Equilibrium<dim>::Vector &u,
                   const double time);
} // namespace scree
