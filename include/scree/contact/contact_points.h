#pragma once

#include <scree/contact/contact_discretisation.h>
#include <scree/contact/contact_laws.h>
#include <scree/contact/enforcement.h>

#include <memory>
#include <utility>
#include <vector>

namespace scree
{
/**
 * Contact as mechanics sees it, whatever its discretisation, laws and enforcement: an evaluation
 * makes jumps, responses and forces of a displacement.
 */
template <int dim>
class ContactPoints
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /**
   * With penalties eps = c s' E/h, s' of plastic flow.
   *
   * @throws UserError if two rigid bodies have no penalty modulus
   */
  ContactPoints(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                ContactDiscretisation<dim> &&discretisation);

  const std::vector<ContactPoint<dim>> &points() const
  {
    return discretisation.points;
  }

  const JumpOperator<dim> &jump_operator() const
  {
    return discretisation.jump_operator;
  }

  const std::vector<ContactPair> &pairs() const
  {
    return contact_laws.pairs();
  }

  const Enforcement<dim> &enforcement() const
  {
    return *contact_enforcement;
  }
  void set_enforcement(std::unique_ptr<Enforcement<dim>> other)
  {
    contact_enforcement = std::move(other);
  }

  /** Enforcement::start_step(). */
  void start_step(const ContactHistory<dim> &history)
  {
    contact_enforcement->start_step(history);
  }

  /** Enforcement::update() in the equilibrium of the last evaluation (collective). */
  bool update_enforcement()
  {
    return contact_enforcement->update(contact_responses);
  }

  /** History of an unloaded surface. */
  ContactHistory<dim> initial_history() const;

  /** Also what the solver changes in the laws for a while. */
  ContactLaws<dim> &laws()
  {
    return contact_laws;
  }

  /** Largest overlap of each pair without displacement; tied ones have none. Collective. */
  std::vector<double> overlaps(const MPI_Comm communicator) const;

  /** Computes [[u]] and the response of all points for the ghosted displacement `u`. */
  void evaluate(const Vector &u, const ContactHistory<dim> &history);

  /** Computes [[u]] alone; the responses and forces are those of the last evaluate(). */
  void take_jumps(const Vector &u);

  /**
   * The responses of points to jumps, whatever the last evaluation was; points of a pair come one
   * after the other.
   */
  std::vector<ContactResponse<dim>> responses_to(const std::vector<unsigned int>           &numbers,
                                                 const std::vector<dealii::Tensor<1, dim>> &jumps,
                                                 const ContactHistory<dim> &history) const;

  /** The history to carry on: tractions and jumps of the last evaluation. */
  ContactHistory<dim> current_history() const;

  /** Responses of the last evaluation. */
  const std::vector<ContactResponse<dim>> &responses() const
  {
    return contact_responses;
  }

  /** Jumps of the last evaluation. */
  const std::vector<dealii::Tensor<1, dim>> &jumps() const
  {
    return evaluated.jumps;
  }

  /** Means (u_a(x_a) + u_b(x_b))/2 of the last evaluation: how the surface moves. */
  const std::vector<dealii::Tensor<1, dim>> &mean_displacements() const
  {
    return evaluated.means;
  }

  /** Gap g_0 + n.[[u]] of the last evaluation. */
  double gap(const unsigned int point) const;

  /** The E of a pair's penalties [force/area]. */
  double modulus(const unsigned int pair) const;

  /** Contact forces of the last evaluation on a rigid body, of the points of this process. */
  typename RigidPose<dim>::Load rigid_load(const unsigned int body) const
  {
    return jump_operator().rigid_load(body, contact_forces);
  }

  /** Adds -R_contact(v) = int (p n + tau).[[v]] of the last evaluation. */
  void add_to_residual(Vector &residual) const
  {
    jump_operator().add_forces(contact_forces, residual);
  }

  /** The points with a stiffness D in the last evaluation; with D_0 if they are glued. */
  std::vector<bool> stiff_points(const bool are_glued) const;

  /** The points with gaps up to `cells` of theirs in the last evaluation. */
  std::vector<bool> points_within(const double cells) const;

  /** Adds the derivative of R_contact of the last evaluation. */
  void add_to_matrix(Matrix &matrix) const;

  /**
   * The stiffness D_0 of glued points, for all of them or for those closed in the last evaluation,
   * zero for the others. It is kept for tangent_changes().
   */
  const std::vector<dealii::Tensor<2, dim>> &choose_glued(const bool only_closed);

  /** E = D - D_0: the derivative of R_contact is B^T (D_0 + E) B; blocks row by row. */
  std::vector<double> tangent_changes() const;

private:
  std::vector<ContactStiffness> penalties() const;
  /** The derivative of a point's force; zero of open ones. */
  dealii::Tensor<2, dim> stiffness(const unsigned int point) const;

  ContactDiscretisation<dim>          discretisation;
  ContactLaws<dim>                    contact_laws;
  std::vector<double>                 pair_modulus; //!< E = 2/(1/E_a + 1/E_b)
  std::unique_ptr<Enforcement<dim>>   contact_enforcement;
  ContactJumps<dim>                   evaluated;
  std::vector<ContactResponse<dim>>   contact_responses;
  ContactForces<dim>                  contact_forces;
  std::vector<dealii::Tensor<2, dim>> glued_stiffness; //!< D_0
};
} // namespace scree
