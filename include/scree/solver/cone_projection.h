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
 * up to 1e-10 |f|: with forces f and reactions a_j, r is a motion against which no reaction acts
 * and on which the forces do work; r = 0: the reactions balance them.
 *
 * Active set method of Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23): exact
 * after finitely many changes. One that adds a column is O(n k) for k <= n active ones and goes
 * through the entries of A, one that removes a column orthogonalises those after it anew, O(n k^2).
 */
std::vector<double> unbalanced_part(const std::vector<double> &f, const SparseRows &reactions);
} // namespace scree
