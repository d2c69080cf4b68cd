#pragma once

#include <scree/contact/contact_points.h>
#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/free_motion.h>
#include <scree/mechanics/rigid_motion.h>
#include <scree/mechanics/strong_supports.h>

#include <deal.II/lac/sparsity_pattern.h>

#include <vector>

namespace scree
{
/**
 * Bodies that supports do not hold, and what contact does about their rigid motions. Contact
 * couples bodies, so that all motions are looked at together: the coordinates are those of the
 * rigid motions z that supports leave to each body (null space of the sum of m(x) m(x)^T over what
 * is supported), lengths scaled by the size of the body.
 */
template <int dim>
class FreeBodies
{
public:
  /** Of all free bodies, one after the other; rotations have the dimension of a length. */
  using Coordinates = std::vector<double>;
  using Vector      = dealii::TrilinosWrappers::MPI::Vector;

  /** See misplaced_moments(). */
  struct MisplacedMoments
  {
    Coordinates moments;     //!< empty: there are none
    double      factor = 1.; //!< they were scaled by
  };

  /** @param has_inertia there are none: inertia holds them */
  FreeBodies(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
             const StrongSupports<dim> &supports, const BoundaryTerms<dim> &boundary_terms,
             const ContactPoints<dim> &contact, const bool turns_finitely, const bool has_inertia);

  /** Bodies that supports alone do not hold. */
  const std::vector<FreeMotion> &motions() const
  {
    return free_motions;
  }

  /** Whether nothing but contact and inertia resists any motion of a body. */
  const std::vector<bool> &unsupported() const
  {
    return is_unsupported;
  }

  /**
   * Moments M on the free bodies that balance what forces do on motions that the contact of the
   * last evaluation resists only because it acts at points: Z^T M = Z^T F, Z the motions that it
   * resists by less than (h/2L)^2 of what a body's contacts do at most, L half the size of the
   * body. Contact points are up to half a spacing beside where contact should act, so that M of a
   * body is at most h/4 times the sum of the contact forces on it (1e-3 L on a fixed geometry,
   * h/2 = 2e-3 L in the other bound); larger ones are scaled down together (collective).
   *
   * @param share of that bound
   */
  MisplacedMoments misplaced_moments(const Coordinates &forces, const double share = 1.) const;

  /** Length of what acts on a free body. */
  double magnitude(const Coordinates &forces, const unsigned int free_body) const;

  /** Work of forces on a motion, of that of all their magnitudes over a cell. */
  double work(const Coordinates &forces, const Coordinates &motion) const;

  /** r -= M R (R^T M R)^-1 F, R the motions and M a diagonal mass: F acts no longer (collective).
   */
  void subtract(const Coordinates &forces, const Vector &mass, Vector &r) const;

  /** The free bodies with motions that the contact of the last evaluation does not resist
   * (collective). */
  std::vector<unsigned int> not_held() const;

  /** The largest component of `u`, without ghosts, on each free body (collective). */
  std::vector<double> largest_components(const Vector &u) const;

  /** Values above `limit` of free bodies that are not_held(), 0 of all others (collective). */
  std::vector<double> of_not_held(std::vector<double> values, const double limit) const;

  /**
   * Resultants of forces: what they do on the coordinates; zero where that is round-off, below
   * 1e-10 of the sum of magnitudes (collective).
   * @param forces by unknown, without ghosts
   */
  Coordinates resultants(const Vector &forces) const;

  /**
   * What of resultants no contact can balance: pressures >= 0 and friction within Coulomb's cone
   * (in 3D a pyramid around it) at all contact points, of pairs that touch at those with gaps up to
   * h/4. Not zero: there is no
   * equilibrium, and the result is a motion that no contact resists and the forces drive (Farkas'
   * lemma, see unbalanced_part()). Collective.
   */
  Coordinates unbalanced(const Coordinates &resultants) const;

  /**
   * How the free bodies move as rigid ones until contact and loads balance, from the jumps of the
   * last evaluation on: F_k = f_k + sum_i w_i c_ik . t_i([[u]]_i + sum_k c_ik q_k) = 0 with the
   * tractions t of the laws and the columns c_ik = d[[u]]_i/dq_k. Newton's method with steps of at
   * most a cell, (K + s M) dq = F with s as small as that allows and M the loads |f_b|, and a
   * search along dq for a zero of F . dq. Empty: every body is in balance to 1e-3 of what acts on
   * it (moments to what misplaced_moments() may hold), or nothing better was found (collective).
   *
   * @param loads resultants f of all forces but those of contact
   * @param negligible |F| that is round-off: nothing moves
   * @param is_settling on a moving geometry: s may become small, so that weakly resisted motions
   *                    go far. In a step they do not: gaps are linear in the motion there.
   */
  Coordinates balancing(const Coordinates &loads, const ContactHistory<dim> &history,
                        const double negligible, const bool is_settling) const;

  /**
   * Adds a motion to the displacement (without ghosts). On a moving geometry deformable bodies turn
   * without strain, from where `u` has brought them, unless they turn infinitesimally.
   */
  void add(const Coordinates &motion, Vector &u, const bool infinitesimally = false) const;

  /**
   * u without the infinitesimal rigid motions of deformable bodies that are nearest to u - u_0 in
   * the norm of the diagonal mass (collective).
   */
  Vector strained(const Vector &u, const Vector &u_0, const Vector &mass) const;

