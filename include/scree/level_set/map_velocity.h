#pragma once

#include <scree/level_set/halo_grid.h>

namespace scree
{
/**
 * The velocity that belongs to the motion `x = X + tau du(X)`, at the nodes of a set:
 * `v(x) = du(X(x))`, for every point keeps its velocity from tau = 0 to 1.
 *
 * Solves `w - du(x - tau w) = 0` for w at every node by `w <- w - (I + tau G)^{-1} r` with the
 * central differences G of du at x (exact in one step where du is linear) from the given w, until a
 * step that began with `|r| < 1e-8 spacing`. du is interpolated by cubic Lagrange polynomials on
 * the 4 nodes per direction around the point, linearly beyond the ends of the grid. Nodes that do
 * not get there in 30 iterations (the map folds) keep the given w and are counted.
 *
 * @param du       displacement increments at all nodes, length; one array per component
 * @param tau      part of the increment, 0 to 1
 * @param velocity in: the start; out: v(., tau); one packed array per component
 * @return the number of nodes without convergence
 */
template <int dim>
std::size_t map_velocity(const NodeSet<dim> &nodes, const std::array<std::vector<double>, dim> &du,
                         double tau, std::array<std::vector<double>, dim> &velocity);

/**
 * `result(x) = phi(x - displacement(x))` at the nodes of a set, by cubic Lagrange polynomials; from
 * beyond the ends of the grid the value at its nearest point plus the distance to it.
 *
 * @param phi          values at all nodes
 * @param displacement length; one packed array per component
 * @param result       packed
 */
template <int dim>
void values_at_departure(const NodeSet<dim> &nodes, const std::vector<double> &phi,
                         const std::array<std::vector<double>, dim> &displacement,
                         std::vector<double>                        &result);
} // namespace scree
