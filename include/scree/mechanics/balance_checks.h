#pragma once

#include <scree/base/run_log.h>
#include <scree/mechanics/discrete_problem.h>
#include <scree/solver/newton.h>

#include <vector>

namespace scree
{
/**
 * Residual of a node that leaves a body in balance [force]: what Newton's method accepts; of
 * rounding in the stiffness no more than 1e-6 of the forces, lest that of a stiff body hides them;
 * all of it where forces are no more than 100 times that of the softest body, as of grains that
 * lost contact.
 */
double balanced_residual(const double force_scale, const double relative_tolerance,
                         const double stiffness_round_off, const double softest_to_stiffest);

/**
 * That the converged step to `time` has every body in balance: forces, and moments where the body's
 * law balances them. Warns where contact at few points hardly holds a body against turning.
 * Collective.
 *
 * @param u of the last residual()
 * @throws UserError if a body is not in balance, with what it comes from
 */
template <int dim>
std::vector<BodyBalance<dim>>
require_balance(const DiscreteProblem<dim> &problem, const typename Equilibrium<dim>::Vector &u,
                const NewtonParameters &newton, const double time, RunLog &run_log);

/**
 * Whether require_balance() allows a state from which Newton's method does not get on: with a
 * residual of at most 1e-6 of the forces, or 100 times round-off, and every body in balance
 * (collective).
 *
 * @param u of the last residual()
 * @param residual its norm [force]
 */
template <int dim>
bool is_in_balance(const DiscreteProblem<dim> &problem, const typename Equilibrium<dim>::Vector &u,
                   const double residual, const NewtonParameters &newton);

/**
 * On a fixed geometry: that no body that only contact holds has turned by more than 0.8. Linear
 * kinematics lets one that tips over sink into what it stands on until something beside it bears.
 * Collective.
 *
 * @param balances of require_balance()
 * @param state    at the start of the step
 * @throws UserError where one has, that no equilibrium exists if none does
 */
template <int dim>
void require_small_rotations(const DiscreteProblem<dim>          &problem,
                             const std::vector<BodyBalance<dim>> &balances, const State<dim> &state,
                             const double time);

/**
 * On a fixed geometry: warns of each body that turned too far for linear kinematics. With the angle
 * theta and the moments M of the forces on it, the work M theta^2/2 on the second-order motion,
 * which linear kinematics does not have, is above 1 % of the stored energy. Collective.
 *
 * @param balances of require_balance()
 * @param u        the accepted state, of the last residual()
 */
template <int dim>
void warn_of_rotations(const DiscreteProblem<dim>              &problem,
                       const std::vector<BodyBalance<dim>>     &balances,
                       const typename Equilibrium<dim>::Vector &u, const double time,
                       RunLog &run_log);

/**
 * On a fixed geometry: warns of each body whose mean strain, above 5 %, is too large for linear
 * kinematics.
 *
 * @param balances of require_balance()
 */
template <int dim>
void warn_of_large_strains(const DiscreteProblem<dim>          &problem,
                           const std::vector<BodyBalance<dim>> &balances, const double time,
                           RunLog &run_log);
} // namespace scree
