#pragma once

#include <scree/level_set/lattice.h>

namespace scree
{
/** True if the lattice has nodes of both signs (zero counts as positive). */
template <int dim>
bool has_contour(const Lattice<dim> &lattice);

/**
 * Replaces the values of any level-set function by the signed distance to its zero contour, which
 * stays in place to a small fraction of the spacing.
 *
 * Nodes next to the contour take the distance to the closest point of the cubic interpolant;
 * where the function has a kink (second difference above 0.3 of the first differences nearby)
 * that of the multilinear interpolant; where no closest point is found the estimate from the
 * cut edges, `d = (sum_i 1/d_i^2)^{-1/2}` with the distance d_i to the cut along axis i. The
 * others follow by second-order fast marching outwards and inwards (Sethian, SIAM Review 41,
 * 1999), `|grad phi| = 1` with one-sided differences. Throws ExcMessage without a contour.
 */
template <int dim>
void compute_distances(Lattice<dim> &lattice);
} // namespace scree
