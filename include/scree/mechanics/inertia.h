#pragma once

#include <scree/mechanics/mass.h>

#include <memory>
#include <utility>
#include <vector>

namespace scree
{
/**
 * What inertia adds to the equations of a step, whatever the scheme that integrates them in time:
 * with accelerations that are linear in the motion, M a = c M u - h of deformable bodies, and of
 * the point masses of rigid ones, at x(q), a = c x - x_h.
 */
template <int dim>
struct Inertia
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  std::shared_ptr<const Mass<dim>> mass;                //!< null: there is no inertia
  double                           factor         = 0.; //!< c [1/time^2]
  double                           contact_weight = 1.; //!< of contact forces beside all others
  Vector                           forces; //!< h, without ghosts; beside it forces on any row
  /** c x_h of the points of each of RigidMasses::bodies(); empty: they do not enter. */
  std::vector<typename RigidMasses<dim>::Vectors> rigid = {};

  /** h - c M u, and the generalised forces of -a. @param ghosted u with ghosts */
  void get_forces(const Vector &u, const Vector &ghosted, Vector &result) const;

  /** One of the rigid bodies and the load m a of its points (without the sign of a force). */
  std::pair<unsigned int, typename RigidPose<dim>::Load> rigid_load(const unsigned int i,
                                                                    const Vector &ghosted) const;

  /** Norm of the forces that nearly cancel: of h and c x_h. */
  double size_of_terms() const;

  /** Adds the negative derivative. */
  void add_tangent(const Vector &ghosted, dealii::TrilinosWrappers::SparseMatrix &K) const;
};

/** The inertia of accelerations that do not depend on the motion, at a displacement u (collective).
 */
template <int dim>
Inertia<dim> inertia_of(const std::shared_ptr<const Mass<dim>> &mass,
                        const typename Inertia<dim>::Vector &u, const Rates &rates);
} // namespace scree
