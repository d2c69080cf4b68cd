#include <gtest/gtest.h>

#include <scree/points/point_search.h>

#include <algorithm>

#include "point_clouds.h"

namespace scree
{
namespace
{
using namespace dealii;

// Every query against a search through all points; bins much smaller and larger than the radius.
template <int dim>
void
compare_with_all_points(const Placement placement)
{
  const auto                             cloud = make_cloud<dim>(7, placement, 3);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> anywhere(-0.6, 3.6), radii(0.02, 0.7);
  std::size_t                            n_found = 0;
  for (const double bin_size : {1e-3, 0.1, 10.})
    {
      const PointSearch<dim> search(cloud.position, cloud.body, bin_size);
      for (unsigned int query = 0; query < 300; ++query)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = anywhere(random);
          const double       radius = radii(random);
          const unsigned int body   = query % 3;

          std::vector<unsigned int> found, expected;
          search.for_each_within(body, x, radius, [&](const unsigned int i, const double square) {
            found.push_back(i);
            EXPECT_DOUBLE_EQ(square, x.distance_square(cloud.position[i]));
          });
          double smallest = 1e300;
          for (unsigned int i = 0; i < cloud.position.size(); ++i)
            if (cloud.body[i] == body)
              {
                const double square = x.distance_square(cloud.position[i]);
                smallest            = std::min(smallest, square);
                if (square < radius * radius)
                  expected.push_back(i);
              }
          std::sort(found.begin(), found.end());
          EXPECT_EQ(found, expected);
          n_found += found.size();

          const auto nearest = search.nearest(body, x);
          ASSERT_TRUE(nearest.has_value());
          EXPECT_EQ(cloud.body[*nearest], body);
          EXPECT_DOUBLE_EQ(x.distance_square(cloud.position[*nearest]), smallest);
        }
    }
  EXPECT_GT(n_found, 1000u);
}

TEST(PointSearch, finds_what_a_search_through_all_finds)
{
  for (const auto placement : {Placement::regular, Placement::graded, Placement::irregular})
    {
      compare_with_all_points<2>(placement);
      compare_with_all_points<3>(placement);
    }
}

TEST(PointSearch, bodies_without_points)
{
  const PointSearch<2> search({Point<2>(0, 0), Point<2>(1, 1)}, {0, 2}, 0.1), none({}, {}, 0.1);
  for (const unsigned int body : {1u, 3u})
    EXPECT_FALSE(search.nearest(body, Point<2>()).has_value());
  EXPECT_FALSE(none.nearest(0, Point<2>()).has_value());
  EXPECT_EQ(search.nearest(2, Point<2>(-1e3, 5)).value(), 1u);
}
} // namespace
} // namespace scree
