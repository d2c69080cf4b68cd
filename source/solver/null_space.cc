#include <scree/solver/null_space.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace scree
{
namespace
{
using DenseMatrix = dealii::FullMatrix<double>;
using Vector      = dealii::Vector<double>;

constexpr unsigned int largest_dense  = 100;
constexpr unsigned int first_size     = 8; // of the subspace
constexpr unsigned int max_iterations = 30;
constexpr double       steady         = 1e-2; // change of a Ritz value, relative

/** Gram and Schmidt, twice. */
void
orthonormalise(std::vector<Vector> &basis)
{
  for (std::size_t j = 0; j < basis.size(); ++j)
    {
      for (std::size_t i = 0; i < 2 * j; ++i)
        basis[j].add(-(basis[i % j] * basis[j]), basis[i % j]);
      basis[j] /= basis[j].l2_norm();
    }
}

/** Turns a basis into Ritz vectors; returns the Ritz values, ascending. */
Vector
rotate_to_ritz_vectors(const dealii::SparseMatrix<double> &A, std::vector<Vector> &basis)
{
  const unsigned int p = basis.size(), n = A.m();
  DenseMatrix        projected(p, p), vectors;
  Vector             product(n), values;
  for (unsigned int j = 0; j < p; ++j)
    {
      A.vmult(product, basis[j]);
      for (unsigned int i = 0; i < p; ++i)
        projected(i, j) = basis[i] * product;
    }
  dealii::LAPACKFullMatrix<double> copy(p, p);
  copy               = projected;
  const double bound = 1. + projected.frobenius_norm();
  copy.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
  std::vector<Vector> turned(p, Vector(n));
  for (unsigned int j = 0; j < p; ++j)
    for (unsigned int i = 0; i < p; ++i)
      turned[j].add(vectors(i, j), basis[i]);
  basis.swap(turned);
  return values;
}

/** Lowest Ritz vectors in a subspace; returns the Ritz values, empty if the subspace is too small
 * to have one above the limit or the iteration does not end. */
std::vector<double>
iterate(const dealii::SparseMatrix<double> &A, const dealii::SparseDirectUMFPACK &inverse,
        const double limit, std::vector<Vector> &basis)
{
  Vector values(basis.size()), before;
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      for (Vector &vector : basis)
        inverse.solve(vector);
      orthonormalise(basis);
      before = values;
      values = rotate_to_ritz_vectors(A, basis);
      // They fall from above.
      const unsigned int n_below
        = std::upper_bound(values.begin(), values.end(), limit) - values.begin();
      if (n_below == basis.size())
        return {};
      bool is_steady = iteration > 0;
      for (unsigned int i = 0; i <= n_below; ++i)
        is_steady &= std::abs(values[i] - before[i]) <= steady * std::max(limit, values[i]);
      if (is_steady)
        return {values.begin(), values.end()};
    }
  return {};
}

std::vector<Vector>
random_vectors(const unsigned int n, const unsigned int size)
{
  std::mt19937                     generator(1);
  std::normal_distribution<double> normal;
  std::vector<Vector>              result(size, Vector(n));
  for (Vector &vector : result)
    for (double &entry : vector)
      entry = normal(generator);
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
null_space(const dealii::SparseMatrix<double> &A, const double limit)
{
  const unsigned int n     = A.m();
  const auto         dense = [&]() {
    DenseMatrix matrix(n, n);
    matrix.copy_from(A);
    return null_space(matrix, limit);
  };
  if (n <= largest_dense)
    return dense();
  dealii::SparseMatrix<double> shifted(A.get_sparsity_pattern());
  shifted.copy_from(A);
  for (unsigned int i = 0; i < n; ++i)
    shifted.diag_element(i) += limit;
  dealii::SparseDirectUMFPACK inverse;
  inverse.initialize(shifted);
  for (unsigned int size = first_size; size < n / 2; size *= 2)
    {
      auto       basis  = random_vectors(n, size);
      const auto values = iterate(A, inverse, limit, basis);
      if (values.empty())
        continue;
      const unsigned int n_below
        = std::upper_bound(values.begin(), values.end(), limit) - values.begin();
      DenseMatrix vectors(n, n_below);
      for (unsigned int j = 0; j < n_below; ++j)
        for (unsigned int i = 0; i < n; ++i)
          vectors(i, j) = basis[j][i];
      return vectors;
    }
  return dense();
}
} // namespace scree
