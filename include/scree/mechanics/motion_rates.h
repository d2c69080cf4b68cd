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

/**
 * At the start of a step, where contact at grid nodes is closed between deformable bodies, takes
 * off the velocity with which they approach, which the fit to the nodes of a new grid brings back
 * (Chen et al. 2017, eqs. 85 and 86): with lumped masses and v = n.(v_b - v_a) < 0,
 *
 *     v_a <- v_a + v m_b/(m_a + m_b) n,   v_b <- v_b - v m_a/(m_a + m_b) n.
 *
 * Linear momentum is kept. Collective.
 *
 * @param history at the start of the step
 */
template <int dim>
void remove_approach(const DiscreteProblem<dim> &problem, const ContactHistory<dim> &history,
                     Rates &rates);
} // namespace scree
