#pragma once

#include <scree/bodies/body.h>

namespace scree
{
/**
 * Shows a rigid body at the pose q: its shape at the initial positions,
 * `phi(x) = phi_0(R^T (x - X_c - U) + X_c)`, on a new lattice around the moved body. The distance
 * is exact where that of the shape is. Sets level_set, box and pose; does nothing if the body is
 * shown at q already. A body that has left the background box and the margin around it keeps a
 * small lattice of positive values at the nearest place, and a box without volume.
 *
 * @param frame  of the lattices, with the background box
 * @param margin [L], both as given to make_bodies(): q = 0 restores its lattice to the last bit
 */
template <int dim>
void place_rigid_body(Body<dim> &body, const typename RigidPose<dim>::Unknowns &q,
                      const LatticeFrame<dim> &frame, const double margin);
} // namespace scree
