#include <scree/solver/condensed_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
/** A solution is refined until |b - A x| / |b| is below the first, at most so often. */
constexpr double       wanted_residual = 1e-10;
constexpr unsigned int max_refinements = 2;

/** A larger relative residual is not accepted. */
constexpr double residual_limit = 1e-3;
} // namespace

CondensedSolver::CondensedSolver(const Matrix &matrix, const SparseRows &rows, const bool symmetric)
    : rows(rows)
    , symmetric(symmetric)
    , communicator(matrix.get_mpi_communicator())
{
  K.copy_from(matrix);
  const Epetra_CrsMatrix &k = K.trilinos_matrix();
  const Epetra_Map        row_map(-1, rows.n_rows(), 0, k.Comm());
  B = std::make_unique<Epetra_CrsMatrix>(Copy, row_map, 0);
  for (std::size_t i = 0; i < rows.n_rows(); ++i)
    B->InsertGlobalValues(row_map.GID(i), rows.begin[i + 1] - rows.begin[i],
                          &rows.values[rows.begin[i]], &rows.columns[rows.begin[i]]);
  B->FillComplete(k.RowMap(), row_map);

  const int        n = k.NumGlobalRows();
  std::vector<int> kept(row_map.NumGlobalElements());
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = n + i;
  const MatrixEntries all = entries();
  mumps = std::make_unique<Mumps>(n + kept.size(), symmetric, all, kept, communicator);
  mumps->factorise(all.values);
}

MatrixEntries
CondensedSolver::entries() const
{
  // [K B^T; B 0] with the rows of B last.
  MatrixEntries result = matrix_entries(K.trilinos_matrix(), symmetric);
  const int     n      = K.m();
  for (std::size_t i = 0; i < rows.n_rows(); ++i)
    for (std::size_t j = rows.begin[i]; j < rows.begin[i + 1]; ++j)
      {
        result.rows.push_back(n + B->RowMap().GID(i));
        result.columns.push_back(rows.columns[j]);
        result.values.push_back(rows.values[j]);
        if (symmetric)
          continue;
        result.rows.push_back(rows.columns[j]);
        result.columns.push_back(n + B->RowMap().GID(i));
        result.values.push_back(rows.values[j]);
      }
  return result;
}

void
CondensedSolver::update(const Matrix &matrix)
{
  K.copy_from(matrix);
  mumps->factorise(entries().values);
  dense_operations = 0.;
}

std::vector<double>
CondensedSolver::solve_dense(const std::vector<double> &E, const unsigned int block,
                             const std::vector<double> &y)
{
  const std::vector<double> &minus_C = mumps->schur_complement();
  const std::size_t          n       = y.size();
  std::vector<unsigned int>  changed; // blocks of E that do not vanish
  for (unsigned int p = 0; p < n / block; ++p)
    if (std::any_of(&E[p * block * block], &E[p * block * block] + block * block,
                    [](const double e) { return e != 0.; }))
      changed.push_back(p);

  const unsigned int m = changed.size() * block;
  dense_operations += 2. / 3. * std::pow(m, 3);
  dealii::LAPACKFullMatrix<double> system(m, m);
  dealii::Vector<double>           z(m);
  for (unsigned int q = 0; q < changed.size(); ++q)
    {
      const double *e = &E[changed[q] * block * block];
      for (unsigned int p = 0; p < changed.size(); ++p)
        for (unsigned int i = 0; i < block; ++i)
          {
            const double *c = &minus_C[(changed[p] * block + i) * n + changed[q] * block];
            for (unsigned int j = 0; j < block; ++j)
              {
                double sum = p == q && i == j ? 1. : 0.;
                for (unsigned int k = 0; k < block; ++k)
                  sum -= c[k] * e[k * block + j];
                system(p * block + i, q * block + j) = sum;
              }
          }
      for (unsigned int i = 0; i < block; ++i)
        z(q * block + i) = y[changed[q] * block + i];
    }
  if (m > 0)
    {
      system.compute_lu_factorization();
      system.solve(z);
    }
  std::vector<double> forces(n, 0.); // E z
  for (unsigned int q = 0; q < changed.size(); ++q)
    for (unsigned int i = 0; i < block; ++i)
      for (unsigned int j = 0; j < block; ++j)
        forces[changed[q] * block + i]
          += E[(changed[q] * block + i) * block + j] * z(q * block + j);
  return forces;
}

void
CondensedSolver::add_solution(const std::vector<double> &E, const unsigned int block,
                              const Vector &r, Vector &x)
{
  const bool          is_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  std::vector<double> right   = gather_to_root(*r.trilinos_vector()(0));
  if (is_root)
    right.resize(right.size() + B->NumGlobalRows(), 0.);
  // The condensed right-hand side is -B K^{-1} r.
  std::vector<double> y           = mumps->condense(right);
  bool                is_singular = false;
  if (is_root)
    {
      for (double &value : y)
        value = -value;
      try
        {
          y = solve_dense(E, block, y);
        }
      catch (const dealii::ExceptionBase &)
        {
          is_singular = true;
        }
    }
  if (dealii::Utilities::MPI::broadcast(communicator, is_singular))
    throw LinearSolverFailure("the condensed matrix is singular");
  add_from_root(mumps->expand(y), *x.trilinos_vector()(0));
}

void
CondensedSolver::residual(const std::vector<double> &E, const unsigned int block, const Vector &x,
                          const Vector &b, Vector &r) const
{
  K.vmult(r, x);
  Epetra_Vector z(B->RowMap()), forces(B->RowMap()), product(K.trilinos_matrix().RowMap());
  B->Multiply(false, *x.trilinos_vector()(0), z);
  for (int p = 0; p < z.MyLength() / static_cast<int>(block); ++p)
    for (unsigned int i = 0; i < block; ++i)
      for (unsigned int j = 0; j < block; ++j)
        forces[p * block + i] += E[(p * block + i) * block + j] * z[p * block + j];
  B->Multiply(true, forces, product);
  for (int i = 0; i < product.MyLength(); ++i)
    (*r.trilinos_vector()(0))[i] += product[i];
  r.sadd(-1., b);
}

LinearSolveResult
CondensedSolver::solve(const std::vector<double> &E, const unsigned int block, Vector &x,
                       const Vector &b)
{
  dealii::Timer     timer;
  LinearSolveResult result;
  result.method     = "condensed";
  const double norm = b.l2_norm();
  if (!std::isfinite(norm))
    throw LinearSolverFailure("the right-hand side is not finite");
  x = 0.;
  if (norm == 0.)
    return result;
  const std::vector<double> all_E = gather_to_root(E, communicator);
  Vector                    r(b);
  result.relative_residual = 1.;
  for (unsigned int i = 0; i <= max_refinements && result.relative_residual > wanted_residual; ++i)
    {
      add_solution(all_E, block, r, x);
      residual(E, block, x, b, r);
      result.relative_residual = r.l2_norm() / norm;
    }
  dense_operations = dealii::Utilities::MPI::broadcast(communicator, dense_operations);
  if (!(result.relative_residual <= residual_limit))
    throw LinearSolverFailure("the condensed matrix is singular to working precision");
  result.seconds = timer.wall_time();
  return result;
}
} // namespace scree
