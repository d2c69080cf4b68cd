#pragma once

#include <scree/level_set/lattice.h>

namespace scree
{
/** The end of a search for a point of the zero contour. */
template <int dim>
struct ClosestPoint
{
  dealii::Point<dim>     point;
  dealii::Tensor<1, dim> normal; // grad phi / |grad phi| at `point`, outward
  bool                   converged;
};

/**
 * The closest point to `x` on the zero contour of the interpolant of `degree`: solves
 * `phi(y) = 0`, `P (x - y) = 0` with `P = I - n n^T`. Each iteration takes the normal step
 * `-phi grad phi / |grad phi|^2` and the tangential Newton step
 * `(I + lambda P H P)^{-1} P (x - y)`, `lambda = (x - y) . grad phi / |grad phi|^2`, H the
 * Hessian (Chopp, SIAM J. Sci. Comput. 23, 2001, without H: it diverges where distance times
 * curvature reaches 1). Where this does not converge at once, a descent along the contour follows:
 * projected tangential steps, halved until the distance falls, which ends at kinks of the
 * interpolant too. The result is a local minimum of the distance, the one reached from `start`;
 * |phi| < 1e-12 spacings (times |grad phi|), tangential error 1e-8 spacings.
 */
template <int dim>
ClosestPoint<dim> closest_point(const Lattice<dim> &lattice, const dealii::Point<dim> &x,
                                unsigned int degree, const dealii::Point<dim> &start);

/** The same, starting from `x`. */
template <int dim>
ClosestPoint<dim> closest_point(const Lattice<dim> &lattice, const dealii::Point<dim> &x,
                                unsigned int degree);

/**
 * The plain gradient projection: `y <- y - phi grad phi / |grad phi|^2` from `y = x` until
 * `|phi| < 1e-13 spacing`, at most 20 steps (Rycroft & Gibou, J. Comput. Phys. 231, 2012). Follows
 * the gradient to the contour and equals the closest point where phi is a distance.
 */
template <int dim>
ClosestPoint<dim> project(const Lattice<dim> &lattice, const dealii::Point<dim> &x,
                          unsigned int degree);
} // namespace scree
