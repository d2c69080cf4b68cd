// Fields of tractions on contact surfaces.
#include <gtest/gtest.h>

#include <scree/contact/multiplier_field.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

/** Points on y = 0.31 in 0 < x < 1, two in each of n cells, dealt out to the processes. */
std::vector<ContactPoint<2>>
points_on_a_line(const unsigned int n, const bool all)
{
  const unsigned int rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::vector<ContactPoint<2>> points;
  for (unsigned int i = 0; i < 2 * n; ++i)
    if (all || i / 2 % n_ranks == rank)
      {
        const double    place = i % 2 == 0 ? 0.2113248654 : 0.7886751346;
        ContactPoint<2> point;
        point.pair        = 0;
        point.position    = Point<2>((i / 2 + place) / n, 0.31);
        point.normal      = Tensor<1, 2>({0., 1.});
        point.weight      = 0.5 / n;
        point.initial_gap = 0.;
        point.cell_size   = 1. / n;
        points.push_back(point);
      }
  return points;
}

/** The largest error of the field that fits p(x) (0, 1). */
template <typename Pressure>
double
largest_error(const unsigned int n, const Pressure &p)
{
  const auto                points = points_on_a_line(n, false);
  MultiplierField<2>        field(points, MPI_COMM_WORLD);
  std::vector<Tensor<1, 2>> values;
  for (const auto &point : points)
    values.push_back(Tensor<1, 2>({0., p(point.position[0])}));
  const std::vector<bool> closed(points.size(), true);
  field.add_fit(values, closed);
  double error = 0.;
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      values[i] -= field(i);
      error = std::max(error, values[i].norm());
    }
  // What is left has no mean near any node.
  EXPECT_LT(field.largest_mean(values, closed), 1e-9);
  return Utilities::MPI::max(error, MPI_COMM_WORLD);
}

TEST(MultiplierFieldMPI, FitsLinearFunctions)
{
  EXPECT_LT(largest_error(8, [](const double) { return 3.; }), 1e-8);
  EXPECT_LT(largest_error(8, [](const double x) { return 1. + x; }), 1e-8);
}

TEST(MultiplierFieldMPI, ConvergesWithOrderTwo)
{
  const auto   wave   = [](const double x) { return std::sin(3. * x); };
  const double coarse = largest_error(10, wave), fine = largest_error(40, wave);
  std::cout << "errors " << coarse << ", " << fine << ", order " << std::log2(coarse / fine) / 2.
            << std::endl;
  EXPECT_GT(std::log2(coarse / fine), 3.);
}

TEST(MultiplierField, FitsAtSliversToo)
{
  // The last point is one of a surface of a millionth of a cell: its node is hardly seen.
  auto points            = points_on_a_line(8, true);
  points.back().position = Point<2>(1. + 1e-3, 0.31);
  points.back().weight   = 1e-6 / 8;
  MultiplierField<2>        field(points, MPI_COMM_SELF);
  std::vector<Tensor<1, 2>> values;
  for (const auto &point : points)
    values.push_back(Tensor<1, 2>({0., 1. + point.position[0]}));
  values.back()[1] = 50.;
  field.add_fit(values, std::vector<bool>(points.size(), true));
  EXPECT_NEAR(field(points.size() - 1)[1], 50., 1e-2);
  // ... nor does it count as open.
  std::vector<bool> only_sliver(points.size(), false);
  only_sliver.back() = true;
  EXPECT_EQ(field.largest_mean(values, only_sliver), 0.);
}

TEST(MultiplierFieldMPI, IsTheSameOnTwoProcesses)
{
  const auto         all = points_on_a_line(8, true), own = points_on_a_line(8, false);
  MultiplierField<2> alone(all, MPI_COMM_SELF), shared(own, MPI_COMM_WORLD);
  const auto         fit = [](MultiplierField<2> &field, const auto &points) {
    std::vector<Tensor<1, 2>> values;
    std::vector<bool>         closed;
    for (const auto &point : points)
      {
        values.push_back(Tensor<1, 2>({point.position[0], std::sqrt(point.position[0])}));
        closed.push_back(point.position[0] < 0.7);
      }
    field.add_fit(values, closed);
  };
  fit(alone, all);
  fit(shared, own);
  for (unsigned int i = 0, j = 0; i < all.size(); ++i)
    if (j < own.size() && own[j].position == all[i].position)
      {
        EXPECT_LT((alone(i) - shared(j)).norm(), 1e-12);
        ++j;
      }
}

TEST(MultiplierField, FacesThatMeetAtAnEdgeShareNothing)
{
  auto points = points_on_a_line(4, true);
  auto wall   = points;
  for (auto &point : wall)
    {
      point.position = Point<2>(0.02, point.position[0]);
      point.normal   = Tensor<1, 2>({1., 0.});
    }
  const std::size_t n_floor = points.size();
  points.insert(points.end(), wall.begin(), wall.end());
  MultiplierField<2>        field(points, MPI_COMM_SELF);
  std::vector<Tensor<1, 2>> values;
  for (unsigned int i = 0; i < points.size(); ++i)
    values.push_back((i < n_floor ? 1. : 5.) * points[i].normal);
  field.add_fit(values, std::vector<bool>(points.size(), true));
  for (unsigned int i = 0; i < points.size(); ++i)
    EXPECT_LT((field(i) - values[i]).norm(), 2e-2);
}
} // namespace
} // namespace scree
