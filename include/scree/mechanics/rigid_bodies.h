#pragma once

#include <scree/contact/contact_points.h>

#include <vector>

namespace scree
{
/** Where a rigid body is and what drives it. */
template <int dim>
struct RigidBodyState
{
  unsigned int           body;
  dealii::Tensor<1, dim> displacement; //!< of the reference point [L]
  dealii::Tensor<1, 3>   rotation;     //!< rotation vector [rad]; 2D: only the last component
  /** What holds it against contact: reactions, or in equilibrium the applied force. */
  dealii::Tensor<1, dim> force;
  dealii::Tensor<1, 3>   moment; //!< of that, about the current reference point
};

/**
 * The rows of the rigid bodies in the equilibrium: applied forces and moments of free components,
 * against the generalised contact forces that ContactPoints adds; prescribed components are kept in
 * u and eliminated like supports (theory.md section 5). Rotations are unknown as arcs at the
 * body's radius, so that all rows are forces.
 */
template <int dim>
class RigidBodies
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  RigidBodies(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
              const ContactPoints<dim> &contact);

  /** Prescribed components, on the process that owns them. */
  const std::vector<DofIndex> &prescribed() const
  {
    return prescribed_unknowns;
  }

  /** The unknowns of each body: all couple. */
  std::vector<std::vector<DofIndex>> couplings() const;

  /** Sets the prescribed components of time `time` in u. */
  void set(Vector &u, const double time) const;

  /** Generalised forces of the applied loads at time `time` and the pose in the ghosted `u`. */
  void applied(const Vector &u, const double time, Vector &forces) const;

  /** Subtracts the derivative of applied(): moments of fixed direction turn with the pose. */
  void add_to_matrix(const Vector &u, const double time,
                     dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** Whether that derivative is symmetric. */
  bool is_symmetric(const double time) const;

  /**
   * Stiffness scales E L^(dim - 2) of free rigid bodies from their contacts [force/L].
   *
   * @throws UserError if a body has none
   */
  std::vector<double> stiffness_scales(const std::vector<unsigned int> &free_bodies) const;

  /** Work of prescribed motions and applied loads from one state to the next, on the owner. */
  double work(const Vector &u, const Vector &old_u, const Vector &forces,
              const Vector &old_forces) const;

  /** Largest |u| of the corners of a body's box, on a moving geometry from where they are; u with
   * ghosts. */
  double largest_displacement(const unsigned int body, const Vector &u) const;

  RigidPose<dim> pose(const unsigned int body, const Vector &u) const;

  /** All rigid bodies at the ghosted `u`, with the contact of the last evaluation (collective). */
  std::vector<RigidBodyState<dim>> states(const Vector &u) const;

  /** Force and moment, about the current reference point, that are given for free components. */
  std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, 3>> applied_load(const unsigned int body,
                                                                       const double time) const;

private:
  /** Calls `f(body, component, unknown)` for all components that this process owns. */
  template <typename Function>
  void for_owned(const Function &f) const
  {
    for (const unsigned int b : rigid_bodies)
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (space.owned().is_element(space.rigid_unknown(b) + m))
          f(*bodies[b].rigid, m, space.rigid_unknown(b) + m);
  }
  typename RigidPose<dim>::Load weight(const unsigned int body, const double time) const;
  dealii::Tensor<1, 3>          applied_moment(const unsigned int body, const double time) const;

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const ContactPoints<dim>     &contact;
  std::vector<unsigned int>     rigid_bodies;
  std::vector<DofIndex>         prescribed_unknowns;
};
} // namespace scree