  /**
   * On a moving geometry, adds du to u, its rigid part, nearest in the norm of the diagonal mass,
   * as a finite motion: bodies turn without strain.
   */
  void advance(const Vector &du, const Vector &mass, Vector &u) const;

  /** The motions of the bodies that move at least a tenth as much as the one that moves most. */
  std::vector<LooseMotion<dim>> in_words(const Coordinates &motion) const;

  /** Whether any contact point lies between the body and another one (collective). */
  bool has_neighbours(const unsigned int body) const;

  /** Unknowns of the displacement or pose of a free body on this process. */
  const std::vector<DofIndex> &unknowns(const unsigned int free_body) const
  {
    return free_unknowns[free_body];
  }

private:
  using Motions = RigidMotions<dim>;
  struct Balance;
  struct Group;

  /** Orthonormal motions of some coordinates: columns. */
  struct JointMotions
  {
    std::vector<unsigned int>  coordinates;
    dealii::FullMatrix<double> vectors;
  };

  static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  /** Sums of m(x) m(x)^T over the supports of all bodies. */
  std::vector<dealii::FullMatrix<double>>
       resistance_of_supports(const std::vector<Motions> &motions) const;
  void find_unknowns(const DisplacementSpace<dim> &space);
  void find_start_motions(const DisplacementSpace<dim> &space);
  void find_couplings();
  /** What coordinate k of a free body does to a position. */
  dealii::Tensor<1, dim> motion(const unsigned int free_body, const unsigned int k,
                                const dealii::Point<dim> &x) const;
  /**
   * Of each pair the sum of the outer products of what its closed points feel of its coordinates,
   * along the normal and, where they stick, along the tangents, scaled to the trace 1, so that
   * pairs count alike; empty without closed points (collective).
   */
  std::vector<dealii::FullMatrix<double>> resistance_of_contact() const;
  /** Free bodies that closed pairs join. */
  std::vector<Group> groups(const std::vector<dealii::FullMatrix<double>> &of_pairs) const;
  /**
   * Motions that contact resists by no more than a part of what the closed pairs of a body do at
   * most, of each group: the null space of the sum of resistance_of_contact() (collective).
   */
  std::vector<JointMotions> not_resisted(const double negligible_part) const;
  /** Adds misplaced_moments() of a group, not scaled down yet. */
  void add_moments(const JointMotions &motions, const Coordinates &forces,
                   Coordinates &moments) const;
  /** P q: the rotations in a motion. */
  Coordinates rotations(const Coordinates &motion) const;
  /** Sums of the lengths of contact forces on the free bodies (collective). */
  std::vector<double> contact_on_bodies() const;
  /** Of the coordinates in balancing(): in all on a moving geometry, else in an iteration. */
  double longest_motion() const;
  /** Part of what acts on a free body that may be out of balance: contact acts at points. */
  double tolerance(const unsigned int free_body) const;
  /** What the coordinates of a free body do to its unknown j, from where u, the owned values, has
   * brought it; null: from the start of the step. */
  std::array<double, Motions::n_motions> motions_of(const unsigned int free_body,
                                                    const unsigned int j, const double *u) const;
  /** q of the R q nearest to du in the norm of the mass, R the motions_of() (collective). */
  Coordinates rigid_part(const Vector &du, const Vector &mass, const Vector *u) const;
  /** (R^T M R)^-1 of each free body, R its motions_of() (collective). */
  std::vector<dealii::FullMatrix<double>> inverse_masses(const Vector &mass, const Vector *u) const;
  /** Body by body. */
  Coordinates times(const std::vector<dealii::FullMatrix<double>> &matrices,
                    const Coordinates                             &coordinates) const;
  /** result += factor M R motion, R the motions_of(), M = 1 if null. */
  void add_small(const double factor, const Coordinates &motion, const Vector *u,
                 const Vector *mass, Vector &result) const;
  /** What the coordinates of the pair do to the relative motion at a point along `direction`. */
  void find_column(const ContactPoint<dim> &point, const dealii::Tensor<1, dim> &direction,
                   Coordinates &column) const;

  const std::vector<Body<dim>> &bodies;
  const StrongSupports<dim>    &supports;
  const BoundaryTerms<dim>     &boundary_terms;
  const ContactPoints<dim>     &contact;
  const bool                    turns_finitely;
  double                        cell_size = 0.; //!< largest of the contact points [L]
  MPI_Comm                      communicator;
  std::vector<FreeMotion>       free_motions;
  std::vector<bool>             is_unsupported; //!< each body
  // Of the free bodies.
  std::vector<Motions>                         rigid_motions;
  std::vector<dealii::FullMatrix<double>>      bases; //!< columns: free motions in the rigid ones
  std::vector<unsigned int>                    first; //!< coordinate
  std::vector<std::vector<DofIndex>>           free_unknowns;
  std::vector<std::vector<unsigned int>>       places; //!< of these unknowns among the owned ones
  std::vector<std::vector<dealii::Point<dim>>> positions;       //!< where these unknowns are
  std::vector<std::vector<unsigned int>>       free_components; //!< of the displacement or pose
  std::vector<std::vector<double>>             start_motions;   //!< motions_of() without u
  std::vector<unsigned int>                    number_of; //!< of each body among the free ones
  unsigned int                                 n_coordinates = 0;
  std::vector<std::vector<unsigned int>>       coordinates_of_pair; //!< of a, then of b
};
} // namespace scree
