#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scree
{
/**
 * The velocity that belongs to the motion `x = X + tau du(X)`, at the nodes of a dense lattice:
 * `v(x) = du(X(x))`, for every point keeps its velocity from tau = 0 to 1.
 *
 * Solves `w - du(x - tau w) = 0` for w at every node by `w <- w - (I + tau G)^{-1} r` with the
 * central differences G of du at x (exact in one step where du is linear) from the given w, down
 * to `|r| < 1e-10 spacing`. du is interpolated by cubic Lagrange polynomials on the 4 nodes per
 * direction around the point, linearly beyond the ends of the lattice. Nodes that do not get there
 * in 30 iterations (the map folds) keep the last w and are counted.
 *
 * @param n_nodes  of the lattice, x fastest
 * @param spacing  length
 * @param du       nodal displacement increments, length; one array per component
 * @param tau      part of the increment, 0 to 1
 * @param velocity in: the start; out: v(., tau); one array per component
 * @return the number of nodes without convergence
 */
template <int dim>
std::size_t map_velocity(const std::array<int, dim> &n_nodes, double spacing,
                         const std::array<std::vector<double>, dim> &du, double tau,
                         std::array<std::vector<double>, dim> &velocity);
} // namespace scree
