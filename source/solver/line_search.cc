#include <scree/solver/line_search.h>

#include <algorithm>
#include <cmath>

namespace scree
{
ZeroSearch::ZeroSearch(const double at_0, const double b, const double at_b)
    : b(b)
    , G_a(at_0)
    , G_b(at_b)
    , alpha(b)
    , last_value(at_b)
    , before(at_0)
{
}

double
ZeroSearch::last() const
{
  return std::abs(last_value);
}

double
ZeroSearch::next()
{
  const bool is_slow = n_trials > 1 && std::abs(last_value) > 0.5 * std::abs(before);
  if (!is_slow)
    alpha = (a * G_b - b * G_a) / (G_b - G_a);
  else
    alpha = a > 0.1 * b ? 0.5 * (a + b) : std::sqrt(std::max(a, 0.01 * b) * b);
  return alpha;
}

void
ZeroSearch::take(const double value)
{
  ++n_trials;
  before     = last_value;
  last_value = value;
  if (value > 0.)
    {
      a   = alpha;
      G_a = value;
      G_b *= 0.5;
    }
  else
    {
      b   = alpha;
      G_b = value;
      G_a *= 0.5;
    }
}

double
find_zero(const std::function<double(double)> &G, const double at_0, const double b,
          const double at_b, const double tolerance, const unsigned int max_trials)
{
  ZeroSearch search(at_0, b, at_b);
  double     alpha = b;
  for (unsigned int k = 0; k < max_trials && search.last() > tolerance; ++k)
    {
      alpha = search.next();
      search.take(G(alpha));
    }
  return alpha;
}
} // namespace scree
