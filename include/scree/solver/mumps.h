#pragma once

#include <memory>
#include <mpi.h>
#include <string>
#include <vector>

class Epetra_CrsMatrix;
class Epetra_Vector;

namespace scree
{
/** Entries of a sparse matrix on this process, global indices from 0; equal positions add up. */
struct MatrixEntries
{
  std::vector<int>    rows, columns;
  std::vector<double> values;
};

/**
 * The entries of the rows of this process, of the lower triangle only if `symmetric`. The order
 * depends on the graph alone.
 */
MatrixEntries matrix_entries(const Epetra_CrsMatrix &A, const bool symmetric);

/** The numbers of all processes, one after the other, on process 0 (collective). */
std::vector<double> gather_to_root(const std::vector<double> &mine, const MPI_Comm communicator);

/** The same for a vector whose processes own ranges in their order. */
std::vector<double> gather_to_root(const Epetra_Vector &x);

/** Adds the numbers of process 0 to a vector distributed like that. */
void add_from_root(const std::vector<double> &values, Epetra_Vector &x);

/**
 * The multifrontal direct solver MUMPS (Amestoy, Duff, Koster, L'Excellent, SIAM J. Matrix Anal.
 * Appl. 23, 2001) on the processes of a communicator. Right-hand sides and solutions live on
 * process 0. It prints nothing; all functions are collective and throw LinearSolverFailure on all
 * processes.
 */
class Mumps
{
public:
  /**
   * Analyses the pattern of an n x n matrix.
   *
   * @param symmetric the matrix is symmetric and only one triangle is given; half the work
   * @param entries   of this process
   * @param kept      rows s of a Schur complement, the same on all processes; may be empty
   */
  Mumps(const int n, const bool symmetric, const MatrixEntries &entries,
        const std::vector<int> &kept, const MPI_Comm communicator);

  ~Mumps();

  Mumps(const Mumps &)            = delete;
  Mumps &operator=(const Mumps &) = delete;

  /** Factorises the matrix (all but the kept rows) with these values, in the order of the entries.
   */
  void factorise(const std::vector<double> &values);

  /** Floating-point operations of the last factorisation. */
  double operations() const;

  /** Negative pivots of the last factorisation of a symmetric matrix: its negative eigenvalues. */
  int n_negative_pivots() const;

  /** Solves for the columns of `right` (process 0: n numbers each) in place. No kept rows. */
  void solve(std::vector<double> &right) const;

  /**
   * The Schur complement `S = A_ss - A_si A_ii^{-1} A_is` of the kept rows, row by row on process
   * 0.
   */
  const std::vector<double> &schur_complement() const
  {
    return schur;
  }

  /**
   * First half of a solution with kept rows: `b_s - A_si A_ii^{-1} b_i`, on process 0. Keeps what
   * expand() needs.
   */
  std::vector<double> condense(const std::vector<double> &right) const;

  /** Second half: x from x_s and the right-hand side of the last condense(), on process 0. */
  std::vector<double> expand(const std::vector<double> &x_of_kept) const;

private:
  struct Instance;

  void run(const int job, const char *what) const;

  std::unique_ptr<Instance>   instance;
  std::vector<int>            rows, columns, kept_rows; // from 1
  mutable std::vector<double> right_hand_side, reduced;
  std::vector<double>         matrix_values, schur;
};
} // namespace scree
