#pragma once

#include <scree/contact/contact_surface.h>

namespace scree
{
/**
 * Whether a level set is smooth around x: over the lattice lines through the spacing that contains
 * x, with b_1 and b_2 the changes of the slope at the two ends of that spacing, |b_1 + b_2| <= 1.2
 * and |b_1 - b_2| <= 0.02 + 0.3 max |b_1 + b_2|, as for radii down to two spacings. Edges, corners
 * and medial axes next to x make it kinked.
 */
template <int dim>
bool is_smooth(const Lattice<dim> &level_set, const dealii::Point<dim> &x);

/** What contact_normal() tells. */
template <int dim>
struct ContactNormal
{
  dealii::Tensor<1, dim> normal;
  NormalOf               of;           //!< the body whose exact distance has it
  bool                   is_near_kink; //!< of a body whose exact distance is known
  bool is_flat       = false; //!< of a flat face of a rigid body: the same wherever they meet
  bool is_undeformed = false; //!< of two bodies with exact distances that have not deformed
};

/**
 * Unit normal from a to b at a point x of the surface phi_a = phi_b between them, with the
 * gradients n_a, n_b of the exact distances where those are known, else of the cubic interpolants
 * where the lattice is smooth:
 *
 *     n_a or -n_b   one of them is exact and has not deformed, without edges or corners near x: a
 *                   rigid body among deformed ones, which are as rough as their motion
 *     n_a - n_b     both are exact, have not deformed and face each other (to 25 degrees), or
 *                   neither or both bodies have edges or corners near x
 *     n_a or -n_b   of the body without edges and corners
 *     of_cut        none is known
 *
 * so that an edge or corner on a smooth face acts along the normal of that face.
 *
 * @param size of the cell; kinks up to 1.5 cells from the feet are near
 */
template <int dim>
ContactNormal<dim> contact_normal(const ExactDistances<dim>    &distances,
                                  const std::vector<Body<dim>> &bodies, const unsigned int a,
                                  const unsigned int b, const dealii::Point<dim> &x,
                                  const double size, const dealii::Tensor<1, dim> &of_cut);
} // namespace scree
