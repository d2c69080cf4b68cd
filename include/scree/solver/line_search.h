#pragma once

#include <functional>

namespace scree
{
/**
 * Goes towards a zero of a decreasing function G between 0 and b, G(0) > 0 > G(b), until
 * |G| <= tolerance: the Illinois variant of regula falsi, and where the last trial did not halve
 * |G| bisection, geometric near 0. The last call of G is the one at the result.
 *
 * @param max_trials calls of G at most
 */
double find_zero(const std::function<double(double)> &G, const double at_0, double b,
                 const double at_b, const double tolerance, const unsigned int max_trials);
} // namespace scree
