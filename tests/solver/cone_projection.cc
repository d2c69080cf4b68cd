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

/** Forces of a contact on discs of radius 1 at x and on the one below or the floor, as columns: n
 * points up from the lower disc. Coordinates of a disc: x, y, rotation. */
void
add_contact(const int upper, const int lower, const double nx, const double ny, const double mu,
            SparseRows &rows)
{
  for (const double t : {-mu, 0., mu})
    {
      const double fx = nx - t * ny, fy = ny + t * nx;
      // moments about the centres, of a force at -n on the upper and at n on the lower disc
      rows.columns.insert(rows.columns.end(), {3 * upper, 3 * upper + 1, 3 * upper + 2});
      rows.values.insert(rows.values.end(), {fx, fy, ny * fx - nx * fy});
      if (lower >= 0)
        {
          rows.columns.insert(rows.columns.end(), {3 * lower, 3 * lower + 1, 3 * lower + 2});
          rows.values.insert(rows.values.end(), {-fx, -fy, ny * fx - nx * fy});
        }
      rows.begin.push_back(rows.columns.size());
    }
}

/** Of discs of weight 1. */
std::vector<double>
weights(const int n_discs)
{
  std::vector<double> f;
  for (int i = 0; i < n_discs; ++i)
    f.insert(f.end(), {0., -1., 0.});
  return f;
}

/** Of a triangle of discs, with n_rows in the lowest row. */
SparseRows
contacts_of_pyramid(const int n_rows, const double mu)
{
  const auto disc
    = [&](const int row, const int i) { return row * n_rows - row * (row - 1) / 2 + i; };
  SparseRows contacts;
  for (int i = 0; i < n_rows; ++i)
    add_contact(disc(0, i), -1, 0., 1., mu, contacts);
  for (int row = 1; row < n_rows; ++row)
    for (int i = 0; i < n_rows - row; ++i)
      for (const int side : {0, 1})
        add_contact(disc(row, i), disc(row - 1, i + side), 0.5 - side, std::sqrt(0.75), mu,
                    contacts);
  return contacts;
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

TEST(ConeProjection, CoordinatesThatNoReactionMovesKeepTheirLoads)
{
  // Many reactions in few directions: those that balance all but one load press without limit
  // against the rest.
  for (const double push : {0.1, 0.3, 0.49999, 0.50001, 0.6, 10.})
    for (const double turn : {1e-8, 1e-3, 0.5})
      {
        std::vector<double> columns;
        for (unsigned int i = 0; i < 100; ++i)
          for (const double friction : {-0.5, 0.5})
            columns.insert(columns.end(), {friction, 1., 0.});
        const auto   r         = unbalanced_part({push, -1., turn}, rows_of(columns, 3));
        const double tolerance = 1e-8 * std::hypot(push, 1.); // |f|
        EXPECT_NEAR(r[2], turn, tolerance);
        // to the edge of the cone, (0.5, -1)
        const double over = std::max(0., push - 0.5) / 1.25;
        EXPECT_NEAR(r[0], over, tolerance);
        EXPECT_NEAR(r[1], 0.5 * over, tolerance);
      }
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

TEST(ConeProjection, PyramidOfDiscsStandsByFriction)
{
  struct Case
  {
    int    n_rows; // the discs of a row do not touch
    double mu;
    bool   stands;
  };
  // A disc on two that lie on a floor: its contacts hold if friction bears half of the 30 degrees
  // by which they are inclined, tan 15 degrees = 0.26795. Higher pyramids ask for more.
  for (const auto &[n_rows, mu, stands] :
       {Case{2, 0.267, false}, Case{2, 0.269, true}, Case{45, 0.2, false}, Case{45, 0.8, true}})
    {
      const std::vector<double> f        = weights(n_rows * (n_rows + 1) / 2);
      const SparseRows          contacts = contacts_of_pyramid(n_rows, mu);
      const auto                r        = unbalanced_part(f, contacts);
      const double              lost     = dot(r.data(), r.data(), r.size());
      if (stands)
        EXPECT_LT(lost, 1e-16 * f.size());
      else
        EXPECT_GT(lost, 1e-8 * f.size());
      for (std::size_t j = 0; j < contacts.n_rows(); ++j)
        {
          double slope = 0.;
          for (std::size_t i = contacts.begin[j]; i < contacts.begin[j + 1]; ++i)
            slope += contacts.values[i] * r[contacts.columns[i]];
          EXPECT_GT(slope, -1e-6);
        }
      EXPECT_NEAR(dot(r.data(), f.data(), r.size()), lost, 1e-6);
    }
}
