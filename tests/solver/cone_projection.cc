#include <gtest/gtest.h>

#include <scree/solver/cone_projection.h>

#include <cmath>
#include <random>

using namespace scree;

namespace
{
double
dot(const double *a, const double *b, const std::size_t n)
{
  double sum = 0.;
  for (std::size_t i = 0; i < n; ++i)
    sum += a[i] * b[i];
  return sum;
}

/** Columns of n numbers, one after the other, as rows. */
SparseRows
rows_of(const std::vector<double> &columns, const std::size_t n)
{
  SparseRows rows;
  rows.values = columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    {
      rows.columns.push_back(i % n);
      if ((i + 1) % n == 0)
        rows.begin.push_back(i + 1);
    }
  return rows;
}

/** Pressure and friction under a block of width 1: coordinates x, y, rotation about (0, 1). */
std::vector<double>
floor_under_block(const double mu)
{
  std::vector<double> columns;
  for (unsigned int i = 0; i <= 40; ++i)
    for (const double friction : {-mu, mu})
      columns.insert(columns.end(), {friction, 1., -0.5 + i / 40. + friction});
  return columns;
}
} // namespace

TEST(ConeProjection, BlockStandsSlidesOrTips)
{
  // Weight 1 and a push at height 1: slides beyond mu, tips beyond half the width.
  const auto push = [](const double force, const double mu) {
    return unbalanced_part({force, -1., 0.}, rows_of(floor_under_block(mu), 3));
  };
  for (const double part : push(0.49, 0.8))
    EXPECT_NEAR(part, 0., 1e-9);
  const auto tips = push(0.6, 0.8);
  EXPECT_GT(tips[0], 0.01);
  // a turn about (0.5, 0), clockwise: v + omega x (x - c) = 0 there
  EXPECT_NEAR(tips[0] + tips[2] * 1., 0., 1e-10);
  EXPECT_NEAR(tips[1] + tips[2] * 0.5, 0., 1e-10);
  const auto slides = push(0.4, 0.3);
  EXPECT_GT(slides[0], 0.01);
  EXPECT_NEAR(slides[2] / slides[0], 0., 0.5);
}

TEST(ConeProjection, SatisfiesFarkas)
{
  std::mt19937                     generator(1);
  std::normal_distribution<double> normal;
  for (unsigned int run = 0; run < 10; ++run)
    {
      const std::size_t   n = 20, m = 300;
      std::vector<double> columns(n * m), f(n);
      for (double &value : columns)
        value = normal(generator);
      // all in one half-space, so that half of the loads cannot be balanced
      for (std::size_t j = 0; j < m; ++j)
        columns[j * n] = std::abs(columns[j * n]);
      for (double &value : f)
        value = normal(generator);
      const auto r = unbalanced_part(f, rows_of(columns, n));
      for (std::size_t j = 0; j < m; ++j)
        EXPECT_GT(dot(&columns[j * n], r.data(), n), -1e-8);
      EXPECT_NEAR(dot(r.data(), f.data(), n), dot(r.data(), r.data(), n), 1e-8);
    }
}
