#pragma once

#include <scree/base/sparse_rows.h>
#include <scree/solver/linear_solver.h>
#include <scree/solver/mumps.h>

#include <Epetra_CrsMatrix.h>

namespace scree
{
/**
 * Solves (K + B^T E B) x = b for many E and b with one factorisation (Sherman, Morrison, Woodbury):
 * with the compliance C = B K^{-1} B^T of the rows of B,
 *
 *     (I + C E) z = B K^{-1} b,    x = K^{-1} (b - B^T E z),
 *
 * where z = B x. C comes as the Schur complement of [K B^T; B 0], at the price of one
 * factorisation (Mumps). E is block diagonal; rows where it vanishes leave the dense system, which
 * is solved on process 0.
 */
class CondensedSolver
{
public:
  using Vector = LinearSolver::Vector;
  using Matrix = LinearSolver::Matrix;

  /** Factorises. @param symmetric K is symmetric */
  CondensedSolver(const Matrix &K, const SparseRows &B, const bool symmetric);

  /** Factorises another K with the same graph. */
  void update(const Matrix &K);

  /**
   * Whether dense systems have cost more operations since the last factorisation than it did, so
   * that a K nearer to the present matrix pays.
   */
  bool is_worth_updating() const
  {
    return dense_operations > mumps->operations();
  }

  /**
   * @param E blocks of `block` x `block` numbers, row by row, for the rows of B on this process
   * @return method "condensed" with the relative residual
   * @throws LinearSolverFailure if the matrix is singular to working precision
   */
  LinearSolveResult solve(const std::vector<double> &E, const unsigned int block, Vector &x,
                          const Vector &b);

private:
  MatrixEntries entries() const;
  void add_solution(const std::vector<double> &E, const unsigned int block, const Vector &r,
                    Vector &x);
  std::vector<double> solve_dense(const std::vector<double> &E, const unsigned int block,
                                  const std::vector<double> &y);
  void residual(const std::vector<double> &E, const unsigned int block, const Vector &x,
                const Vector &b, Vector &r) const;

  Matrix                            K;
  SparseRows                        rows; //!< of B, on this process
  bool                              symmetric;
  MPI_Comm                          communicator;
  std::unique_ptr<Epetra_CrsMatrix> B;
  std::unique_ptr<Mumps>            mumps;
  double dense_operations = 0.; //!< since the last factorisation, on all processes
};
} // namespace scree
