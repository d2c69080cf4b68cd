#pragma once

#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/rigid_bodies.h>
#include <scree/mechanics/strong_supports.h>
#include <scree/state/state.h>

#include <optional>
#include <vector>

namespace scree
{
/** A displacement and what acts there, by unknown. */
template <int dim>
struct EvaluatedState
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  double              time;
  const Vector       &u;
  PointEvaluator<dim> field; //!< of u
  const Vector       &loads; //!< all, and the right-hand sides of multiplier rows
  const Vector       &dead_loads;
  const Vector       &contact_forces;
  Vector driving; //!< applied forces on rigid bodies and reactions of what is prescribed
  double kinetic_energy = 0.;
  double share_of_old_contact; //!< 1/2, as of other forces; with inertia 0: contact is implicit
};

/**
 * The energies of accepted states and what became of the work between them, by the trapezoidal
 * rule: external work = stored + dissipated - transfer + error (theory.md section 11). Contact is
 * at its last evaluation, that of the state that is accepted.
 */
template <int dim>
class EnergyLedger
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  EnergyLedger(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
               const Kinematics<dim> &kinematics, const BoundaryTerms<dim> &boundary_terms,
               const ContactPoints<dim> &contact, const StrongSupports<dim> &supports,
               const RigidBodies<dim> &rigid);

  /** Takes the place of the accepted state before it is evaluated. */
  void set_accepted(const double time, const Vector &u);

  /** The same with what acts there and its energies, to go on from. */
  void resume(const EvaluatedState<dim> &state, const Energies &energies);

  /**
   * Starts a step with equations of its own, see Equilibrium::start_step().
   *
   * @param unbalanced forces on the unknowns
   */
  void start_step(const EvaluatedState<dim> &state, const Vector &unbalanced,
                  const ContactHistory<dim> &history, const Energies &energies,
                  const DrivingForces<dim> *driving);

  /** Adds the work and dissipation since the accepted state, takes this one. */
  void accept(const EvaluatedState<dim> &state, const ContactHistory<dim> &old_history);

  /** accept(); what that adds to the error of the balance of energies is transfer. */
  void accept_as_transfer(const EvaluatedState<dim> &state, const ContactHistory<dim> &old_history);

  /** Takes what the accepted state stores as external work: bodies that overlap were assembled. */
  void count_overlap();

  /** With inertia, where loads act from the beginning: takes all that the accepted state of
   * resume() stores as external work. */
  void start_motion(const EvaluatedState<dim> &state);

  /**
   * After start_step(), with inertia: goes on from these energies. What the fitted state stores in
   * contact is no measure of what the step gets of it, for bodies pass many contact points; what
   * the motion of the geometry changed is left in the error of the balance.
   */
  void start_without_transfer(const Energies &energies);

  const Energies &energies() const
  {
    return current_energies;
  }

  const Vector &accepted_displacement() const
  {
    return accepted_u;
  }

  double time_of_accepted() const
  {
    return accepted_time;
  }

  /** What drives bodies at the accepted state (collective). */
  DrivingForces<dim> driving_forces() const;

private:
  unsigned int n_rigid_unknowns() const;
  /** External work of the step, but that of dead loads. */
  double work_of_step(const EvaluatedState<dim> &state);
  double work_of_multipliers(const EvaluatedState<dim> &state);
  /** Of pressures that follow the surface. */
  double work_of_pressures(const EvaluatedState<dim> &state) const;
  /** Of constant forces on what is prescribed, from the accepted time on. */
  double work_on_prescribed(const std::vector<DrivenPoint<dim>> &driven, const double time) const;
  /** What the unbalanced forces of the start of the step release in its motion. */
  double released_work(const EvaluatedState<dim> &state, const Vector &motion,
                       const ContactHistory<dim> &old_history) const;
  void   set_accepted_forces(const EvaluatedState<dim> &state);
  void   set_accepted_conditions(const EvaluatedState<dim> &state);
  void   set_unloaded();
  /** Returns the plastic dissipation since the start of the step. */
  double store_energies(const EvaluatedState<dim> &state);

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const Kinematics<dim>        &kinematics;
  const BoundaryTerms<dim>     &boundary_terms;
  const ContactPoints<dim>     &contact;
  const StrongSupports<dim>    &supports;
  const RigidBodies<dim>       &rigid;

  // The accepted state; at first the unloaded one.
  Energies                      current_energies;
  double                        accepted_time = 0.;
  bool                          is_unloaded   = true; //!< nothing was prescribed there
  Vector                        accepted_u, accepted_dead_loads, accepted_reactions;
  Vector                        accepted_prescribed; //!< right-hand sides of the multiplier rows
  std::vector<DrivenPoint<dim>> accepted_driven;     //!< forces on what is prescribed
  /** Tractions and displacements at the points of following pressures, else empty. */
  std::vector<std::vector<dealii::Tensor<1, dim>>> accepted_tractions, accepted_displacements;

  /** What is unbalanced at the start of a step. */
  struct Unbalanced
  {
    Vector                              residual; //!< of deformable bodies
    Vector                              rigid;    //!< forces on rigid bodies, less those before
    std::vector<DrivenPoint<dim>>       driven;   //!< forces of the fitted state
    std::vector<dealii::Tensor<1, dim>> tau;      //!< of the contact points
  };
  std::optional<Unbalanced> unbalanced;
};
} // namespace scree
