#include <scree/solver/linear_solver.h>
#include <scree/solver/multigrid.h>
#include <scree/solver/mumps.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <Amesos.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace scree
{
using namespace dealii;

namespace
{
/** KLU is as fast as MUMPS on one process up to about this many unknowns (elasticity in 2D). */
constexpr unsigned int klu_up_to = 1000;

/** Estimated condition numbers (of the matrix with scaled rows) above this mean "singular". */
constexpr double singular_condition = 1e14;

/** A direct solution with a larger |b - A x| / |b| is not accepted. */
constexpr double direct_residual_limit = 1e-3;

/** Basis vectors of GMRES before a restart. */
constexpr unsigned int gmres_basis = 150;

/** MUMPS analyses all entries if that is at most this times as many as those that are not zero. */
constexpr double few_zeros = 1.25;

/** It analyses anew if more of the analysed entries are zero. */
constexpr double most_zeros = 1.5;

/** Keeps those of the values whose flag is set. */
template <typename Number>
void
keep(const std::vector<bool> &flags, std::vector<Number> &values)
{
  std::size_t n = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (flags[i])
      values[n++] = values[i];
  values.resize(n);
}

const EnumNames<LinearSolverType> type_names = {{LinearSolverType::automatic, "automatic"},
                                                {LinearSolverType::direct, "direct"},
                                                {LinearSolverType::iterative, "iterative"}};

const EnumNames<MultigridSmoother> smoother_names = {{MultigridSmoother::automatic, "automatic"},
                                                     {MultigridSmoother::chebyshev, "Chebyshev"},
                                                     {MultigridSmoother::ilu, "ILU"}};

const EnumNames<DirectPackage> package_names = {{DirectPackage::automatic, "automatic"},
                                                {DirectPackage::mumps, "MUMPS"},
                                                {DirectPackage::klu, "KLU"}};

const EnumNames<KrylovMethod> krylov_names = {{KrylovMethod::automatic, "automatic"},
                                              {KrylovMethod::cg, "CG"},
                                              {KrylovMethod::gmres, "GMRES"}};

template <typename... Parts>
[[noreturn]] void
fail(const Parts &...parts)
{
  std::ostringstream message;
  message.precision(3);
  (message << ... << parts);
  throw LinearSolverFailure(message.str());
}

/** |b - A x|_2 / |b|_2 for b != 0. */
double
relative_residual(const LinearSolver::Matrix &A, const LinearSolver::Vector &x,
                  const LinearSolver::Vector &b)
{
  LinearSolver::Vector r(b);
  return A.residual(r, x, b) / b.l2_norm();
}

/** A number with 1/2 <= |s| <= 3/2 that looks random but depends on the index alone. */
double
scattered(const int index)
{
  std::uint32_t bits = static_cast<std::uint32_t>(index) * 2654435761u;
  bits ^= bits >> 15;
  bits *= 2246822519u;
  bits ^= bits >> 13;
  const double size = 0.5 + (bits & 0xffffu) / 65536.;
  return bits & 0x10000u ? size : -size;
}

DirectPackage
chosen_package(const DirectPackage wanted, const LinearSolver::Matrix &A)
{
  if (wanted != DirectPackage::automatic)
    return wanted;
  const bool serial = A.trilinos_matrix().Comm().NumProc() == 1;
  return serial && A.m() <= klu_up_to ? DirectPackage::klu : DirectPackage::mumps;
}
} // namespace

void
LinearSolverParameters::declare(const ParameterSection &section)
{
  section.entry("Type", type, type_names,
                "direct, iterative, or automatic: direct up to the numbers of unknowns below.");
  section.entry(
    "Direct up to (2D)", direct_up_to_2d,
    "Unknowns of the largest body, or a tenth of all, up to which automatic means direct in two "
    "dimensions.");
  section.entry(
    "Direct up to (3D)", direct_up_to_3d,
    "The same in three dimensions, of all a twentieth; six times as many of degree 2, whose "
    "multigrid is slow.");
  section.entry("Direct package", direct_package, package_names,
                "Direct solver. automatic: KLU for small systems on one process, else MUMPS.");
  section.entry(
    "Condense up to", condense_up_to,
    "Contact points times dimension up to which direct systems are condensed to them: one "
    "factorisation serves all iterations and steps. 0: never.");
  section.entry("Iterative method", krylov_method, krylov_names,
                "CG is for symmetric matrices only. automatic: CG for symmetric matrices, GMRES "
                "with friction.");
  section.entry("Tolerance", tolerance, Patterns::Double(1e-15, 0.1),
                "Iterative: the residual relative to the right-hand side [-].");
  section.entry("Maximum iterations", max_iterations, Patterns::Integer(1),
                "Iterative: more iterations than this are a failure.");
  const ParameterSection amg
    = section.subsection("Multigrid", "The preconditioner, algebraic multigrid by ML.");
  amg.entry("Smoother", amg_smoother, smoother_names,
            "automatic: Chebyshev for degree 1, ILU(1) for degree 2, whose thin cuts Chebyshev "
            "smooths badly.");
  amg.entry("Smoother sweeps", amg_smoother_sweeps, Patterns::Integer(1),
            "Degree of the Chebyshev smoother.");
  amg.entry("Aggregation threshold", amg_aggregation_threshold, Patterns::Double(0., 1.),
            "Couplings that are weaker than this are dropped in the aggregation [-].");
}

/**
 * A direct solver with its symbolic factorisation: KLU through Amesos, on a matrix of its own,
 * which shares the graph of the user's one, since Amesos needs the matrix as long as it lives
 * itself; or MUMPS.
 */
class LinearSolver::Factorisation
{
public:
  Factorisation(const Epetra_CrsMatrix &A, const DirectPackage package, const bool symmetric);

  /** Whether A has the graph (the same object) that was analysed. */
  bool fits(const Epetra_CrsMatrix &A, const DirectPackage package, const bool symmetric) const
  {
    return A.Graph().DataPtr() == matrix.Graph().DataPtr() && package == this->package
           && (package == DirectPackage::klu || symmetric == this->symmetric);
  }

  /** Takes over the values of A. */
  void update(const Epetra_CrsMatrix &A);

  /** Factorises and solves; throws LinearSolverFailure. */
  void solve(Epetra_Vector &x, const Epetra_Vector &b);

private:
  void solve_with_klu(Epetra_MultiVector &left, Epetra_MultiVector &right);

  /**
   * Makes `mumps` for the entries that are not zero, unless it serves them: contact that is open
   * couples bodies by zeros, with which the factors of many bodies fill.
   */
  void analyse(const MatrixEntries &all);

  void solve_with_mumps(Epetra_MultiVector &left, const Epetra_MultiVector &right);

  /** The smallest of the return codes on all processes. */
  int agreed(const int code) const
  {
    int mine = code, smallest = code;
    matrix.Comm().MinAll(&mine, &smallest, 1);
    return smallest;
  }

  Epetra_CrsMatrix                   matrix;
  DirectPackage                      package;
  bool                               symmetric;
  const std::string                 &name;
  Epetra_LinearProblem               problem;
  std::unique_ptr<Amesos_BaseSolver> klu;
  std::unique_ptr<Mumps>             mumps;
  std::vector<bool>                  is_analysed; //!< by it, of the entries of this process
};

LinearSolver::Factorisation::Factorisation(const Epetra_CrsMatrix &A, const DirectPackage package,
                                           const bool symmetric)
    : matrix(A)
    , package(package)
    , symmetric(symmetric)
    , name(name_of(package_names, package))
{
  problem.SetOperator(&matrix);
}

void
LinearSolver::Factorisation::update(const Epetra_CrsMatrix &A)
{
  for (int row = 0; row < A.NumMyRows(); ++row)
    {
      int     n_from = 0, n_to = 0;
      double *from = nullptr, *to = nullptr;
      A.ExtractMyRowView(row, n_from, from);
      matrix.ExtractMyRowView(row, n_to, to);
      Assert(n_from == n_to, ExcInternalError());
      std::copy(from, from + n_from, to);
    }
}

void
LinearSolver::Factorisation::solve_with_klu(Epetra_MultiVector &left, Epetra_MultiVector &right)
{
  if (!klu)
    {
      klu.reset(Amesos().Create("Amesos_Klu", problem));
      AssertThrow(klu, ExcMessage("Trilinos was built without Amesos_Klu."));
      if (const int code = agreed(klu->SymbolicFactorization()))
        {
          klu.reset();
          fail(name, " cannot analyse the matrix (code ", code, ")");
        }
    }
  if (const int code = agreed(klu->NumericFactorization()))
    {
      klu.reset();
      fail(name, " cannot factorise the matrix (code ", code, "), it is singular");
    }
  problem.SetLHS(&left);
  problem.SetRHS(&right);
  const int code = agreed(klu->Solve());
  problem.SetLHS(nullptr);
  problem.SetRHS(nullptr);
  if (code != 0)
    fail(name, " cannot solve (code ", code, ")");
}

void
LinearSolver::Factorisation::analyse(const MatrixEntries &all)
{
  // Of all processes: entries, those that are not zero, analysed, and not zero but not analysed.
  std::vector<bool>        is_needed(all.values.size());
  std::array<long long, 4> mine = {{static_cast<long long>(is_needed.size()), 0, 0, 0}}, n;
  for (std::size_t i = 0; i < is_needed.size(); ++i)
    {
      is_needed[i] = all.values[i] != 0. || all.rows[i] == all.columns[i];
      mine[1] += is_needed[i];
      mine[2] += mumps && is_analysed[i];
      mine[3] += mumps && is_needed[i] && !is_analysed[i];
    }
  matrix.Comm().SumAll(mine.data(), n.data(), n.size());
  if (mumps && n[3] == 0 && n[2] <= most_zeros * n[1])
    return;
  if (n[0] <= few_zeros * n[1])
    is_needed.assign(is_needed.size(), true);
  is_analysed           = is_needed;
  MatrixEntries entries = all;
  keep(is_analysed, entries.rows);
  keep(is_analysed, entries.columns);
  mumps = std::make_unique<Mumps>(matrix.NumGlobalRows(), symmetric, entries, std::vector<int>(),
                                  dynamic_cast<const Epetra_MpiComm &>(matrix.Comm()).Comm());
}

void
LinearSolver::Factorisation::solve_with_mumps(Epetra_MultiVector       &left,
                                              const Epetra_MultiVector &right)
{
  MatrixEntries entries = matrix_entries(matrix, symmetric);
  analyse(entries);
  keep(is_analysed, entries.values);
  mumps->factorise(entries.values);
  std::vector<double> columns;
  for (int k = 0; k < right.NumVectors(); ++k)
    {
      const std::vector<double> column = gather_to_root(*right(k));
      columns.insert(columns.end(), column.begin(), column.end());
    }
  mumps->solve(columns);
  left.PutScalar(0.);
  for (int k = 0; k < left.NumVectors(); ++k)
    add_from_root(
      std::vector<double>(columns.begin() + k * columns.size() / left.NumVectors(),
                          columns.begin() + (k + 1) * columns.size() / left.NumVectors()),
      *left(k));
}

void
LinearSolver::Factorisation::solve(Epetra_Vector &x, const Epetra_Vector &b)
{
  // Column 0 is b, column 1 the right-hand side that reveals a singular matrix.
  const Epetra_Map  &rows = matrix.RowMap();
  Epetra_MultiVector right(rows, 2), left(rows, 2);
  Epetra_Vector      inverse_row_sums(rows);
  if (agreed(-matrix.InvRowSums(inverse_row_sums)) != 0)
    fail("the matrix is singular, it has a row of zeros");
  for (int i = 0; i < rows.NumMyElements(); ++i)
    {
      right[0][i] = b[i];
      right[1][i] = scattered(rows.GID(i)) / inverse_row_sums[i];
    }

  std::array<double, 2> norms;
  right.Norm2(norms.data());
  if (!std::isfinite(norms[1]))
    fail("the matrix is not finite");

  if (package == DirectPackage::klu)
    solve_with_klu(left, right);
  else
    solve_with_mumps(left, right);

  left.Norm2(norms.data());
  if (!std::isfinite(norms[0]) || !std::isfinite(norms[1]))
    fail("the matrix is singular, the solution is not finite (", name, ")");
  if (norms[1] > singular_condition)
    fail("the matrix is singular to working precision (", name, ", condition number about ",
         norms[1], ")");
  std::copy(left[0], left[0] + rows.NumMyElements(), x.Values());
}

LinearSolver::LinearSolver(const LinearSolverParameters &parameters, const unsigned int dimension,
                           const unsigned int degree)
    : parameters(parameters)
    , dimension(dimension)
    , degree(degree)
    , smooth_by_ilu(parameters.amg_smoother == MultigridSmoother::ilu
                    || (parameters.amg_smoother == MultigridSmoother::automatic && degree > 1))
{
}

LinearSolver::~LinearSolver() = default;

void
LinearSolver::set_near_null_space(const std::vector<Vector> &modes)
{
  near_null_space = modes;
}

void
LinearSolver::set_border(const unsigned int n_unknowns)
{
  n_border = n_unknowns;
}

void
LinearSolver::set_largest_body(const std::size_t n_unknowns)
{
  largest_body = n_unknowns;
}

bool
LinearSolver::is_direct(const std::size_t n_unknowns) const
{
  const std::size_t many = dimension == 2 ? 10 : 20;
  const std::size_t size
    = largest_body == 0 ? n_unknowns : std::max(largest_body, n_unknowns / many);
  if (parameters.type != LinearSolverType::automatic)
    return parameters.type == LinearSolverType::direct;
  const std::size_t up_to_3d = (degree == 1 ? 1 : 6) * std::size_t(parameters.direct_up_to_3d);
  return size <= (dimension == 2 ? parameters.direct_up_to_2d : up_to_3d);
}

LinearSolveResult
LinearSolver::solve(const Matrix &A, Vector &x, const Vector &b, const bool symmetric,
                    const double tolerance)
{
  Timer        timer;
  const double norm = b.l2_norm();
  if (!std::isfinite(norm))
    fail("the right-hand side is not finite");

  const bool        automatic = parameters.type == LinearSolverType::automatic;
  LinearSolveResult result;
  if (is_direct(A.m()))
    result = solve_directly(A, x, b, symmetric);
  else
    try
      {
        result = solve_iteratively(A, x, b, symmetric, std::max(tolerance, parameters.tolerance));
      }
    catch (const LinearSolverFailure &)
      {
        if (!automatic)
          throw;
        result = solve_directly(A, x, b, symmetric);
      }
  result.seconds = timer.wall_time();
  return result;
}

LinearSolveResult
LinearSolver::solve_directly(const Matrix &A, Vector &x, const Vector &b, const bool symmetric)
{
  const DirectPackage     package = chosen_package(parameters.direct_package, A);
  const Epetra_CrsMatrix &matrix  = A.trilinos_matrix();
  if (!factorisation || !factorisation->fits(matrix, package, symmetric))
    factorisation = std::make_unique<Factorisation>(matrix, package, symmetric);
  else
    factorisation->update(matrix);
  factorisation->solve(*x.trilinos_vector()(0), *b.trilinos_vector()(0));

  LinearSolveResult result;
  result.method = name_of(package_names, package);
  if (b.l2_norm() > 0)
    result.relative_residual = relative_residual(A, x, b);
  if (!(result.relative_residual < direct_residual_limit))
    fail(result.method, " left a relative residual of ", result.relative_residual,
         ": the matrix is nearly singular");
  return result;
}

LinearSolveResult
LinearSolver::solve_iteratively(const Matrix &A, Vector &x, const Vector &b, const bool symmetric,
                                const double tolerance)
{
  const bool        cg = parameters.krylov_method == KrylovMethod::automatic
                           ? symmetric
                           : parameters.krylov_method == KrylovMethod::cg;
  LinearSolveResult result;
  result.method     = cg ? "CG+AMG" : "GMRES+AMG";
  x                 = 0;
  const double norm = b.l2_norm();
  if (norm == 0)
    return result;

  for (bool is_solved = false; !is_solved;)
    {
      const bool is_new = !multigrid || !multigrid->fits(A);
      if (is_new)
        multigrid = std::make_unique<Multigrid>(
          A, Multigrid::Settings{dimension, n_border, smooth_by_ilu, parameters}, near_null_space);
      SolverControl control(
        is_new ? parameters.max_iterations
               : std::min(parameters.max_iterations, multigrid->expected_iterations(tolerance)),
        tolerance * norm);
      try
        {
          if (cg)
            SolverCG<Vector>(control).solve(A, x, b, *multigrid);
          else
            // Preconditioned from the right, the iteration watches the true residual.
            SolverGMRES<Vector>(control, SolverGMRES<Vector>::AdditionalData(gmres_basis + 2, true))
              .solve(A, x, b, *multigrid);
          is_solved = true;
        }
      catch (const SolverControl::NoConvergence &)
        {
          if (is_new)
            fail(result.method, " did not converge in ", control.last_step(),
                 " iterations (relative residual ", control.last_value() / norm, ")");
        }
      catch (const std::exception &error)
        {
          if (is_new)
            fail(result.method, " failed: ", error.what());
          x = 0;
        }
      result.iterations += control.last_step();
      if (!is_solved
          || !multigrid->is_worth_keeping(control.last_step(), control.last_value() / norm))
        multigrid.reset();
    }
  result.relative_residual = relative_residual(A, x, b);
  if (!(result.relative_residual <= 100 * tolerance))
    fail(result.method, " ended with a relative residual of ", result.relative_residual);
  return result;
}
} // namespace scree
