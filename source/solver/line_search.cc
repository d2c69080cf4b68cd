#include <scree/solver/line_search.h>

#include <algorithm>
#include <cmath>

namespace scree
{
double
find_zero(const std::function<double(double)> &G, const double at_0, double b, const double at_b,
          const double tolerance, const unsigned int max_trials)
{
  double a = 0., G_a = at_0, G_b = at_b, alpha = b, last = at_b, before = at_0;
  for (unsigned int k = 0; k < max_trials && std::abs(last) > tolerance; ++k)
    {
      const bool is_slow = k > 1 && std::abs(last) > 0.5 * std::abs(before);
      if (!is_slow)
        alpha = (a * G_b - b * G_a) / (G_b - G_a);
      else
        alpha = a > 0.1 * b ? 0.5 * (a + b) : std::sqrt(std::max(a, 0.01 * b) * b);
      before = last;
      last   = G(alpha);
      if (last > 0.)
        {
          a   = alpha;
          G_a = last;
          G_b *= 0.5;
        }
      else
        {
          b   = alpha;
          G_b = last;
          G_a *= 0.5;
        }
    }
  return alpha;
}
} // namespace scree
