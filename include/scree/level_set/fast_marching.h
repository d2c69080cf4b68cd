#pragma once

#include <scree/level_set/lattice.h>

#include <limits>

namespace scree
{
/** True if the lattice has nodes of both signs (zero counts as positive). */
template <int dim>
bool has_contour(const Lattice<dim> &lattice);

/**
 * Replaces the values of any level-set function by the signed distance to its zero contour, which
 * stays in place to a small fraction of the spacing: nodes next to the contour by
 * ContourDistance, the others by march_distances(). Throws ExcMessage without a contour.
 */
template <int dim>
void compute_distances(Lattice<dim> &lattice);

/**
 * Continues the distances of the `known` nodes (in the order of the values; what is not zero is
 * known) to all others up to a distance of `band` spacings. The values of those serve for their
 * sign only, what is farther keeps its value. Nodes with a cut edge within two spacings along an
 * axis must be known.
 *
 * Second-order fast marching, `|grad phi| = 1` with one-sided differences (Sethian, SIAM Review 41,
 * 1999), outwards and inwards at once. The order of acceptance is kept up to 1/256 spacing by
 * buckets (untidy queue of Yatziv, Bartesaghi & Sapiro, J. Comput. Phys. 212, 2006): a neighbour
 * that is left out for it changes a distance by at most 1e-5 spacings.
 */
template <int dim>
void march_distances(Lattice<dim> &lattice, const std::vector<char> &known,
                     double band = std::numeric_limits<double>::infinity());
} // namespace scree
