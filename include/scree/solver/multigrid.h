#pragma once

#include <scree/solver/linear_solver.h>

#include <deal.II/lac/trilinos_precondition.h>

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

  /**
   * @param modes near null space, distributed as the rows of A; none: the translations of unknowns
   *              that are numbered node by node
   * @param smooth_by_ilu ILU(1) instead of Chebyshev
   */
  Multigrid(const Matrix &A, const std::vector<Vector> &modes, const unsigned int dimension,
            const LinearSolverParameters &parameters, const bool smooth_by_ilu);

  /** Whether A has the graph (the same object) of the matrix it was built for. */
  bool fits(const Matrix &A) const;

  const dealii::TrilinosWrappers::PreconditionAMG &preconditioner() const
  {
    return amg;
  }

  /** Iterations to a relative tolerance that a hierarchy worth keeping needs; the first are free.
   */
  unsigned int expected_iterations(const double tolerance) const;

  /**
   * Whether `iterations` to a relative residual are at most 1.5 times as many per digit as in the
   * first call, the one right after it was built.
   */
  bool is_worth_keeping(const unsigned int iterations, const double relative_residual);

private:
  Matrix                                    matrix;
  dealii::TrilinosWrappers::PreconditionAMG amg;
  double iterations_per_digit = 0.; //!< when new; 0: not yet known
};
} // namespace scree
