#pragma once

#include <scree/mechanics/boundary_regions.h>

#include <vector>

namespace scree
{
/**
 * Sets in `coverage`, of all owned cells, the share of the surface that a region covers in the
 * cells where it has points, c_K = |R in K|/|S in K|, to 2^-10 in 2D, 2^-5 in 3D. The share of
 * quadrature points would not do: at degree 1 a cell has two.
 */
template <int dim>
void set_coverage(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const Body<dim> &body, const BoundaryRegion<dim> &region,
                  const Kinematics<dim> &kinematics, std::vector<double> &coverage);

/**
 * Whether each owned cell K is on the edge of a region and outside of it rather than inside:
 *
 *   0 < c_K < 1/2 <= c_K' in a cell K' that shares a node (collective call).
 *
 * So a region narrower than half a cell, which has no such K', keeps all its cells.
 */
template <int dim>
std::vector<bool> outer_edge(const DisplacementSpace<dim> &space,
                             const std::vector<double>    &coverage);
} // namespace scree
