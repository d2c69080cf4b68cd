#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <memory>
#include <vector>

namespace scree
{
/**
 * A preconditioner for a matrix with a few last rows and columns that are not local, as those of
 * rigid bodies and multipliers:
 *
 *     A = [K C; D S],   W = K^ C,   S^ = S - D W
 *     P (r, s):   y = K^ r,   z = S^^-1 (s - D y),   x = y - W z
 *
 * with a preconditioner K^ of K^-1, such as multigrid, that need not know about the border. It is
 * exact if K^ is, and symmetric if A and K^ are. The border rows belong to the last process.
 */
class BorderedPreconditioner
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** @param n_border number of last rows of A; 0 < n_border */
  BorderedPreconditioner(const Epetra_CrsMatrix &A, const unsigned int n_border);

  /** K, a copy. */
  const Epetra_CrsMatrix &inner_matrix() const
  {
    return *K;
  }

  /** Sets K^ by its ApplyInverse(); it must live as long as this is used. */
  void set_inner(const Epetra_Operator &inner);

  void vmult(Vector &dst, const Vector &src) const;

private:
  void copy_inner(const Epetra_CrsMatrix &A);
  void copy_border(const Epetra_CrsMatrix &A);
  /** D_k . y for all k, over all processes. */
  std::vector<double> border_products(const double *y) const;

  unsigned int                        n_border;
  int                                 n_inner;       //!< rows of K, over all processes
  int                                 n_local_inner; //!< rows of K on this process
  std::unique_ptr<Epetra_CrsMatrix>   K;
  std::unique_ptr<Epetra_MultiVector> C, D, W; //!< D by rows
  dealii::FullMatrix<double>          S, inverse_schur;
  const Epetra_Operator              *inner = nullptr;
};
} // namespace scree
