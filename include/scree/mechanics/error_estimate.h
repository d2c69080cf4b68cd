#pragma once

#include <scree/mechanics/discrete_problem.h>

#include <limits>
#include <vector>

namespace scree
{
/** Estimate of the error of the displacement in the energy norm. */
struct ErrorEstimate
{
  std::vector<double> squares; //!< eta_K^2 of the owned grid cells [force L]
  /** sqrt(sum of eta_K^2 / (2 strain energy)); NaN: unknown */
  double relative = std::numeric_limits<double>::quiet_NaN();
};

/**
 * Of an accepted state of linear elasticity on a fixed geometry, by stress recovery, see
 * recovery_errors() (collective).
 */
template <int dim>
ErrorEstimate estimate_error(const DiscreteProblem<dim> &problem, const State<dim> &state);
} // namespace scree
