#pragma once

#include <scree/discretization/small_cut_treatment.h>
#include <scree/mechanics/mass_points.h>
#include <scree/mechanics/rigid_masses.h>
#include <scree/state/state.h>

#include <functional>
#include <memory>
#include <vector>

namespace scree
{
/**
 * The mass of all bodies and what moves with it. That of deformable bodies lies at points,
 *
 *     M = sum_p m_p N(x_p) N(x_p)^T + gamma_m rho h^2 s_h,
 *
 * with the jumps s_h of the treatment of small cuts, so that M is well conditioned however cells
 * are cut. Linear fields have no jumps: what is fitted to the points keeps their linear and angular
 * momentum. Rigid bodies have RigidMasses instead of rows of M.
 *
 * A lumped M has the row sums of the first term on its diagonal. What is fitted then is
 * v_i = sum_p m_p v_p N_i(x_p)/M_i, smoother than v_p: M v still has the linear and angular
 * momentum of the points, but v(x_p) has only the linear one.
 */
template <int dim>
class Mass
{
public:
  using Vector  = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix  = dealii::TrilinosWrappers::SparseMatrix;
  using Vectors = std::vector<dealii::Tensor<1, dim>>;

  /** gamma_m/gamma on a moving geometry, where the kinetic energy of jumps is lost as cuts move
   * (theory.md, section 12). */
  static constexpr double moving_jump_share = 0.1;

  /**
   * Consistent or lumped.
   *
   * @param jump_share gamma_m/gamma
   * @throws UserError if a deformable or a free rigid body has no density (collective)
   */
  Mass(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
       const SmallCutTreatment<dim> &small_cuts, MassPoints<dim> mass_points,
       const double jump_share = 1., const bool is_lumped = false);

  const MassPoints<dim> &points() const
  {
    return mass_points;
  }

  const RigidMasses<dim> &rigid() const
  {
    return rigid_masses;
  }

  /** M on the unknowns, hanging nodes condensed; zero for those that belong to no node. */
  const std::shared_ptr<const Matrix> &matrix() const
  {
    return mass_matrix;
  }

  /** sum_p m_p N(x_p) a_p of values at the points. */
  Vector forces(const Vectors &values) const;

  /** Adds the weight of deformable bodies (collective). */
  void add_weight(Vector &loads, const double time) const;

  /**
   * v with M v = f at the owned unknowns, zero where there is no mass (collective).
   *
   * @param set_zero where v is zero and the equations do not hold; null: nowhere
   */
  Vector solve(const Vector &forces, const std::function<void(Vector &)> &set_zero = nullptr) const;

  /** The field v that minimises sum_p m_p |v(x_p) - v_p|^2 + jumps (collective). */
  Vector fit(const Vectors &values) const
  {
    return solve(forces(values));
  }

  /** The values of a field at the points (collective). */
  Vectors at_points(const Vector &v) const;

  /** A vector with ghosts and hanging nodes, and the field that it is (collective). */
  Vector              with_ghosts(const Vector &v) const;
  PointEvaluator<dim> field(const Vector &v) const;

  /** The initial velocities of the bodies at the points, spins about their centres (collective). */
  Vectors initial_velocities() const;

  /** Sets the rows of rigid bodies to their initial motion. */
  void set_initial_motion(Rates &rates) const;

  /**
   * Sets the accelerations that forces r without inertia cause at u (collective).
   *
   * @param set_zero where deformable bodies are not accelerated
   */
  void set_accelerations(const Vector &u, const Vector &r,
                         const std::function<void(Vector &)> &set_zero, Rates &rates) const;

  /** v . M v/2 of all bodies at a displacement (collective). */
  double kinetic_energy(const Vector &u, const Rates &rates) const;

  /**
   * The momenta of the bodies (collective).
   *
   * @param motion of the mass points since the start of the step [L]
   * @param velocities of the mass points
   */
  std::vector<Momentum<dim>> momenta(const Vector &u, const Rates &rates, const Vectors &motion,
                                     const Vectors &velocities) const;

  /** Takes off the velocities of the deformable ones of some bodies the AddedSpin of d and w
   * (collective). */
  void take_off_spins(const std::vector<bool> &of_bodies, const Vector &d, const Vector &w,
                      Vector &velocity) const;

  RigidPose<dim> pose(const typename RigidMasses<dim>::OfBody &body, const Vector &ghosted) const;

private:
  void set_up_matrix(const SmallCutTreatment<dim> &small_cuts, const double jump_share,
                     const bool is_lumped);
  /** The jumps of small cuts. */
  void add_jumps(const SmallCutTreatment<dim> &small_cuts, const double jump_share,
                 Matrix &matrix) const;
  void add_points(Matrix &matrix) const;
  void require_densities() const;

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const MassPoints<dim>         mass_points;
  const RigidMasses<dim>        rigid_masses;
  std::shared_ptr<const Matrix> mass_matrix;
};
} // namespace scree
