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
 * The same of a sparse matrix, whole on this process. Of a large one the pivots of A - limit 1
 * count the k eigenvalues up to the limit (Sylvester). (A + limit 1)^-1 is applied to k vectors and
 * some more until so many Ritz values are that low and stay: O(n k) numbers and O(n k^2) operations
 * beside the factorisations. Where k is near n/2 it is solved as a dense one. Throws
 * LinearSolverFailure.
 *
 * @param A     with its diagonal in the sparsity pattern
 * @param limit positive
 */
dealii::FullMatrix<double> null_space(const dealii::SparseMatrix<double> &A, const double limit);
} // namespace scree
