#pragma once

#include <functional>

namespace scree
{
/**
 * Goes towards a zero of a decreasing function G between 0 and b, G(0) > 0 > G(b), trial by trial:
 * the Illinois variant of regula falsi, and where the last trial did not halve |G| bisection,
 * geometric near 0.
 */
class ZeroSearch
{
public:
  ZeroSearch(const double at_0, const double b, const double at_b);

  /** |G| of the last trial; at first, at b. */
  double last() const;

  /** Where G is wanted next. */
  double next();

  /** Takes G there. */
  void take(const double value);

private:
  double       a        = 0., b, G_a, G_b, alpha, last_value, before;
  unsigned int n_trials = 0;
};

/**
 * A ZeroSearch until |G| <= tolerance; the last call of G is the one at the result.
 *
 * @param max_trials calls of G at most
 */
double find_zero(const std::function<double(double)> &G, const double at_0, const double b,
                 const double at_b, const double tolerance, const unsigned int max_trials);
} // namespace scree
