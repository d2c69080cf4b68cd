#pragma once

#include <scree/mechanics/discrete_problem.h>

#include <functional>

namespace scree
{
/** Where contact_prediction() leads. */
template <int dim>
struct ContactPrediction
{
  typename Equilibrium<dim>::Vector u;
  unsigned int                      n_iterations        = 0;
  unsigned int                      n_linear_iterations = 0; //!< iterations of linear solvers
};

/**
 * A displacement near the equilibrium of loose bodies: that of bodies with their present tangent
 * K_0, whose contact an InteriorContact closes by and by,
 *
 *     (K_0 + B^T D B) du = r - K_0 (u' - u) + B^T (forces + changes),
 *
 * u' + alpha du until p s is 1e-4 of what it was at first, what is left of forces 1e-2 of those of
 * contact or 1e-5 of those at first, for 40 iterations, or till a linear system cannot be solved.
 * Each body then turns finitely by its rigid part. How many iterations it takes does not depend on
 * how many contacts close one after the other.
 *
 * @param u             where the equilibrium's time was set
 * @param is_interrupted asked after each iteration (collective)
 */
template <int dim>
ContactPrediction<dim> contact_prediction(const DiscreteProblem<dim>              &problem,
                                          const ContactHistory<dim>               &history,
                                          const typename Equilibrium<dim>::Vector &u,
                                          const std::function<bool()>             &is_interrupted);
} // namespace scree
