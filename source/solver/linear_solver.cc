#include <scree/solver/linear_solver.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Amesos.h>
#include <Amesos_Mumps.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ml_MultiLevelPreconditioner.h>
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

/** Extra memory of MUMPS in percent of its own estimate, one after the other. */
constexpr std::array<int, 4> mumps_memory = {{40, 100, 300, 1000}};

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

/**
 * Smoothed aggregation with Chebyshev smoothers; `modes` are the near null space, none means the
 * translations of unknowns that are numbered node by node.
 */
void
initialize_amg(TrilinosWrappers::PreconditionAMG &amg, const LinearSolver::Matrix &A,
               const std::vector<LinearSolver::Vector> &modes, const unsigned int dimension,
               const LinearSolverParameters &parameters, const bool smooth_by_ilu)
{
  const Epetra_Map &rows = A.trilinos_matrix().RowMap();
  // ML needs whole nodes on every process.
  const bool whole_nodes = dealii::Utilities::MPI::min(
    rows.NumMyElements() % dimension == 0 ? 1 : 0, A.get_mpi_communicator());

  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  if (smooth_by_ilu)
    {
      list.set("smoother: type", "IFPACK");
      list.set("smoother: ifpack type", "ILU");
      list.set("smoother: ifpack level-of-fill", 1.);
    }
  else
    {
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", static_cast<int>(parameters.amg_smoother_sweeps));
    }
  list.set("coarse: type", "Amesos-KLU");
  list.set("coarse: max size", 2000);
  list.set("aggregation: threshold", parameters.amg_aggregation_threshold);
  list.set("PDE equations", whole_nodes ? static_cast<int>(dimension) : 1);

  Epetra_MultiVector null_space(rows, std::max<int>(1, modes.size()));
  for (unsigned int k = 0; k < modes.size(); ++k)
    std::copy(modes[k].begin(), modes[k].end(), null_space[k]);
  if (!modes.empty())
    {
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", static_cast<int>(modes.size()));
      list.set("null space: vectors", null_space.Values());
    }
  amg.initialize(A, list);
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
  section.entry("Direct up to (2D)", direct_up_to_2d,
                "Unknowns up to which automatic means direct in two dimensions.");
  section.entry("Direct up to (3D)", direct_up_to_3d,
                "Unknowns up to which automatic means direct in three dimensions.");
  section.entry("Direct package", direct_package, package_names,
                "Direct solver. automatic: KLU for small systems on one process, else MUMPS.");
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
 * An Amesos solver with its symbolic factorisation. It works on a matrix of its own, which shares
 * the graph of the user's one, since Amesos needs the matrix as long as it lives itself.
 */
class LinearSolver::Factorisation
{
public:
  Factorisation(const Epetra_CrsMatrix &A, const DirectPackage package);

  /** Whether A has the graph (the same object) that was analysed. */
  bool fits(const Epetra_CrsMatrix &A, const DirectPackage package) const
  {
    return A.Graph().DataPtr() == matrix.Graph().DataPtr() && package == this->package;
  }

  /** Takes over the values of A. */
  void update(const Epetra_CrsMatrix &A);

  /** Factorises and solves; throws LinearSolverFailure. */
  void solve(Epetra_Vector &x, const Epetra_Vector &b);

private:
  void factorise();

  /** The smallest of the return codes on all processes. */
  int agreed(const int code) const
  {
    int mine = code, smallest = code;
    matrix.Comm().MinAll(&mine, &smallest, 1);
    return smallest;
  }

  Epetra_CrsMatrix                   matrix;
  DirectPackage                      package;
  const std::string                 &name;
  Epetra_LinearProblem               problem;
  std::unique_ptr<Amesos_BaseSolver> solver;
  std::size_t                        memory = 0; // index into mumps_memory
};

LinearSolver::Factorisation::Factorisation(const Epetra_CrsMatrix &A, const DirectPackage package)
    : matrix(A)
    , package(package)
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
LinearSolver::Factorisation::factorise()
{
  for (;; ++memory)
    {
      if (!solver)
        {
          solver.reset(Amesos().Create(
            package == DirectPackage::klu ? "Amesos_Klu" : "Amesos_Mumps", problem));
          AssertThrow(solver, ExcMessage("Trilinos was built without Amesos_" + name + "."));
          if (auto *mumps = dynamic_cast<Amesos_Mumps *>(solver.get()))
            mumps->SetICNTL(14, mumps_memory[memory]);
          if (const int code = agreed(solver->SymbolicFactorization()))
            {
              solver.reset();
              fail(name, " cannot analyse the matrix (code ", code, ")");
            }
        }
      const int code = agreed(solver->NumericFactorization());
      if (code == 0)
        return;

      int mumps_code = 0;
      if (auto *mumps = dynamic_cast<Amesos_Mumps *>(solver.get()))
        mumps_code = agreed(matrix.Comm().MyPID() == 0 ? mumps->GetINFOG()[0] : 0);
      solver.reset();
      const bool out_of_memory = mumps_code == -8 || mumps_code == -9;
      if (!out_of_memory || memory + 1 == mumps_memory.size())
        fail(name, " cannot factorise the matrix (code ", mumps_code ? mumps_code : code,
             "), it is singular");
    }
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

  factorise();
  problem.SetLHS(&left);
  problem.SetRHS(&right);
  const int code = agreed(solver->Solve());
  problem.SetLHS(nullptr);
  problem.SetRHS(nullptr);
  if (code != 0)
    fail(name, " cannot solve (code ", code, ")");

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

LinearSolveResult
LinearSolver::solve(const Matrix &A, Vector &x, const Vector &b, const bool symmetric)
{
  Timer        timer;
  const double norm = b.l2_norm();
  if (!std::isfinite(norm))
    fail("the right-hand side is not finite");

  const unsigned int direct_up_to
    = dimension == 2 ? parameters.direct_up_to_2d : parameters.direct_up_to_3d;
  const bool automatic = parameters.type == LinearSolverType::automatic;

  LinearSolveResult result;
  if (parameters.type == LinearSolverType::direct || (automatic && A.m() <= direct_up_to))
    result = solve_directly(A, x, b);
  else
    try
      {
        result = solve_iteratively(A, x, b, symmetric);
      }
    catch (const LinearSolverFailure &)
      {
        if (!automatic)
          throw;
        result = solve_directly(A, x, b);
      }
  result.seconds = timer.wall_time();
  return result;
}

LinearSolveResult
LinearSolver::solve_directly(const Matrix &A, Vector &x, const Vector &b)
{
  const DirectPackage     package = chosen_package(parameters.direct_package, A);
  const Epetra_CrsMatrix &matrix  = A.trilinos_matrix();
  if (!factorisation || !factorisation->fits(matrix, package))
    factorisation = std::make_unique<Factorisation>(matrix, package);
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
LinearSolver::solve_iteratively(const Matrix &A, Vector &x, const Vector &b,
                                const bool symmetric) const
{
  const bool        cg = parameters.krylov_method == KrylovMethod::automatic
                           ? symmetric
                           : parameters.krylov_method == KrylovMethod::cg;
  LinearSolveResult result;
  result.method = cg ? "CG+AMG" : "GMRES+AMG";
  x             = 0;
  if (b.l2_norm() == 0)
    return result;

  for (const Vector &mode : near_null_space)
    AssertThrow(mode.locally_owned_elements() == b.locally_owned_elements(),
                ExcMessage("The near null space is not distributed as the rows of the matrix."));

  SolverControl control(parameters.max_iterations, parameters.tolerance * b.l2_norm());
  try
    {
      TrilinosWrappers::PreconditionAMG amg;
      initialize_amg(amg, A, near_null_space, dimension, parameters, smooth_by_ilu);
      if (cg)
        SolverCG<Vector>(control).solve(A, x, b, amg);
      else
        // Preconditioned from the right, the iteration watches the true residual.
        SolverGMRES<Vector>(control, SolverGMRES<Vector>::AdditionalData(gmres_basis + 2, true))
          .solve(A, x, b, amg);
    }
  catch (const SolverControl::NoConvergence &)
    {
      fail(result.method, " did not converge in ", control.last_step(),
           " iterations (relative residual ", control.last_value() / b.l2_norm(), ")");
    }
  catch (const std::exception &error)
    {
      fail(result.method, " failed: ", error.what());
    }
  result.iterations        = control.last_step();
  result.relative_residual = relative_residual(A, x, b);
  if (!(result.relative_residual <= 100 * parameters.tolerance))
    fail(result.method, " ended with a relative residual of ", result.relative_residual);
  return result;
}
} // namespace scree
