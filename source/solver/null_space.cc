#include <scree/solver/mumps.h>
#include <scree/solver/null_space.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/lapack_templates.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace scree
{
namespace
{
using dealii::types::blas_int;
using DenseMatrix  = dealii::FullMatrix<double>;
using SparseMatrix = dealii::SparseMatrix<double>;

/** Vectors of n numbers, one after the other. */
using Block = std::vector<double>;

constexpr unsigned int largest_dense  = 100;
constexpr unsigned int max_iterations = 30;
constexpr double       steady         = 1e-2; // change of a Ritz value, relative

/** (A + shift 1)^-1 for one shift after the other. */
class ShiftedInverse
{
public:
  explicit ShiftedInverse(const SparseMatrix &A)
  {
    for (unsigned int row = 0; row < A.m(); ++row)
      for (auto entry = A.begin(row); entry != A.end(row); ++entry)
        if (entry->column() <= row)
          {
            entries.rows.push_back(row);
            entries.columns.push_back(entry->column());
            entries.values.push_back(entry->value());
          }
    inverse = std::make_unique<Mumps>(A.m(), true, entries, std::vector<int>(), MPI_COMM_SELF);
  }

  void factorise(const double shift)
  {
    std::vector<double> values(entries.values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (entries.rows[i] == entries.columns[i])
        values[i] += shift;
    inverse->factorise(values);
  }

  /** Of the matrix factorised last. */
  unsigned int n_negative_eigenvalues() const
  {
    return inverse->n_negative_pivots();
  }

  void apply(Block &basis) const
  {
    inverse->solve(basis);
  }

private:
  MatrixEntries          entries;
  std::unique_ptr<Mumps> inverse;
};

/** alpha = 1, beta = 0: C = op(A) B of m x k and k x n numbers. */
void
multiply(const char *transposed, const blas_int m, const blas_int n, const blas_int k,
         const Block &A, const Block &B, Block &C)
{
  const double   one = 1., zero = 0.;
  const blas_int rows_of_a = *transposed == 'T' ? k : m;
  C.resize(m * n);
  dealii::gemm(transposed, "N", &m, &n, &k, &one, A.data(), &rows_of_a, B.data(), &k, &zero,
               C.data(), &m);
}

/** Householder's QR decomposition: the basis becomes Q. */
void
orthonormalise(const blas_int n, Block &basis)
{
  const blas_int      p = basis.size() / n, n_work = 64 * p;
  blas_int            info = 0;
  std::vector<double> tau(p), work(n_work);
  dealii::geqrf(&n, &p, basis.data(), &n, tau.data(), work.data(), &n_work, &info);
  dealii::orgqr(&n, &p, &p, basis.data(), &n, tau.data(), work.data(), &n_work, &info);
}

/** Turns an orthonormal basis into Ritz vectors; returns the Ritz values, ascending. */
dealii::Vector<double>
rotate_to_ritz_vectors(const SparseMatrix &A, Block &basis)
{
  const unsigned int n = A.m(), p = basis.size() / n;
  Block              product(basis.size(), 0.), projected;
  for (unsigned int j = 0; j < p; ++j)
    for (unsigned int row = 0; row < n; ++row)
      for (auto entry = A.begin(row); entry != A.end(row); ++entry)
        product[j * n + row] += entry->value() * basis[j * n + entry->column()];
  multiply("T", p, p, n, basis, product, projected);
  dealii::LAPACKFullMatrix<double> matrix(p, p);
  for (unsigned int i = 0; i < p; ++i)
    for (unsigned int j = 0; j < p; ++j)
      matrix(i, j) = 0.5 * (projected[j * p + i] + projected[i * p + j]);
  const double           bound = 1. + matrix.frobenius_norm();
  dealii::Vector<double> values;
  DenseMatrix            vectors;
  matrix.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
  Block turns(p * p);
  for (unsigned int i = 0; i < p; ++i)
    for (unsigned int j = 0; j < p; ++j)
      turns[j * p + i] = vectors(i, j);
  multiply("N", n, p, p, basis, turns, product);
  basis.swap(product);
  return values;
}

/**
 * Iterates a basis until its lowest k Ritz values, which fall towards the k eigenvalues up to the
 * limit, are below it and stay; false: they do not.
 */
bool
iterate(const SparseMatrix &A, const ShiftedInverse &inverse, const double limit,
        const unsigned int k, Block &basis)
{
  dealii::Vector<double> values, before;
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      inverse.apply(basis);
      orthonormalise(A.m(), basis);
      before         = values;
      values         = rotate_to_ritz_vectors(A, basis);
      bool is_steady = iteration > 0 && values[k - 1] <= limit;
      for (unsigned int i = 0; is_steady && i < k; ++i)
        is_steady = std::abs(values[i] - before[i]) <= steady * limit;
      if (is_steady)
        return true;
    }
  return false;
}

Block
random_numbers(const std::size_t n)
{
  std::mt19937                     generator(1);
  std::normal_distribution<double> normal;
  Block                            result(n);
  std::generate(result.begin(), result.end(), [&]() { return normal(generator); });
  return result;
}
} // namespace

DenseMatrix
null_space(const DenseMatrix &A, const double limit)
{
  const unsigned int               n = A.m();
  dealii::LAPACKFullMatrix<double> copy(n, n);
  // Singular values are the eigenvalues; the largest come first.
  copy = A;
  copy.compute_svd();
  unsigned int n_held = 0;
  while (n_held < n && copy.singular_value(n_held) > limit)
    ++n_held;
  DenseMatrix vectors(n, n - n_held);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = n_held; j < n; ++j)
      vectors(i, j - n_held) = copy.get_svd_vt()(j, i);
  return vectors;
}

DenseMatrix
null_space(const SparseMatrix &A, const double limit)
{
  constexpr double   just_above = 1. + 1e-9;
  const unsigned int n          = A.m();
  if (n > largest_dense)
    {
      ShiftedInverse inverse(A);
      inverse.factorise(-just_above * limit);
      const unsigned int k = inverse.n_negative_eigenvalues();
      if (k == 0)
        return DenseMatrix(n, 0);
      inverse.factorise(limit);
      for (unsigned int extra = std::max(8U, k / 4); k + extra < n / 2; extra *= 2)
        {
          Block basis = random_numbers(std::size_t(n) * (k + extra));
          if (!iterate(A, inverse, just_above * limit, k, basis))
            continue;
          DenseMatrix vectors(n, k);
          for (unsigned int j = 0; j < k; ++j)
            for (unsigned int i = 0; i < n; ++i)
              vectors(i, j) = basis[std::size_t(j) * n + i];
          return vectors;
        }
    }
  DenseMatrix matrix(n, n);
  matrix.copy_from(A);
  return null_space(matrix, limit);
}
} // namespace scree
