#pragma once

#include <scree/level_set/lattice.h>

namespace scree
{
/**
 * The volume (area in 2D) where the multilinear interpolant is below `level`, by lines along x: 8
 * per cell and further direction, exact on each line.
 */
template <int dim>
double volume_below(const Lattice<dim> &lattice, double level);

/**
 * Turns labels, nodal values of which only the sign counts and every node stands for the voxel
 * around it, into a signed distance with a smooth contour: the indicator of the negative nodes is
 * smoothed by `n_passes` of the kernel (1/4, 1/2, 1/4) along each axis (standard deviation
 * `sqrt(n_passes / 2)` spacings), cut at the level that keeps the volume of the voxels, and
 * replaced by its distance (compute_distances()), shifted so that volume_below() zero is kept. The
 * contour ends up about half a spacing from the steps at most, where features are wider than the
 * kernel. A kernel G of deviation s moves contours of curvature k by s^2 k/2; if `is_unbiased` it
 * is 2 G - G G, which does not in this order ("twicing", Tukey 1977). Throws ExcMessage without
 * labels of both signs.
 */
template <int dim>
void distance_from_labels(Lattice<dim> &lattice, unsigned int n_passes = 4,
                          bool is_unbiased = false);
} // namespace scree
