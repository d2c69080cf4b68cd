#pragma once

#include <scree/base/sparse_rows.h>
#include <scree/contact/contact_surface.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_BlockMap.h>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace scree
{
/** Forces on b at contact points, and what of them acts on the rigid bodies. */
template <int dim>
struct ContactForces
{
  std::vector<dealii::Tensor<1, dim>>        of_points; //!< tractions times weights
  std::vector<typename RigidPose<dim>::Load> of_rigid;  //!< of JumpOperator's rigid bodies
};

/** [[u]] and the means (u_a(x_a) + u_b(x_b))/2 of all contact points. */
template <int dim>
struct ContactJumps
{
  std::vector<dealii::Tensor<1, dim>> jumps, means;
};

/**
 * B: the jumps [[u]] = sum_i w_i u(node_i) at the contact points of this process (theory.md section
 * 8). Consecutive points of a pair with the same nodes form a group, so that a group is one dense
 * block of the matrix.
 *
 * A rigid body moves its side of a point by its pose q: the unknowns of the free components take
 * the place of the nodes, with the derivatives of a finite rotation. The motion counts from the
 * pose q_n of Body::pose, in which its level set shows it: u(X; q) - u(X; q_n). So B depends on the
 * poses, which are those of the last evaluate().
 */
template <int dim>
class JumpOperator
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;
  /** The weights of nodes in a jump, and their sides, -1: body a, 1: body b. */
  using NodeWeights = std::map<DofIndex, std::pair<double, double>>;

  /** Without points. */
  JumpOperator(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
               const std::vector<ContactPair> &pairs);

  /** Appends a point; its rigid sides are taken at its feet. */
  void append(const ContactPoint<dim> &point, const NodeWeights &nodes);

  /** The jumps of the ghosted displacement `u`. */
  ContactJumps<dim> evaluate(const Vector &u);

  ContactForces<dim> forces(std::vector<dealii::Tensor<1, dim>> &&of_points) const;

  /** Of these forces on a rigid body, from the points of this process. */
  typename RigidPose<dim>::Load rigid_load(const unsigned int        body,
                                           const ContactForces<dim> &forces) const;

  /** Adds B^T f. */
  void add_forces(const ContactForces<dim> &forces, Vector &residual) const;

  /** Adds B^T D B, D given at each point; nothing for groups without stiffness. */
  void add_stiffness(const std::vector<dealii::Tensor<2, dim>> &D, Matrix &matrix) const;

  /** Adds -f . d2u/dq2 of the rigid bodies. */
  void add_curvature(const ContactForces<dim> &forces, Matrix &matrix) const;

  /** Rows of B on nodes: component d of [[u]] at point p is (B u)(p dim + d). */
  SparseRows rows() const;

  /** The unknowns of all points, ascending. */
  std::vector<DofIndex> all_unknowns() const;

  /** Adds to some points the others of their groups. */
  void complete_groups(std::vector<bool> &points) const;

  /** The unknowns of each group with some of these points, ascending: what couples in the matrix.
   */
  std::vector<std::vector<DofIndex>> couplings(const std::vector<bool> &points) const;

private:
  /** Points of a pair with the same nodes. */
  struct Group
  {
    unsigned int pair, first_point, n_points, first_node, n_nodes, first_weight;
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

  /** Finds the local places of the nodes' unknowns in vectors like u. */
  void find_places(const Vector &u);
  /** The nodes' unknowns of a group, then the free components of its rigid sides. */
  std::vector<DofIndex> unknowns(const Group &group) const;
  void add_rigid_couplings(const Group &group, const unsigned int point, const double *weight,
                           const dealii::Tensor<2, dim> &stiffness,
                           dealii::FullMatrix<double>   &block) const;

  std::vector<RigidPartner>           rigid_partners;
  std::vector<std::vector<RigidSide>> rigid_sides; //!< of each pair
  std::vector<unsigned int>           pair_of_point;
  /** Of the rigid ones of the bodies a and b of each point; empty without rigid bodies. */
  std::vector<std::array<RigidFoot, 2>> rigid_feet;
  std::vector<Group>                    groups;
  std::vector<DofIndex>                 group_nodes;
  std::vector<double>                   group_sides;     //!< of each node
  std::vector<double>                   stencil_weights; //!< per point, the nodes of its group
  std::optional<Epetra_BlockMap>        map_of_places;   //!< of the vectors that they are for
  std::vector<int>                      places;          //!< of the unknowns of group_nodes
};
} // namespace scree
