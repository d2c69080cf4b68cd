#pragma once

#include <scree/mechanics/free_bodies.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/**
 * What holds single bodies in the tangent, K + sum_b s_b M_b, while Newton's method runs: M_b is
 * the artificial mass of the body b, beyond that of all. A body that others push and that nothing
 * stops moves as far as the small mass of all lets it, through its neighbours, and shortening
 * such a step delays all others: with s_b it goes a little way in each iteration, until it meets
 * something (a proximal point method, body by body; Rockafellar, SIAM J. Control Optim. 14, 1976,
 * 877-898). Holds never enter the residual.
 */
template <int dim>
class BodyHolds
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** `free` outlives it. No body is held. */
  explicit BodyHolds(const FreeBodies<dim> &free);

  /** No body is held. */
  void release();

  /** Whether any body is held. */
  bool are_any() const;

  /**
   * Raises s_b of bodies that `du` moves farther than 1.5 `length` and that neither supports nor
   * the contact of the last evaluation hold: to s max(10, |du_b| / length), s = s_b + s_0; |du_b|
   * is the largest component. If there are none, s_b falls to 0.3 s_b where |du_b| < length/4, from
   * s_0 to 0 (collective).
   *
   * @param of_all s_0, the factor of the mass of all
   * @returns whether any was raised: K has changed
   */
  bool adapt(const Vector &du, const double length, const double of_all);

  /** matrix += sum_b s_b M_b. @param mass the diagonal of all M_b */
  void add_to(const Vector &mass, Matrix &matrix) const;

private:
  const FreeBodies<dim> &free;
  std::vector<double>    factors; //!< s_b, by free body
};
} // namespace scree
