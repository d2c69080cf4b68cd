#pragma once

#include <scree/base/enum_names.h>
#include <scree/parameters/section.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree
{
class Multigrid;

/** A linear system that could not be solved: singular, not finite, or no convergence. */
class LinearSolverFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** How to solve: by size, or as told. */
enum class LinearSolverType
{
  automatic,
  direct,
  iterative
};

/** The direct solver: by size, or as told. */
enum class DirectPackage
{
  automatic,
  mumps,
  klu
};

/** The Krylov method: by the symmetry of the matrix, or as told. */
enum class KrylovMethod
{
  automatic,
  cg,
  gmres
};

/** The smoother of the multigrid: by the degree of the unknowns, or as told. */
enum class MultigridSmoother
{
  automatic,
  chebyshev,
  ilu
};

/** What a parameter file says about the linear solver. */
struct LinearSolverParameters
{
  LinearSolverType type = LinearSolverType::automatic;

  /** Unknowns of the largest body, or a tenth of all (in three dimensions a twentieth), up to which
   * `automatic` solves directly in two and in three dimensions, there six times as many of degree
   * 2, whose multigrid is slow. */
  unsigned int direct_up_to_2d = 300000;
  unsigned int direct_up_to_3d = 10000;

  DirectPackage direct_package = DirectPackage::automatic;

  /** Rows of contact (points times dimension) up to which a direct solver condenses to them. */
  unsigned int condense_up_to = 3000;

  KrylovMethod krylov_method = KrylovMethod::automatic;

  /** The iteration ends at |b - A x|_2 <= tolerance |b|_2; 0 < tolerance < 1. */
  double tolerance = 1e-10;

  unsigned int max_iterations = 1000;

  MultigridSmoother amg_smoother = MultigridSmoother::automatic;

  /** Sweeps of the Chebyshev smoother, before and after each coarse correction. */
  unsigned int amg_smoother_sweeps = 2;

  /** Couplings below this (relative to the diagonals) are dropped in the aggregation; >= 0. */
  double amg_aggregation_threshold = 0;

  /** Reads the entries of the section and records what is not allowed. */
  void declare(const ParameterSection &section);
};

/** How a system was solved. */
struct LinearSolveResult
{
  /** "KLU", "MUMPS", "CG+AMG" or "GMRES+AMG". */
  std::string method;

  /** Krylov iterations, 0 for a direct solver. */
  unsigned int iterations = 0;

  /** |b - A x|_2 / |b|_2, computed from the solution; 0 if b = 0. */
  double relative_residual = 0;

  /** Wall time on this process. */
  double seconds = 0;
};

/**
 * Solves A x = b, on any number of processes, directly (Amesos with KLU or MUMPS) or by CG or
 * GMRES with smoothed aggregation (ML).
 *
 * `automatic` takes a direct solver up to a size that depends on the dimension, and beyond it CG
 * for symmetric and GMRES for other matrices; if that does not converge, the direct one. Among the
 * direct ones KLU takes small matrices on one process, MUMPS all others.
 *
 * The multigrid hierarchy is kept, with a copy of its matrix, as long as the iterations per digit
 * stay below 1.5 times those right after it was built.
 *
 * A direct solver keeps a copy of the matrix and its symbolic factorisation; the latter is used
 * again as long as the matrices come with the same graph object, that is, until the matrix is
 * initialised with a new sparsity pattern.
 *
 * Singular matrices are recognised by a second right-hand side w_i = s_i sum_j |a_ij| with
 * scattered numbers s_i of size 1: since the rows of A divided by their sums have the norm 1, the
 * |y|_2 of A y = w estimates the condition number of that scaled matrix, which does not depend on
 * units.
 */
class LinearSolver
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /**
   * @param dimension number of unknowns per node, 2 or 3: chooses the thresholds and the AMG
   * @param degree of the basis: chooses the smoother
   */
  LinearSolver(const LinearSolverParameters &parameters, const unsigned int dimension,
               const unsigned int degree = 1);

  ~LinearSolver();

  LinearSolver(const LinearSolver &)            = delete;
  LinearSolver &operator=(const LinearSolver &) = delete;

  /**
   * The modes that hardly cost energy (rigid motions, per body) for the AMG, distributed as the
   * rows of the matrix. They are copied and kept until replaced. Without modes the `dimension`
   * translations are used, for unknowns that are numbered node by node.
   */
  void set_near_null_space(const std::vector<Vector> &modes);

  /** Whether a system of this size is to be solved directly, condensed to its rows of contact. */
  bool condenses(const std::size_t n_unknowns, const std::size_t n_contact_rows) const
  {
    return is_direct(n_unknowns) && n_contact_rows > 0
           && n_contact_rows <= parameters.condense_up_to;
  }

  /**
   * The last unknowns that belong to no node, as those of rigid bodies and multipliers: the AMG
   * does not see them, see BorderedPreconditioner.
   */
  void set_border(const unsigned int n_unknowns);

  /** Unknowns of the largest body: contact couples bodies at few of them, so that factors and their
   * cost grow with the bodies, not with their number. */
  void set_largest_body(const std::size_t n_unknowns);

  /**
   * Solves A x = b. `x` must be distributed as the rows of the matrix; its content does not matter.
   *
   * @param symmetric whether A is symmetric positive definite, so that CG may be used
   * @param tolerance what an iterative solver is asked for, |b - A x| <= tolerance |b|, if that is
   *                  looser than its parameter
   * @throws LinearSolverFailure (on all processes) if A is singular to working precision, the
   *         solution is not finite, or the iteration does not converge
   */
  LinearSolveResult solve(const Matrix &A, Vector &x, const Vector &b, const bool symmetric,
                          const double tolerance = 0.);

private:
  class Factorisation;

  bool is_direct(const std::size_t n_unknowns) const;

  LinearSolveResult solve_directly(const Matrix &A, Vector &x, const Vector &b,
                                   const bool symmetric);

  LinearSolveResult solve_iteratively(const Matrix &A, Vector &x, const Vector &b,
                                      const bool symmetric, const double tolerance);

  LinearSolverParameters         parameters;
  unsigned int                   dimension;
  unsigned int                   degree;
  bool                           smooth_by_ilu;
  unsigned int                   n_border     = 0;
  std::size_t                    largest_body = 0; //!< its unknowns; 0: not told
  std::vector<Vector>            near_null_space;
  std::unique_ptr<Factorisation> factorisation;
  std::unique_ptr<Multigrid>     multigrid;
};
} // namespace scree
