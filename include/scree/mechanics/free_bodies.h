#pragma once

#include <scree/contact/contact_points.h>
#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/rigid_motion.h>
#include <scree/mechanics/strong_supports.h>

#include <functional>
#include <string>
#include <vector>

namespace scree
{
/** How a body is held before contact: rigid motions that nothing but contact resists. */
struct FreeMotion
{
  unsigned int body;
  unsigned int n_free; //!< number of free rigid motions
};

/** A motion of a free body as a whole. */
template <int dim>
struct LooseMotion
{
  unsigned int           body;
  double                 size;      //!< largest displacement over the body's box, of 1 for all [-]
  bool                   turns;     //!< a rotation, else a translation
  dealii::Point<dim>     centre;    //!< of the rotation [L]
  dealii::Tensor<1, dim> direction; //!< of the translation; in 3D the axis of the rotation
  double                 sense;     //!< of the rotation in 2D: 1 counter-clockwise, -1 clockwise

  /** "moves along (1, 0)", "turns about (0.5, 0)". */
  std::string in_words() const;
};

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

  FreeBodies(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
             const StrongSupports<dim> &supports, const BoundaryTerms<dim> &boundary_terms,
             const ContactPoints<dim> &contact);

  /** Bodies that supports alone do not hold. */
  const std::vector<FreeMotion> &motions() const
  {
    return free_motions;
  }

  /**
   * Motions that the contact of the last evaluation does not resist: the null space of the sum of
   * the outer products of what closed points feel of the coordinates, along the normal and, where
   * they stick, along the tangents; pairs count alike (collective).
   */
  std::vector<Coordinates> not_resisted() const;

  /** The free bodies that take part in such a motion (collective). */
  std::vector<unsigned int> not_held() const;

  /**
   * Resultants of forces: what they do on the coordinates (collective).
   * @param forces by unknown, without ghosts
   */
  Coordinates resultants(const dealii::TrilinosWrappers::MPI::Vector &forces) const;

  /**
   * What of resultants no contact can balance: pressures >= 0 and friction within Coulomb's cone
   * (in 3D a pyramid around it) at all contact points, of pairs that touch at those with gaps up to
   * h/4. Not zero: there is no
   * equilibrium, and the result is a motion that no contact resists and the forces drive (Farkas'
   * lemma, see unbalanced_part()). Collective.
   */
  Coordinates unbalanced(const Coordinates &resultants) const;

  /**
   * How the bodies that are not held fall as rigid ones until contact stops them: with their
   * resultants f_b, weights |f_b| and the gaps g_i of the last evaluation, the motion q that
   *
   *     minimises sum_b |f_b| |q_b - D f_b/|f_b||^2   under   max(g_i, 0) + (n.[[q]])_i >= 0,
   *
   * D three times the sum of their gaps: everything falls far enough to meet something, what
   * nothing stops does not go far. Empty: no such body is away from all others (collective).
   *
   * @param evaluate evaluates the contact after a motion: what its gaps are then corrects n.[[q]]
   */
  Coordinates settling(const Coordinates                              &resultants,
                       const std::function<void(const Coordinates &)> &evaluate) const;

  /** Adds a motion to the displacement (without ghosts). */
  void add(const Coordinates &motion, dealii::TrilinosWrappers::MPI::Vector &u) const;

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

  static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  /** Sums of m(x) m(x)^T over the supports of all bodies. */
  std::vector<dealii::FullMatrix<double>>
       resistance_of_supports(const std::vector<Motions> &motions) const;
  void find_unknowns(const Fields<dim> &fields);
  /** What coordinate k of a free body does to its unknown j. */
  double along(const unsigned int free_body, const unsigned int j, const unsigned int k) const;
  /** The q nearest to `wanted` with room + columns q >= 0; empty: there is none (collective). */
  Coordinates least_motion(const Coordinates &columns, const Coordinates &room,
                           const Coordinates &weight, const Coordinates &wanted) const;
  /** Smallest gap around each free body, 0 if it touches. */
  std::vector<double> gaps() const;
  /** Appends what the coordinates do to the relative motion at a contact point along `direction`.
   */
  void append_column(const ContactPoint<dim> &point, const dealii::Tensor<1, dim> &direction,
                     Coordinates &columns) const;

  const std::vector<Body<dim>> &bodies;
  const StrongSupports<dim>    &supports;
  const BoundaryTerms<dim>     &boundary_terms;
  const ContactPoints<dim>     &contact;
  MPI_Comm                      communicator;
  std::vector<FreeMotion>       free_motions;
  // Of the free bodies.
  std::vector<Motions>                         rigid_motions;
  std::vector<dealii::FullMatrix<double>>      bases; //!< columns: free motions in the rigid ones
  std::vector<unsigned int>                    first; //!< coordinate
  std::vector<std::vector<DofIndex>>           free_unknowns;
  std::vector<std::vector<dealii::Point<dim>>> positions;       //!< where these unknowns are
  std::vector<std::vector<unsigned int>>       free_components; //!< of the displacement or pose
  std::vector<unsigned int>                    number_of; //!< of each body among the free ones
  unsigned int                                 n_coordinates = 0;
};
} // namespace scree
