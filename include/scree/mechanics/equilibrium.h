#pragma once

#include <scree/mechanics/body_balance.h>
#include <scree/mechanics/body_holds.h>
#include <scree/mechanics/body_stress.h>
#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/condensation.h>
#include <scree/mechanics/energy_ledger.h>
#include <scree/mechanics/free_bodies.h>
#include <scree/mechanics/inertia.h>

#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * The discrete equilibrium r(u) = f(t) - A u - R(u) - R_contact(u) - (c M u - h) = 0 of all bodies
 * and its tangent K = A + dR/du + dR_contact/du + c M, the inertia c M u - h as a TimeScheme says.
 * A is linear and assembled once; prescribed unknowns are kept in u and eliminated from K, so that
 * the terms also give their reactions (theory.md sections 3, 7, 8). Rigid bodies have rows without
 * A, their loads f depend on the pose.
 *
 * What u of deformable bodies means, and what of bulk and boundary conditions is in A or R, is up
 * to the Kinematics; of rigid bodies u is the whole motion.
 */
template <int dim>
class Equilibrium
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** Of E/L^2 times volume: holds free bodies in the tangent where contact does not. */
  static constexpr double default_mass_factor = 1e-6;

  /** @param mass of runs with inertia, else null; @param has_inertia it acts now, holds bodies */
  Equilibrium(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
              const Kinematics<dim> &kinematics, const BoundaryTerms<dim> &boundary_terms,
              ContactPoints<dim> &contact, const std::shared_ptr<const Mass<dim>> &mass = nullptr,
              const bool has_inertia = true);

  /**
   * Starts a step with equations of its own at the state `u` of time `time`: zero but for rigid
   * bodies and multipliers.
   *
   * @param energies at the end of the step before: what the motion of the geometry changed in them
   *                 is Energies::transfer
   * @param driving  there, null at the start of a run, when nothing is loaded. External work
   *                 goes on from these forces. The fitted state at u = 0 is not in equilibrium;
   *                 what its unbalanced forces release in the step also is Energies::transfer.
   */
  void start_step(const double time, const Vector &u, const ContactHistory<dim> &history,
                  const Energies &energies, const DrivingForces<dim> *driving);

  DrivingForces<dim> driving_forces() const; //!< at the accepted state (collective)

  /** Goes on after the accepted state `u` of these equations, with its time, history, energies. */
  void resume(const double time, const Vector &u, const ContactHistory<dim> &history,
              const Energies &energies);

  /** Computes the loads of time `time` and sets the prescribed unknowns of `u`. */
  void set_time(const double time, Vector &u);
  /** The same for time 0 without loads, until the next call; false: something is prescribed. */
  bool set_unloaded(Vector &u);
  /** set_time(); whether another motion is prescribed there than at the accepted time. */
  bool set_moved(const double time, Vector &u);

  /** Takes what the accepted state stores as external work: bodies that overlap were assembled. */
  void count_overlap();

  /** accept(); what that adds to the error of the balance of energies is transfer. */
  void accept_as_transfer(const Vector &u, const ContactHistory<dim> &old_history);

  void set_inertia(Inertia<dim> of_step); //!< none by default
  bool has_inertia() const;
  void set_kinetic_energy(const double energy); //!< of what start_step(), resume(), accept() take
  /** r(u) of the last residual() without inertia and contact. */
  Vector forces_without_inertia() const;
  /** M^-1 times the contact forces there, of rigid bodies as in RigidMasses::write(). */
  Vector accelerations_by_contact(const Vector &u) const;

  /** With inertia: starts a run at `u`; all that the bodies have there is external work. */
  void start_motion(const double time, const Vector &u, const ContactHistory<dim> &history);

  void set_prescribed(Vector &u) const; //!< sets what is prescribed at the time of set_time()
  /** r(u) with the contact history at the start of the step; 0 on prescribed and hanging rows. */
  void residual(const Vector &u, const ContactHistory<dim> &history, Vector &r);

  void set_zero_where_not_sought(Vector &r) const; //!< on prescribed and hanging rows

  const Matrix &tangent(); //!< K at the last residual(), prescribed rows and columns eliminated

  /** K at the last residual() without contact and artificial mass, all rows and columns, with
   * entries for these contact points; K_0 is left as it is if it has them. */
  void tangent_without_contact(const std::vector<bool> &points, Matrix &K_0);

  /** K_0 + B^T D B with the artificial mass, prescribed rows and columns eliminated. */
  const Matrix &tangent_with_contact(const Matrix                              &K_0,
                                     const std::vector<dealii::Tensor<2, dim>> &D);

  /** @param only_closed glues the points that are closed at the last residual(), not all */
  Condensation condensation(const bool only_closed);

  /** E at the last residual(), blocks of dim x dim. */
  std::vector<double> tangent_changes() const;

  bool is_symmetric() const; //!< and positive definite: K at the u of the last residual()
  bool is_symmetric_without_contact() const; //!< the same of K_0
  /**
   * Shortens the increment `du` of the last residual() such that no body that nothing holds moves
   * farther than `length`: the artificial mass alone would send it anywhere (collective).
   */
  void shorten(Vector &du, const double length) const;
  /** BodyHolds::adapt() for the du of the last residual(). */
  bool            adapt_holds(const Vector &du, const double length);
  BodyHolds<dim> &body_holds();
  /** Sets the artificial mass in the tangent, `factor` E/L^2 per volume, L half the body's size. */
  void set_artificial_mass(const double factor);
  /** Free bodies move against `factor` times that mass times u less the accepted one. */
  void   set_drag(const double factor);
  Vector artificial_forces(const Vector &du) const; //!< M du
  /** u += du, or FreeBodies::advance() where free bodies turn finitely (collective). */
  void advance(const Vector &du, Vector &u) const;

  /** Norm of the forces in balance at the last residual(), for relative tolerances. */
  double force_scale() const;
  /** The |r| that round-off in A u, or in the positions x of A x, leaves at the last residual(). */
  double round_off() const;
  /** The rigid motions for the near null space, see near_null_space(). */
  std::vector<Vector> rigid_motions() const;

  /** Bodies that supports alone do not hold. */
  const std::vector<FreeMotion> &free_bodies() const;
  /** What supports and the contact of the last residual() leave to them. */
  const FreeBodies<dim> &free_motions() const;
  /** Moves free bodies of the last residual() into balance, see FreeBodies::balancing(): the work
   * of their loads, of that of all |f_b| over a cell; empty: they stay. */
  std::optional<double> balance_rigid_motions(Vector &u, const ContactHistory<dim> &history,
                                              const bool is_settling = false) const;

  /**
   * What of the loads on the free bodies no contact can balance, see FreeBodies::unbalanced(): a
   * motion of length 0 (also if loads are round-off) to 1. Of the last residual() (collective).
   */
  typename FreeBodies<dim>::Coordinates unbalanced_loads() const;

  bool has_free_rigid_bodies() const;
  /** How a step is tried again: residual() leaves out FreeBodies::misplaced_moments(), free bodies
   * turn infinitesimally in any case: contact sees u, so that gaps are linear in rigid
   * motions, the bulk FreeBodies::strained(u). */
  void set_second_attempt(const bool is_second);
  /** Then makes the rigid motions of u finite ones (collective). */
  void turn(Vector &u) const;

  /** Moment on a body that residual() left out, over half its size [force]. */
  double held_moment(const unsigned int body) const;
  /** Whether r, of the last residual(), is at most `tolerance` but for moments below the accuracy
   * of geometry: 1e-4 of FreeBodies::misplaced_moments() (collective). */
  bool is_geometric(const Vector &r, const double tolerance) const;
  bool is_linear_elsewhere() const; //!< contact and rigid bodies alone change tangents
  const RigidBodies<dim> &rigid_bodies() const;
  /** RigidBodies::states() of the last residual(), inertia included (collective). */
  std::vector<RigidBodyState<dim>> rigid_states(const Vector &ghosted_u) const;
  const StrongSupports<dim>       &strong_supports() const;
  /** Largest |u| at the nodes of each body, since the geometry last moved (collective). */
  std::vector<double> largest_displacements(const Vector &u) const;

  /** u with ghost values and hanging nodes, and the field that it is. */
  Vector              with_ghosts(const Vector &u) const;
  PointEvaluator<dim> at_points(const Vector &u) const;

  /** Resultants of all conditions, in the order of condition_names(); of the last residual(). */
  std::vector<Resultant<dim>> resultants(const Vector &u) const;
  /** Forces on deformable bodies, their stress, at the u of the last residual() (collective). */
  std::vector<BodyBalance<dim>> balance(const Vector &u) const;
  std::vector<BodyStress<dim>>  body_stresses(const Vector &u) const;
  std::vector<std::string>      condition_names() const; //!< "body.condition", strong ones last
  /** Takes `u` as the accepted state of a step: adds its work and dissipation. */
  void            accept(const Vector &u, const ContactHistory<dim> &old_history);
  const Energies &energies() const; //!< of the accepted state

  const Kinematics<dim>                 &kinematics;
  const std::shared_ptr<const Mass<dim>> mass;      //!< of runs with inertia, else null
  const bool                             is_static; //!< nothing has inertia now

