#pragma once

#include <scree/base/sparse_rows.h>

#include <vector>

namespace scree
{
/**
 * What of a vector no non-negative combination of given ones balances: r = f + A x with the x >= 0
 * that makes |r| smallest.
 *
 * @param f         n numbers
 * @param reactions the columns a_j of A, one in each row; their lengths do not matter
 * @return          r, n numbers. By Farkas' lemma r.a_j >= 0 for all columns and r.f = |r|^2, both
 * up to 1e-8 |f|: with forces f and reactions a_j, r is a motion against which no reaction acts
 * and on which the forces do work; r = 0: the reactions balance them.
 *
 * Primal-dual interior point method with Mehrotra's predictor and corrector (SIAM J. Optim. 2,
 * 1992): 10 to 30 sparse factorisations of an n x n matrix with the pattern of A A^T.
 */
std::vector<double> unbalanced_part(const std::vector<double> &f, const SparseRows &reactions);
} // namespace scree
