#pragma once

#include <scree/contact/contact_history.h>
#include <scree/contact/contact_laws.h>
#include <scree/contact/enforcement.h>
#include <scree/contact/expected_slide.h>
#include <scree/contact/initial_gap.h>
#include <scree/solver/condensed_solver.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace scree
{
/**
 * The unbiased contact surface S = {phi_a = phi_b <= shift} of every candidate pair, cut from the
 * background cells, as a flat list of points with the stencil of their displacement jump
 * [[u]] = sum_i w_i u(node_i) (theory.md section 8). A process holds the points of its cells.
 *
 * A rigid body moves its side of a point by its pose q: the unknowns of the free components take
 * the place of the nodes, with the derivatives of a finite rotation. The motion counts from the
 * pose q_n of Body::pose, in which its level set shows it: u(X; q) - u(X; q_n).
 *
 * On bodies that slide, x_a and x_b are the points that are expected to meet in the middle of the
 * step: with the jump d that a prediction tells, P = I - n n^T, they are the projections of
 * x + P d/2 and x - P d/2. Then g_0 + n.[[u]] is the gap at the end to second order in d; with
 * d = 0 it misses kappa d^2/2 for surfaces of curvature kappa that touch all along. Tractions act
 * where the bodies are at the end, with normal n': the gap is g_0 + n.d + n'.([[u]] - d), so that
 * g_0 + (n - n').d is stored as the initial gap. With n the force of a dragged tool would be wrong
 * by kappa d/2 times its normal force.
 *
 * Consecutive points with the same nodes form a group, so that a group is one dense block of the
 * matrix.
 */
template <int dim>
class ContactPoints
{
public:
  using Vector     = dealii::TrilinosWrappers::MPI::Vector;
  using Prediction = IncrementPrediction<dim>;

  /**
   * The gap at the start of the run, which decides what is glued and what Adjust takes off, is
   * that of the initial level sets at x - u_n, u_n taken at x_a and x_b. It belongs to the
   * material, so nothing needs to be remembered.
   *
   * @param shift bound on phi on the contact surface [L]
   * @param prediction empty: no sliding is expected
   * @param start_displacement u_n of the deformable bodies at the owned unknowns; null: zero
   * @param secant_ratios of plastic flow at the first unknown of each owned node; null: one
   * @throws UserError if two rigid bodies have no penalty modulus, or the contact surface ends
   * before the gaps that a law adjusts or glues
   */
  ContactPoints(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                const double shift, const Prediction &prediction = {},
                const Vector *start_displacement = nullptr, const Vector *secant_ratios = nullptr);

  const std::vector<ContactPoint<dim>> &points() const
  {
    return contact_points;
  }

  const std::vector<ContactPair> &pairs() const
  {
    return contact_laws.pairs();
  }

  /** By penalties eps = c s' E/h, s' of plastic flow, if no other one is set. */
  const Enforcement<dim> &enforcement() const
  {
    return *contact_enforcement;
  }
  void set_enforcement(std::unique_ptr<Enforcement<dim>> other)
  {
    contact_enforcement = std::move(other);
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

  /**
   * The responses of points to jumps, whatever the last evaluation was; points of a pair come one
   * after the other.
   */
  std::vector<ContactResponse<dim>> responses_to(const std::vector<unsigned int>           &points,
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
    return contact_jumps;
  }

  /** Means (u_a(x_a) + u_b(x_b))/2 of the last evaluation: how the surface moves. */
  const std::vector<dealii::Tensor<1, dim>> &mean_displacements() const
  {
    return contact_means;
  }

  /** Gap g_0 + n.[[u]] of the last evaluation. */
  double gap(const unsigned int point) const;

  /** The E of a pair's penalties [force/area]. */
  double modulus(const unsigned int pair) const;

  /** Contact forces of the last evaluation on a rigid body, of the points of this process. */
  typename RigidPose<dim>::Load rigid_load(const unsigned int body) const;

  /** Adds -R_contact(v) = int (p n + tau).[[v]] of the last evaluation. */
  void add_to_residual(Vector &residual) const;

  /** Adds the derivative of R_contact of the last evaluation. */
  void add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** Rows of B: component d of [[u]] at point p is (B u)(p dim + d). */
  SparseRows jump_rows() const;

  /**
   * Chooses the D_0 of the next two functions: that of glued points, for all of them or for those
   * closed in the last evaluation, zero for the others.
   */
  void choose_glued(const bool only_closed);

  /** Adds B^T D_0 B. */
  void add_glued_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** E = D - D_0: the derivative of R_contact is B^T (D_0 + E) B; blocks row by row. */
  std::vector<double> tangent_changes() const;

  /** The unknowns of each group, ascending: what couples in the matrix. */
  std::vector<std::vector<DofIndex>> couplings() const;

private:
  void find_rigid_partners(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies);
  /** @return E'/E of plastic flow at each point */
  std::vector<double> find_stencils(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                                    const Prediction          &prediction,
                                    const ExactDistances<dim> &distances,
                                    const InitialGaps<dim>    &initial_gaps,
                                    const Vector *start_displacement, const Vector *secant_ratios);
  std::vector<ContactStiffness> penalties(const std::vector<double> &flow_ratios) const;
  struct Feet; //!< where the displacements of all points are taken
  Feet find_feet(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                 const Prediction &prediction, const ExactDistances<dim> &distances);
  using NodeWeights = std::map<DofIndex, std::pair<double, double>>; //!< in the jump, and side
  void append_stencil(const ContactPoint<dim> &point, const NodeWeights &weights_and_sides,
                      std::vector<ContactPoint<dim>> &kept);

  /** Adds B^T D B, D given at each point; nothing for groups without stiffness. */
  void                   add_to_matrix(const std::vector<dealii::Tensor<2, dim>> &stiffness,
                                       dealii::TrilinosWrappers::SparseMatrix    &matrix) const;
  dealii::Tensor<2, dim> glued_tangent(const unsigned int point) const;

  /** Points of a pair with the same nodes. */
  struct Group
  {
    unsigned int first_point, n_points, first_node, n_nodes, first_weight;
  };

  /** A rigid body in contact. */
  struct RigidPartner
  {
    unsigned int                          body;
    std::shared_ptr<const RigidBody<dim>> rigid;
    DofIndex                              first_unknown;
    std::vector<unsigned int>             free_components;
    RigidPose<dim>                        start_pose; //!< u_n, where the level set shows the body
    RigidPose<dim>                        pose;       //!< of the last evaluation
    typename RigidPose<dim>::Load         load;       //!< of the last evaluation, on this process
  };
  /** Where a contact point lies on a rigid body. */
  struct RigidFoot
  {
    dealii::Point<dim>     X;     //!< initial position [L]
    dealii::Tensor<1, dim> start; //!< u_n(X) [L]
  };
  /** A rigid side of a pair: index of the partner and -1 for body a, 1 for body b. */
  struct RigidSide
  {
    unsigned int partner;
    double       sign;

    unsigned int number() const
    {
      return sign < 0. ? 0 : 1;
    }
  };
  const std::vector<RigidSide> &rigid_sides(const Group &group) const
  {
    return rigid_sides_of_pair[contact_points[group.first_point].pair];
  }
  /** The nodes' unknowns of a group, then the free components of its rigid sides. */
  std::vector<DofIndex> unknowns(const Group &group) const;
  void add_rigid_couplings(const Group &group, const unsigned int point, const double *weight,
                           const dealii::Tensor<2, dim> &stiffness,
                           dealii::FullMatrix<double>   &block) const;

  ContactLaws<dim>                    contact_laws;
  std::unique_ptr<Enforcement<dim>>   contact_enforcement;
  std::vector<double>                 pair_modulus; //!< E = 2/(1/E_a + 1/E_b)
  std::vector<RigidPartner>           rigid_partners;
  std::vector<std::vector<RigidSide>> rigid_sides_of_pair;
  std::vector<ContactPoint<dim>>      contact_points;
  std::vector<unsigned int>           all_points; //!< their numbers
  /** Of the rigid ones of the bodies a and b of each point; empty without rigid bodies. */
  std::vector<std::array<RigidFoot, 2>> contact_feet;
  std::vector<Group>                    groups;
  std::vector<DofIndex>                 group_nodes;
  std::vector<double>                   group_sides;     //!< of each node, -1: body a, 1: body b
  std::vector<double>                   stencil_weights; //!< per point, the nodes of its group
  std::vector<dealii::Tensor<1, dim>>   contact_jumps, contact_means;
  std::vector<ContactResponse<dim>>     contact_responses;
  std::vector<dealii::Tensor<2, dim>>   glued_tangents; //!< D_0 times the weight
};
} // namespace scree
