// A cut moved over a cell in 100 offsets: neither errors nor linear iterations depend on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "manufactured.h"

namespace scree
{
namespace
{
/** What 100 offsets gave. */
struct Spread
{
  double       max_over_median;
  unsigned int median_iterations, max_iterations;
};

/** Offsets i/n of a cell edge, i = 0 ... n - 1. */
Spread
offsets(const unsigned int n, const unsigned int degree,
        const std::function<std::string(const double)> &shape,
        const std::vector<std::string> &faces, const std::string &name)
{
  const unsigned int        level = degree == 1 ? 3 : 2;
  const double              h     = 2. / (6 << level);
  std::vector<double>       errors;
  std::vector<unsigned int> iterations;
  for (unsigned int i = 0; i < n; ++i)
    {
      EquilibriumModel<2> model(
        grid_text("-1, -1", "1, 1", "6, 6", level) + degree_text(degree)
        + bodies_text({{"body", Manufactured<2>::body(shape(double(i) / n * h), faces)}})
        + solver_text(1e-8, "iterative"));
      errors.push_back(Manufactured<2>::solve(model));
      iterations.push_back(model.linear_iterations);
    }
  std::vector<double> sorted(errors);
  std::sort(sorted.begin(), sorted.end());
  std::vector<unsigned int> counts(iterations);
  std::sort(counts.begin(), counts.end());
  const Spread result = {sorted.back() / sorted[n / 2], counts[n / 2], counts.back()};
  std::cout << "  " << name << ", Q" << degree << ": L2 error median " << sorted[n / 2]
            << ", max/median " << result.max_over_median << ", at offset 0 " << errors[0]
            << "; linear iterations median " << result.median_iterations << ", max "
            << result.max_iterations << ", at offset 0 " << iterations[0] << "\n";
  return result;
}

void
check(const Spread &spread)
{
  EXPECT_LE(spread.max_over_median, 1.3);
  EXPECT_GT(spread.median_iterations, 1u);
  EXPECT_LE(spread.max_iterations, spread.median_iterations + 5);
}

std::string
to_text(const double x)
{
  std::ostringstream text;
  text.precision(17);
  text << x;
  return text.str();
}

TEST(ReleaseOffsets, HalfPlaneAlongGridLines)
{
  // Offset 0 lies on the grid line y = 0.5.
  const auto shape
    = [](const double offset) { return half_space_text("0, " + to_text(0.5 + offset), "0, 1"); };
  check(offsets(100, 1, shape, {"x-", "x+", "y-"}, "aligned"));
  check(offsets(100, 2, shape, {"x-", "x+", "y-"}, "aligned"));
}

TEST(ReleaseOffsets, Disc)
{
  const auto shape = [](const double offset) {
    return ball_text(to_text(offset) + ", " + to_text(0.3 * offset), 0.8);
  };
  check(offsets(25, 1, shape, {}, "disc"));
  check(offsets(25, 2, shape, {}, "disc"));
}
} // namespace
} // namespace scree
