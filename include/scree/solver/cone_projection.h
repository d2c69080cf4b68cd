#pragma once

#include <vector>

namespace scree
{
/**
 * What of a vector no non-negative combination of given ones balances: r = f + A x with the x >= 0
 * that makes |r| smallest.
 *
 * @param f       n numbers
 * @param columns the columns of A, n numbers each, one after the other; their lengths do not matter
 * @return        r, n numbers. By Farkas' lemma r.a_j >= 0 for all columns and r.f = |r|^2, both up
 *                to 1e-10 |f|: with forces f and reactions a_j, r is a motion against which no
 *                reaction acts and on which the forces do work; r = 0: the reactions balance them.
 *
 * Active set method of Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23): exact
 * after finitely many changes, each O(n m) for m columns and O(n k^2) for the k <= n active ones.
 */
std::vector<double> unbalanced_part(const std::vector<double> &f,
                                    const std::vector<double> &columns);
} // namespace scree
