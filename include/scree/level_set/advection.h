#pragma once

#include <scree/level_set/hj_weno5.h>
#include <scree/level_set/lattice.h>

#include <functional>
#include <limits>

namespace scree
{
/** Vectors at the nodes of a lattice: one array per component, in the order of its values. */
template <int dim>
using NodalVectors = std::array<std::vector<double>, dim>;

/** How `phi_t + v . grad phi = 0` is solved on a lattice. */
struct AdvectionScheme
{
  Upwinding    upwinding  = Upwinding::weno5;
  unsigned int time_order = 3;   // 1, 2 or 3: TVD Runge-Kutta (Shu & Osher, 1988)
  double       cfl        = 0.5; // dt sum_i |v_i| / h, at most
  /**
   * Half width in spacings of the narrow band: only nodes with |phi| up to it plus the way that the
   * contour may go (duration times speed, or |du|) move, the others keep their values. The error
   * enters at the edge of the band, by 9 nodes per step of order 3; so 10 and more, for a level set
   * that is a distance. Infinite: all nodes.
   */
  double band = std::numeric_limits<double>::infinity();
};

/** How a level set follows a displacement increment du. */
enum class IncrementMotion
{
  reference_map,   // phi_new(x) = phi_0(X), X the initial position: image_of_initial()
  semi_lagrangian, // phi_new(x) = phi(X), X + du(X) = x; the whole increment at once
  map_velocity,    // v(x, tau) = du(X), X + tau du(X) = x, tau from 0 to 1
  frozen_velocity  // v = du: its flow differs from the map by O(|du| |grad du|)
};

/** What an update took. */
struct AdvectionCount
{
  unsigned int n_steps;
  std::size_t  n_unconverged; // nodes whose back-trace failed, summed over stages: should be 0
  std::size_t  n_nodes;       // that moved
};

/**
 * Solves `phi_t + v . grad phi = 0` for a time `duration` with nodal velocities (length per time),
 * in equal steps under the CFL bound of the velocity at their start. `velocity(t, v)` fills the
 * arrays for time t after the start; an update at `t` begins with what the last call left in v.
 * Beyond the ends of the lattice phi is continued linearly. Throws ExcMessage if a velocity is not
 * finite.
 */
template <int dim>
AdvectionCount advect(Lattice<dim>                                           &lattice,
                      const std::function<void(double, NodalVectors<dim> &)> &velocity,
                      double duration, const AdvectionScheme &scheme = AdvectionScheme());

/** The same with a velocity that does not depend on time. */
template <int dim>
AdvectionCount advect(Lattice<dim> &lattice, const NodalVectors<dim> &velocity, double duration,
                      const AdvectionScheme &scheme = AdvectionScheme());

/**
 * Moves the level set by the increment `x = X + du(X)`, du nodal (length, finite at all nodes). The
 * semi-Lagrangian update interpolates phi with cubic polynomials and has no step bound; of `scheme`
 * it takes the band only. Back-trace: see map_velocity().
 */
template <int dim>
AdvectionCount advect_increment(Lattice<dim> &lattice, const NodalVectors<dim> &du,
                                IncrementMotion        motion = IncrementMotion::semi_lagrangian,
                                const AdvectionScheme &scheme = AdvectionScheme());

/**
 * Makes a level set, from before the increment `x = y + du(y)`, the image of the initial one under
 * the whole motion `y = X + u(X)`:
 *
 *     phi(x) = phi_0(X),   X = y - u(y),   y = x - du(y),
 *
 * phi_0 and u (length, nodal, at the start of the increment) by cubic interpolation. Nothing of the
 * old values enters, so that no errors of increments add up (reference map technique: Kamrin,
 * Rycroft, Nave, J. Mech. Phys. Solids 60, 2012).
 *
 * @param moved_by   becomes x - X at the nodes
 * @param half_width of the old |phi| where this is so [L]; beyond, where distances need not be
 *                   sharp, y = x - du(x), u is that of x, and phi_0 is interpolated linearly
 */
template <int dim>
AdvectionCount image_of_initial(Lattice<dim> &lattice, const Lattice<dim> &initial,
                                const NodalVectors<dim> &du, const NodalVectors<dim> &displacement,
                                NodalVectors<dim> &moved_by,
                                double half_width = std::numeric_limits<double>::infinity());
} // namespace scree