private:
  void set_up_matrices();
  /** A zero matrix with the entries of all but contact, and of these couplings (collective). */
  void make_matrix(const std::vector<std::vector<DofIndex>> &of_contact, Matrix &matrix) const;
  /** Adds body forces and weight of deformable bodies. */
  void                                  add_volume_forces(Vector &forces) const;
  typename FreeBodies<dim>::Coordinates loads_on_free_bodies() const;
  void                                  set_up_artificial_mass();
  bool                                  turns_infinitesimally() const;
  /** Takes FreeBodies::misplaced_moments() out of r. */
  void hold_moments(Vector &r);
  void set_zero_on_prescribed(Vector &r) const;
  /** Gives K entries for these contact points, and those within `near` cells, if it lacks some;
   * whether it did (collective). */
  bool couple(const std::vector<bool> &points, const double near = 0.5);
  void start_tangent();  //!< K without contact and artificial mass
  void finish_tangent(); //!< with that mass, without what is prescribed
  void add_artificial_mass(Matrix &matrix) const;
  void eliminate_prescribed(Matrix &matrix) const;
  void reactions(Vector &result) const;
  /** The displacement, that of the last residual(), and what acts there. */
  EvaluatedState<dim> evaluated(const Vector &u) const;
  /** Sets the time and what is prescribed there in `u`, takes it as accepted; returns r(u). */
  Vector take_as_accepted(const double time, const ContactHistory<dim> &history, Vector &u);

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const Bulk<dim>              &bulk;
  const BoundaryTerms<dim>     &boundary_terms;
  ContactPoints<dim>           &contact;
  StrongSupports<dim>           supports;
  RigidBodies<dim>              rigid;
  FreeBodies<dim>               free;
  BodyHolds<dim>                holds;
  EnergyLedger<dim>             ledger;

  Matrix              stiffness, newton_matrix; //!< A and K
  std::vector<bool>   coupled;                  //!< contact points with entries in K
  Vector              loads;                    //!< f
  Vector              dead_loads;               //!< tractions, pressures and body forces in f
  Vector              start_forces;    //!< of u_n; of a bulk that is not linear by small cuts
  Vector              internal_forces; //!< A u of the last residual()
  Vector              contact_forces;  //!< -R_contact of the last residual()
  Vector              applied_forces;  //!< on rigid bodies at the last residual()
  Inertia<dim>        inertia;         //!< of the step
  Vector              inertia_forces;  //!< h - c M u of the last residual()
  Vector              artificial_mass; //!< of free bodies on the diagonal, of factor 1
  Vector              ghosted;         //!< u of the last residual() with ghosts
  PointEvaluator<dim> seen_by_bulk;    //!< what the bulk sees of it
  dealii::IndexSet    ghosted_dofs;
  double              time = 0., drag = 0., kinetic_energy = 0.;
  double              mass_factor       = default_mass_factor;
  bool                is_driven         = true; //!< forces act on rigid bodies
  bool                is_second_attempt = false;
  bool                are_moments_whole = false;         //!< held moments, not scaled down
  std::vector<double> held_moments;                      //!< of the last residual(), by body
  double              largest_stiffness = 0.;            //!< largest diagonal entry of A
  Vector              diagonal;                          //!< of A
  Vector              scratch;                           //!< for one function at a time
  double              stiffness_times_displacement = 0.; //!< |diagonal u| of the last residual()
  double              inertia_terms                = 0.; //!< Inertia::size_of_terms()
};
} // namespace scree
