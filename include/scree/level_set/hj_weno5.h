#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scree
{
/** How `grad phi` is taken from the side that v comes from. */
enum class Upwinding
{
  first_order, // one-sided differences
  weno5        // Hamilton-Jacobi WENO5 (Jiang & Peng, SIAM J. Sci. Comput. 21, 2000)
};

/**
 * A dense uniform grid whose arrays carry three more nodes beyond each end, the halo that the
 * stencils reach into; x fastest.
 */
template <int dim>
struct HaloGrid
{
  static constexpr int width = 3; // nodes of halo at each end

  std::array<int, dim> n_nodes; // without halo
  double               spacing; // length

  /** The step between neighbours in direction d, in an array with halo. */
  std::size_t stride(int d) const;

  /** The position of node (0, ..., 0) in an array with halo. */
  std::size_t first() const;

  /** The length of an array with halo. */
  std::size_t size() const;

  /** Copies nodal values (x fastest, no halo) into an array with halo and fills the halo. */
  std::vector<double> with_halo(const std::vector<double> &values) const;

  /** Copies back without halo. */
  void copy_nodes(const std::vector<double> &with_halo, std::vector<double> &values) const;

  /** Continues the array linearly into its halo, direction by direction; not into the corners. */
  void extrapolate(std::vector<double> &with_halo) const;
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
 * One stage with `L(phi) = -v . grad phi`, upwinded by the sign of v in each direction. `velocity`
 * are nodal arrays without halo (length per time); `phi`, `start` (phi_n) and `out` carry a halo,
 * which must be filled in phi and is filled in out. `out` may be `start`, not `phi`.
 *
 * The WENO weights use `epsilon = 0.1 h^2` beside the smoothness `13 (a - b)^2 + 3 (...)^2` of
 * undivided second differences a, b, ..., for slopes of order one as a distance has them. A kink
 * has a smoothness of some 10 h^2 and is still left out of the stencil; the usual 1e-6 also
 * switches at bends of the contour that the grid resolves (Zalesak's disc on 100^2: area -0.92 %
 * and L1/perimeter 0.128 instead of -0.21 % and 0.091).
 */
template <int dim>
void hj_stage(const HaloGrid<dim> &grid, Upwinding upwinding,
              const std::array<std::vector<double>, dim> &velocity, const StageWeights &weights,
              const std::array<const std::vector<double> *, 2> &phi_and_start,
              std::vector<double>                              &out);
} // namespace scree
