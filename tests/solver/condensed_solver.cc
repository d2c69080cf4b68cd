// The condensed solver against the residual of the full system, in serial and in parallel.
#include <gtest/gtest.h>

#include <scree/solver/condensed_solver.h>

#include <deal.II/base/mpi.h>

#include <cmath>

#include "elastic_square.h"

namespace scree
{
namespace
{
using namespace test;

/** Five two-row blocks per process; each row weighs unknowns of this process and the next. */
SparseRows
rows_of(const Square &square)
{
  const int  n = square.matrix.m(), first = square.x.local_range().first;
  SparseRows rows;
  for (int i = 0; i < 10; ++i)
    {
      for (int j = 0; j < 4; ++j)
        {
          rows.columns.push_back((first + 13 * i + 31 * j) % n);
          rows.values.push_back(std::cos(i + 3. * j));
        }
      rows.begin.push_back(rows.columns.size());
    }
  return rows;
}

/** Unsymmetric blocks of either sign; the second one vanishes. */
std::vector<double>
blocks_of(const double size)
{
  std::vector<double> E;
  for (int p = 0; p < 5; ++p)
    for (const double e : {1. + p, -0.3, 0.8 * p, 0.5})
      E.push_back(p == 1 ? 0. : size * e);
  return E;
}

/** |b - (K + B^T E B) x| / |b|, on one process or with rows that all processes see. */
double
full_residual(const Square &square, const SparseRows &rows, const std::vector<double> &E)
{
  const MPI_Comm communicator = square.matrix.get_mpi_communicator();
  Vector         all(complete_index_set(square.matrix.m()), communicator), r(square.x);
  all = square.x;
  square.matrix.residual(r, square.x, square.b); // b - K x
  for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      const std::size_t block = i / 2;
      double            force = 0.;
      for (std::size_t j = 0; j < 2; ++j)
        {
          double z = 0.;
          for (std::size_t k = rows.begin[2 * block + j]; k < rows.begin[2 * block + j + 1]; ++k)
            z += rows.values[k] * all(rows.columns[k]);
          force += E[4 * block + 2 * (i % 2) + j] * z;
        }
      for (std::size_t k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
        r(rows.columns[k]) += -rows.values[k] * force;
    }
  r.compress(VectorOperation::add);
  return r.l2_norm() / square.b.l2_norm();
}

void
expect_solutions(const MPI_Comm communicator)
{
  Square           square(4, true, communicator);
  const SparseRows rows = rows_of(square);
  for (const bool symmetric : {true, false})
    {
      CondensedSolver solver(square.matrix, rows, symmetric);
      for (const double size : {0., 1., 100., -0.05})
        {
          const auto result = solver.solve(blocks_of(size), 2, square.x, square.b);
          EXPECT_EQ(result.method, "condensed");
          EXPECT_LE(result.relative_residual, 1e-10);
          EXPECT_LE(full_residual(square, rows, blocks_of(size)), 1e-10);
        }
    }
}

TEST(CondensedSolver, SolvesTheFullSystem)
{
  expect_solutions(MPI_COMM_SELF);
}

TEST(CondensedSolverMPI, SolvesTheFullSystem)
{
  expect_solutions(MPI_COMM_WORLD);
}

TEST(CondensedSolver, RecognisesSingularSystems)
{
  // One row with a single entry; E = -1/C makes the dense system singular.
  Square     square(3, true, MPI_COMM_SELF);
  const int  centre = square.matrix.m() / 2;
  SparseRows rows;
  rows.begin   = {0, 1};
  rows.columns = {centre};
  rows.values  = {1.};
  Vector unit(square.x), column(square.x);
  unit         = 0.;
  unit(centre) = 1.;
  unit.compress(VectorOperation::insert);
  LinearSolver({}, 2).solve(square.matrix, column, unit, true);
  CondensedSolver solver(square.matrix, rows, true);
  EXPECT_THROW(solver.solve({-1. / column(centre)}, 1, square.x, square.b), LinearSolverFailure);
  square.b(centre) = std::nan("");
  square.b.compress(VectorOperation::insert);
  EXPECT_THROW(solver.solve({1.}, 1, square.x, square.b), LinearSolverFailure);
}
} // namespace
} // namespace scree
