#include <gtest/gtest.h>

#include <scree/solver/null_space.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

using namespace scree;

namespace
{
/** n masses in a row with springs between them but for `cuts`; those of the first piece are held.
 */
class Springs
{
public:
  Springs(const unsigned int n, const std::vector<unsigned int> &cuts)
  {
    dealii::DynamicSparsityPattern entries(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i == 0 ? 0 : i - 1; j < std::min(n, i + 2); ++j)
        entries.add(i, j);
    pattern.copy_from(entries);
    matrix.reinit(pattern);
    matrix.add(0, 0, 1.);
    for (unsigned int i = 0; i + 1 < n; ++i)
      if (std::find(cuts.begin(), cuts.end(), i) == cuts.end())
        for (const unsigned int k : {i, i + 1})
          for (const unsigned int l : {i, i + 1})
            matrix.add(k, l, k == l ? 1. : -1.);
  }

  dealii::SparsityPattern      pattern;
  dealii::SparseMatrix<double> matrix;
};

void
expect_loose_pieces(const unsigned int n, const std::vector<unsigned int> &cuts)
{
  const Springs springs(n, cuts);
  const auto    vectors = null_space(springs.matrix, 1e-6);
  ASSERT_EQ(vectors.n(), cuts.size());
  // The projection onto the null space: means over the loose pieces.
  for (unsigned int piece = 0; piece < cuts.size(); ++piece)
    {
      const unsigned int begin = cuts[piece] + 1;
      const unsigned int end   = piece + 1 < cuts.size() ? cuts[piece + 1] + 1 : n;
      for (unsigned int i = 0; i < end; i += 3)
        {
          double product = 0.;
          for (unsigned int j = 0; j < vectors.n(); ++j)
            product += vectors(i, j) * vectors(begin, j);
          EXPECT_NEAR(product, i < begin ? 0. : 1. / (end - begin), 1e-8);
        }
    }
}
} // namespace

TEST(NullSpace, FindsLoosePiecesOfSmallAndLargeMatrices)
{
  expect_loose_pieces(60, {});
  expect_loose_pieces(60, {20, 50});
  expect_loose_pieces(400, {});
  expect_loose_pieces(400, {17});
  expect_loose_pieces(400, {30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330, 360});
}

TEST(NullSpace, CountsEigenvaluesUpToTheLimit)
{
  // 4 sin^2((2 k - 1) pi / (4 n + 2)) of a row that is held at one end
  const unsigned int n = 300;
  const Springs      springs(n, {});
  for (const unsigned int k : {1, 5, 20})
    {
      const auto eigenvalue = [&](const double number) {
        return 4. * std::pow(std::sin((2. * number - 1.) * dealii::numbers::PI / (4. * n + 2.)), 2);
      };
      EXPECT_EQ(null_space(springs.matrix, 0.5 * (eigenvalue(k) + eigenvalue(k + 1))).n(), k);
    }
}
