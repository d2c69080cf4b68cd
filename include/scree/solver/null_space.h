#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

namespace scree
{
/**
 * What a symmetric positive semi-definite matrix resists little: its eigenvectors with eigenvalues
 * up to `limit`, orthonormal, as columns; by the singular values of the n x n matrix, in O(n^3).
 */
dealii::FullMatrix<double> null_space(const dealii::FullMatrix<double> &A, const double limit);

/**
 * The same of a sparse matrix, whole on this process. Of a large one (A + limit 1)^-1, factorised
 * once, is applied to a subspace until its Ritz values up to the first above the limit stay: O(n k)
 * numbers and O(n k^2) operations for k vectors, beside the factorisation. Where k > n/2 it is
 * solved as a dense one.
 *
 * @param A     with its diagonal in the sparsity pattern
 * @param limit positive
 */
dealii::FullMatrix<double> null_space(const dealii::SparseMatrix<double> &A, const double limit);
} // namespace scree
