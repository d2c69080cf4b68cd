#pragma once

#include <scree/discretization/displacement_space.h>
#include <scree/level_set/extended_increment.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/** How the level sets of deformable bodies follow an increment. */
struct LevelSetMotion
{
  double          margin; //!< of the lattices around the bodies [L], as given to make_bodies()
  IncrementMotion motion                     = IncrementMotion::semi_lagrangian;
  double          reinitialisation_tolerance = 0.1; //!< of ||grad phi| - 1|
};

/** What the motion of one body found; all zero, and the increment empty, for rigid bodies. */
template <int dim>
struct BodyMotion
{
  ExtendedIncrement<dim> increment;
  double                 largest_increment = 0.; //!< largest |du| at a node of its cells [L]
  /** Largest |du . n| on the faces of the background box that clip it: material passes there [L].
   */
  double       face_increment = 0.;
  std::size_t  n_unconverged  = 0;  //!< nodes without a back-trace: should be 0
  unsigned int n_islands      = 0;  //!< pieces without material, which were removed
  double       contour_motion = 0.; //!< by the reinitialisation [L]
  bool         is_reboxed     = false;
};

/**
 * @throws UserError if the level set of a deformable body is stored in tiles, which do not move:
 * the geometry of such a run must stay. To be called before anything is computed.
 */
template <int dim>
void require_movable(const std::vector<Body<dim>> &bodies);

/**
 * Moves the level sets, lattices and boxes of the deformable bodies by the increment
 * `x = X + du(X)` (theory.md, moving level sets): du at the lattice nodes in the body's cells,
 * linear extension, advection, removal of islands, reinitialisation, a lattice that follows the
 * body. Everything is done on every process; reference maps are exact where |phi| is at most twice
 * the margin, or 32 spacings.
 *
 * Beyond a face of the background box, which clips a body, du is the linear continuation through
 * the face, `du(f - d) = 2 du(f) - du(f + d)`: where the normal component vanishes on a face, the
 * contour stays on it or slides along it. An island is a piece of the new {phi < 0} that no node of
 * the old body in its cells goes to.
 *
 * @param du           with ghosts, hanging nodes distributed; collective call
 * @param displacement the same for u = x - X at the start of the step; for the reference map only
 */
template <int dim>
std::vector<BodyMotion<dim>>
move_level_sets(std::vector<Body<dim>> &bodies, const DisplacementSpace<dim> &space,
                const dealii::TrilinosWrappers::MPI::Vector &du,
                const dealii::TrilinosWrappers::MPI::Vector &displacement,
                const LevelSetMotion                        &options);
} // namespace scree
