// All solvers agree on the matrix of plane strain elasticity, in serial and in parallel; singular
// matrices are recognised.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>
#include <scree/solver/linear_solver.h>

#include <cmath>
#include <limits>

#include "elastic_square.h"

namespace scree
{
namespace
{
using namespace test;

LinearSolverParameters
direct(const DirectPackage package)
{
  LinearSolverParameters parameters;
  parameters.type           = LinearSolverType::direct;
  parameters.direct_package = package;
  return parameters;
}

LinearSolverParameters
iterative(const KrylovMethod method)
{
  LinearSolverParameters parameters;
  parameters.type          = LinearSolverType::iterative;
  parameters.krylov_method = method;
  parameters.tolerance     = 1e-11;
  return parameters;
}

/** The work b . x of the solution, which does not depend on the numbering. */
double
work(Square &square, LinearSolver &solver, const std::string &method)
{
  const LinearSolveResult result = solver.solve(square.matrix, square.x, square.b, true);
  EXPECT_EQ(result.method, method);
  EXPECT_LE(result.relative_residual, 1e-10);
  EXPECT_EQ(result.iterations > 0, method.find("AMG") != std::string::npos);
  return square.b * square.x;
}

/** A matrix on one process from its rows. */
Matrix
dense(const std::vector<std::vector<double>> &rows)
{
  const unsigned int     n = rows.size();
  DynamicSparsityPattern pattern(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      pattern.add(i, j);
  Matrix matrix;
  matrix.reinit(complete_index_set(n), complete_index_set(n), pattern, MPI_COMM_SELF);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      matrix.set(i, j, rows[i][j]);
  matrix.compress(VectorOperation::insert);
  return matrix;
}

Vector
vector(const std::vector<double> &values)
{
  Vector v(complete_index_set(values.size()), MPI_COMM_SELF);
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

TEST(LinearSolver, ManyBodiesAreSolvedDirectly)
{
  LinearSolver solver(LinearSolverParameters(), 2);
  EXPECT_TRUE(solver.condenses(300000, 1));
  EXPECT_FALSE(solver.condenses(300001, 1));
  solver.set_largest_body(500);
  EXPECT_TRUE(solver.condenses(3000000, 1));
  EXPECT_FALSE(solver.condenses(3000010, 1));
  solver.set_largest_body(300001);
  EXPECT_FALSE(solver.condenses(300001, 1));
}

TEST(LinearSolver, AllSolversAgree)
{
  Square       square(5, true, MPI_COMM_SELF);
  LinearSolver klu(direct(DirectPackage::klu), 2), mumps(direct(DirectPackage::mumps), 2),
    cg(iterative(KrylovMethod::cg), 2), gmres(iterative(KrylovMethod::gmres), 2);
  const double expected = work(square, klu, "KLU");
  EXPECT_NEAR(work(square, mumps, "MUMPS") / expected, 1, 1e-12);
  EXPECT_NEAR(work(square, cg, "CG+AMG") / expected, 1, 1e-9);
  EXPECT_NEAR(work(square, gmres, "GMRES+AMG") / expected, 1, 1e-9);
}

TEST(LinearSolver, UnsymmetricMatrix)
{
  const Matrix A = dense({{4, 1, 0}, {-2, 5, 1}, {0, 3, 7}});
  const Vector b = vector({6, 11, 27}); // of x = (1, 2, 3)
  for (const auto &parameters : {direct(DirectPackage::klu), direct(DirectPackage::mumps),
                                 iterative(KrylovMethod::automatic)})
    {
      Vector       x = vector({7, 7, 7});
      LinearSolver solver(parameters, 2);
      solver.solve(A, x, b, false);
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(x(i), i + 1, 1e-9);
    }
}

TEST(LinearSolver, NewValuesAreFactorisedAgain)
{
  Square       square(3, true, MPI_COMM_SELF);
  const double expected = [&]() {
    LinearSolver klu(direct(DirectPackage::klu), 2);
    return work(square, klu, "KLU");
  }();
  for (const auto package : {DirectPackage::klu, DirectPackage::mumps})
    {
      LinearSolver      solver(direct(package), 2);
      const std::string name = package == DirectPackage::klu ? "KLU" : "MUMPS";
      for (unsigned int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(work(square, solver, name) / expected, std::pow(0.5, k), 1e-12);
          square.matrix *= 2;
        }
      square.matrix *= 0.125;
      // After a new pattern.
      Square finer(4, true, MPI_COMM_SELF);
      EXPECT_NEAR(work(finer, solver, name) / expected, 1, 0.05);
    }
}

TEST(LinearSolver, EntriesThatCeaseToBeZeroCount)
{
  // Tridiagonal, but for the corners: none, one triangle's and its mirror image, none again.
  const unsigned int n = 30;
  Vector             x(complete_index_set(n), MPI_COMM_SELF), b(x);
  b = 1.;
  for (const bool symmetric : {true, false})
    {
      std::vector<std::vector<double>> rows(n, std::vector<double>(n, 0.));
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          rows[i][j] = i == j ? 3. : std::max(i, j) - std::min(i, j) == 1 ? -1. : 0.;
      Matrix       matrix = dense(rows);
      LinearSolver solver(direct(DirectPackage::mumps), 2);
      for (const double corner : {0., -2., 0.})
        {
          matrix.set(0, n - 1, corner);
          matrix.set(n - 1, 0, symmetric ? corner : 0.5 * corner);
          matrix.compress(VectorOperation::insert);
          solver.solve(matrix, x, b, symmetric);
          Vector r(x);
          matrix.vmult(r, x);
          r -= b;
          EXPECT_LE(r.linfty_norm(), 1e-12) << corner << ' ' << symmetric;
          EXPECT_EQ(x(0) > 1., corner < 0.);
        }
    }
}

TEST(LinearSolver, AutomaticChoosesBySizeAndSymmetry)
{
  Square                 square(4, true, MPI_COMM_SELF); // 578 unknowns
  LinearSolverParameters parameters;
  const auto             method = [&](const bool symmetric, const unsigned int dimension) {
    return LinearSolver(parameters, dimension)
      .solve(square.matrix, square.x, square.b, symmetric)
      .method;
  };
  EXPECT_EQ(method(true, 2), "KLU");
  parameters.direct_up_to_2d = 577;
  EXPECT_EQ(method(true, 2), "CG+AMG");
  EXPECT_EQ(method(false, 2), "GMRES+AMG");
  EXPECT_EQ(method(true, 3), "KLU");
  parameters.direct_up_to_3d = 577;
  EXPECT_EQ(method(true, 3), "CG+AMG");

  Square larger(5, true, MPI_COMM_SELF); // 2178 unknowns
  EXPECT_EQ(LinearSolver({}, 2).solve(larger.matrix, larger.x, larger.b, true).method, "MUMPS");
  // An iteration that does not converge is replaced by a direct solver.
  parameters.max_iterations = 3;
  EXPECT_EQ(LinearSolver(parameters, 2).solve(larger.matrix, larger.x, larger.b, true).method,
            "MUMPS");
}

TEST(LinearSolver, NearNullSpaceSavesIterations)
{
  Square       square(6, true, MPI_COMM_SELF);
  LinearSolver solver(iterative(KrylovMethod::cg), 2);
  const auto   translations = solver.solve(square.matrix, square.x, square.b, true).iterations;
  solver.set_near_null_space(square.rigid_motions());
  const auto rigid = solver.solve(square.matrix, square.x, square.b, true).iterations;
  EXPECT_LE(translations, 25u);
  EXPECT_LE(rigid, translations);
}

TEST(LinearSolver, ZeroRightHandSide)
{
  Square square(3, true, MPI_COMM_SELF);
  for (const auto &parameters : {direct(DirectPackage::klu), iterative(KrylovMethod::cg)})
    {
      square.x = 1;
      square.b = 0;
      LinearSolver solver(parameters, 2);
      EXPECT_EQ(solver.solve(square.matrix, square.x, square.b, true).relative_residual, 0);
      EXPECT_EQ(square.x.l2_norm(), 0);
    }
}

TEST(LinearSolver, SingularMatricesAreRecognised)
{
  const std::vector<std::vector<std::vector<double>>> matrices
    = {{{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}},          // a free chain
       {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}},              // rank 2, to round-off
       {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}},              // a row of zeros
       {{1e11, 1e11, 0}, {1e11, 1e11, 0}, {0, 0, 1}}}; // two equal rows
  const EnumNames<DirectPackage> names
    = {{DirectPackage::klu, "KLU "}, {DirectPackage::mumps, "MUMPS "}};
  for (const auto package : {DirectPackage::klu, DirectPackage::mumps})
    for (const auto &rows : matrices)
      {
        SCOPED_TRACE(name_of(names, package) + std::to_string(rows[0][0]));
        const Matrix A = dense(rows);
        Vector       x = vector({0, 0, 0});
        LinearSolver solver(direct(package), 2);
        // A right-hand side in the range (0 = (1, -2, 1) . b) or not: both are refused.
        EXPECT_THROW(solver.solve(A, x, vector({1, 0, -1}), true), LinearSolverFailure);
        EXPECT_THROW(solver.solve(A, x, vector({1, 2, 5}), true), LinearSolverFailure);
        // The solver can go on with another matrix.
        const Matrix good = dense({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
        solver.solve(good, x, vector({2, 4, 6}), true);
        EXPECT_NEAR(x(2), 3, 1e-14);
      }
}

TEST(LinearSolver, FreeBodiesAreRecognised)
{
  for (const auto package : {DirectPackage::klu, DirectPackage::mumps})
    for (const double modulus : {1e-6, 1., 2e11})
      {
        Square       square(4, false, MPI_COMM_SELF, modulus);
        LinearSolver solver(direct(package), 2);
        EXPECT_THROW(solver.solve(square.matrix, square.x, square.b, true), LinearSolverFailure);
        // Without any load the matrix is as singular.
        square.b = 0;
        EXPECT_THROW(solver.solve(square.matrix, square.x, square.b, true), LinearSolverFailure);
      }
  Square       square(4, false, MPI_COMM_SELF);
  LinearSolver cg(iterative(KrylovMethod::cg), 2);
  EXPECT_THROW(cg.solve(square.matrix, square.x, square.b, true), LinearSolverFailure);
}

TEST(LinearSolver, BadScalingIsNotSingular)
{
  // Rows of very different size, and a soft spring that holds a chain.
  const Matrix A = dense({{1e12, 0, 0}, {0, 1e-3, 0}, {0, 0, 1}});
  const Matrix B = dense({{1 + 1e-9, -1, 0}, {-1, 2, -1}, {0, -1, 1}});
  for (const auto package : {DirectPackage::klu, DirectPackage::mumps})
    {
      LinearSolver solver(direct(package), 2);
      Vector       x = vector({0, 0, 0});
      solver.solve(A, x, vector({1e12, 1e-3, 1}), true);
      EXPECT_NEAR(x(1), 1, 1e-14);
      solver.solve(B, x, vector({0, 0, 1e-9}), true);
      EXPECT_NEAR(x(0), 1, 1e-5);
    }
}

// In Debug deal.II itself stops at such a matrix.
TEST(ReleaseLinearSolver, ValuesThatAreNotFiniteAreRecognised)
{
  const double nan  = std::numeric_limits<double>::quiet_NaN();
  const Matrix good = dense({{2, 0}, {0, 2}}), bad = dense({{2, 0}, {nan, 2}});
  for (const auto &parameters : {direct(DirectPackage::klu), direct(DirectPackage::mumps),
                                 iterative(KrylovMethod::cg), iterative(KrylovMethod::gmres)})
    {
      Vector       x = vector({0, 0});
      LinearSolver solver(parameters, 2);
      EXPECT_THROW(solver.solve(good, x, vector({1, nan}), true), LinearSolverFailure);
      EXPECT_THROW(solver.solve(bad, x, vector({1, 1}), true), LinearSolverFailure);
    }
}

TEST(LinearSolver, NoConvergenceIsAFailure)
{
  Square                 square(5, true, MPI_COMM_SELF);
  LinearSolverParameters parameters = iterative(KrylovMethod::cg);
  parameters.max_iterations         = 3;
  LinearSolver solver(parameters, 2);
  EXPECT_THROW(solver.solve(square.matrix, square.x, square.b, true), LinearSolverFailure);
}

TEST(LinearSolverMPI, EqualsSerial)
{
  Square       serial(6, true, MPI_COMM_SELF), distributed(6, true, MPI_COMM_WORLD);
  LinearSolver reference(direct(DirectPackage::klu), 2);
  const double expected = work(serial, reference, "KLU");

  LinearSolver mumps(direct(DirectPackage::mumps), 2), klu(direct(DirectPackage::klu), 2),
    cg(iterative(KrylovMethod::cg), 2), gmres(iterative(KrylovMethod::gmres), 2), chosen({}, 2);
  EXPECT_NEAR(work(distributed, mumps, "MUMPS") / expected, 1, 1e-11);
  EXPECT_NEAR(work(distributed, mumps, "MUMPS") / expected, 1, 1e-11);
  EXPECT_NEAR(work(distributed, klu, "KLU") / expected, 1, 1e-11);
  EXPECT_NEAR(work(distributed, chosen, "MUMPS") / expected, 1, 1e-11);
  EXPECT_NEAR(work(distributed, cg, "CG+AMG") / expected, 1, 1e-9);
  EXPECT_NEAR(work(distributed, gmres, "GMRES+AMG") / expected, 1, 1e-9);
  cg.set_near_null_space(distributed.rigid_motions());
  EXPECT_NEAR(work(distributed, cg, "CG+AMG") / expected, 1, 1e-9);
}

TEST(LinearSolverMPI, FreeBodiesAreRecognised)
{
  // 2178 unknowns are factorised by one process, 33282 by all.
  for (const unsigned int level : {5, 7})
    {
      Square       square(level, false, MPI_COMM_WORLD);
      LinearSolver solver(direct(DirectPackage::mumps), 2);
      EXPECT_THROW(solver.solve(square.matrix, square.x, square.b, true), LinearSolverFailure);
    }
}

TEST(LinearSolverParameters, AreReadAndChecked)
{
  ParameterFile          good = ParameterFile::from_string("set Type = iterative\n"
                                                                    "set Iterative method = GMRES\n"
                                                                    "set Direct package = MUMPS\n"
                                                                    "subsection Multigrid\n"
                                                                    "  set Smoother sweeps = 3\n"
                                                                    "end\n");
  LinearSolverParameters parameters;
  parameters.declare(good.root());
  good.check();
  EXPECT_EQ(parameters.type, LinearSolverType::iterative);
  EXPECT_EQ(parameters.krylov_method, KrylovMethod::gmres);
  EXPECT_EQ(parameters.direct_package, DirectPackage::mumps);
  EXPECT_EQ(parameters.amg_smoother_sweeps, 3u);

  for (const char *wrong :
       {"set Type = quick", "set Tolerance = 0", "set Tolerance = 2", "set Maximum iterations = 0"})
    {
      ParameterFile bad = ParameterFile::from_string(wrong);
      LinearSolverParameters().declare(bad.root());
      EXPECT_THROW(bad.check(), UserError) << wrong;
    }
}
} // namespace
} // namespace scree
