#pragma once

#include <scree/level_set/halo_grid.h>

namespace scree
{
/** How `grad phi` is taken from the side that v comes from. */
enum class Upwinding
{
  first_order, // one-sided differences
  weno5        // Hamilton-Jacobi WENO5 (Jiang & Peng, SIAM J. Sci. Comput. 21, 2000)
};

/**
 * A stage of a strong-stability-preserving Runge-Kutta scheme,
 * `out = start_weight phi_n + (1 - start_weight) (phi + dt L(phi))`.
 */
struct StageWeights
{
  double start_weight; // no dimension
  double dt;           // unit of time of the velocity
};

/**
 * One stage with `L(phi) = -v . grad phi` at the nodes of a set, upwinded by the sign of v in each
 * direction. `velocity` are arrays of the set's nodes, packed (length per time); phi, start (phi_n)
 * and `out` carry a halo, which must be filled in phi and is filled in out if the set reaches it.
 * Other nodes of `out` are left alone. `out` may be start, not phi.
 *
 * The WENO weights use `epsilon = 0.1 h^2` beside the smoothness `13 (a - b)^2 + 3 (...)^2` of
 * undivided second differences a, b, ..., for slopes of order one as a distance has them. A kink
 * has a smoothness of some 10 h^2 and is still left out of the stencil; the usual 1e-6 also
 * switches at bends of the contour that the grid resolves (Zalesak's disc on 100^2: area -0.92 %
 * and L1/perimeter 0.128 instead of -0.21 % and 0.091).
 */
template <int dim>
void hj_stage(const NodeSet<dim> &nodes, Upwinding upwinding,
              const std::array<std::vector<double>, dim> &velocity, const StageWeights &weights,
              const std::array<const double *, 2> &phi_and_start, double *out);
} // namespace scree
