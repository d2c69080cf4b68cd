#pragma once

#include <scree/mechanics/discrete_problem.h>

#include <vector>

namespace scree
{
/** Estimate of the error of the displacement in the energy norm. */
struct ErrorEstimate
{
  std::vector<double> squares;       //!< eta_K^2 of the owned grid cells [force L]
  double              relative = 0.; //!< sqrt(sum of eta_K^2 / (2 strain energy))
};

/**
 * Of an accepted state, by stress recovery, see recovery_errors(). NaN on a moving geometry, for
 * the recovery knows linear elasticity on a fixed one only (collective).
 */
template <int dim>
ErrorEstimate estimate_error(const DiscreteProblem<dim> &problem, const State<dim> &state);
} // namespace scree
