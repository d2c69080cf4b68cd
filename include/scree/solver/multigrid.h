#pragma once

#include <scree/solver/bordered_preconditioner.h>
#include <scree/solver/linear_solver.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsGraph.h>

namespace scree
{
/**
 * Algebraic multigrid by smoothed aggregation (ML; Vanek, Mandel, Brezina, Computing 56, 1996) as a
 * preconditioner that may serve several matrices with the same graph: it keeps a copy of the one it
 * was built for.
 */
class Multigrid
{
public:
  using Vector = LinearSolver::Vector;
  using Matrix = LinearSolver::Matrix;

  struct Settings
  {
    unsigned int           dimension;
    unsigned int           n_border; //!< last rows that are not local, see BorderedPreconditioner
    bool                   smooth_by_ilu; //!< instead of Chebyshev
    LinearSolverParameters parameters;
  };

  /**
   * @param modes near null space, distributed as the rows of A; none: the translations of unknowns
   *              that are numbered node by node
   */
  Multigrid(const Matrix &A, const Settings &settings, const std::vector<Vector> &modes);

  /** Whether A has the graph (the same object) of the matrix it was built for. */
  bool fits(const Matrix &A) const;

  void vmult(Vector &dst, const Vector &src) const;

  /** Iterations to a relative tolerance that a hierarchy worth keeping needs; the first are free.
   */
  unsigned int expected_iterations(const double tolerance) const;

  /**
   * Whether `iterations` to a relative residual are at most 1.5 times as many per digit as in the
   * first call, the one right after it was built.
   */
  bool is_worth_keeping(const unsigned int iterations, const double relative_residual);

private:
  void initialize(const Epetra_CrsMatrix &A, const Settings &settings,
                  const std::vector<Vector> &modes);

  Epetra_CrsGraph                           graph;
  std::unique_ptr<Epetra_CrsMatrix>         matrix;   //!< without border
  std::unique_ptr<BorderedPreconditioner>   bordered; //!< holds its own part of the matrix
  dealii::TrilinosWrappers::PreconditionAMG amg;
  double iterations_per_digit = 0.; //!< when new; 0: not yet known
};
} // namespace scree
