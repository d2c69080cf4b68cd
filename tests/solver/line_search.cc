#include <gtest/gtest.h>

#include <scree/solver/line_search.h>

#include <algorithm>
#include <cmath>

using namespace scree;

// A load that falls freely to a stiff stop: G is 1 up to the gap, then falls with a slope of 1e8.
TEST(LineSearch, FindsAStiffStop)
{
  for (const double gap : {0.9, 0.3, 1e-3, 1e-7})
    {
      unsigned int n_calls = 0;
      double       last    = 0.;
      const auto   G       = [&](const double alpha) {
        ++n_calls;
        last = 1. - 1e8 * std::max(0., alpha - gap);
        return last;
      };
      const double at_1  = G(1.);
      const double alpha = find_zero(G, 1., 1., at_1, 0.1, 60);
      EXPECT_NEAR(alpha, gap, 2e-8);
      EXPECT_LE(std::abs(last), 0.1);
      EXPECT_LT(n_calls, 50u);
    }
}

TEST(LineSearch, LinearFunctionInOneTrial)
{
  unsigned int n_calls = 0;
  const auto   G       = [&](const double alpha) {
    ++n_calls;
    return 1. - 4. * alpha;
  };
  EXPECT_DOUBLE_EQ(find_zero(G, 1., 1., -3., 1e-3, 10), 0.25);
  EXPECT_EQ(n_calls, 1u);
}
