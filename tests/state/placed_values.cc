// Rows by place: found again whatever process they came from and whatever round-off their place
// has.
#include <gtest/gtest.h>

#include <scree/state/placed_values.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <sstream>

namespace scree
{
namespace
{
using dealii::Point;

/** Rows of a grid of nodes; each process has those of two columns, the middle ones shared. */
PlacedValues<2>
rows_of_nodes(const MPI_Comm communicator)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  PlacedValues<2>    values(2, Point<2>(-1., 3.), 1e-9);
  for (unsigned int i = rank; i < rank + 2; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int body = 0; body < 2; ++body)
        values.add(body, Point<2>(-1. + 0.1 * i, 3. + 0.1 * j), {double(i), 10. * j + body});
  values.gather(communicator);
  return values;
}

void
expect_rows(const PlacedValues<2> &values, const unsigned int n_columns)
{
  ASSERT_EQ(values.size(), n_columns * 6);
  for (unsigned int i = 0; i < n_columns; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int body = 0; body < 2; ++body)
        {
          const Point<2> with_round_off(-1. + 0.1 * i + 1e-14, 3. + 0.1 * j - 1e-14);
          const double  *row = values.find(body, with_round_off);
          ASSERT_NE(row, nullptr);
          EXPECT_EQ(row[0], i);
          EXPECT_EQ(row[1], 10. * j + body);
        }
  EXPECT_EQ(values.find(2, Point<2>(-1., 3.)), nullptr);
  EXPECT_EQ(values.find(0, Point<2>(-1. + 1e-8, 3.)), nullptr);
}

TEST(PlacedValuesMPI, RowsOfAllProcessesAreFoundByPlace)
{
  const auto values = rows_of_nodes(MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    expect_rows(values, 1 + dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
}

TEST(PlacedValues, AnArchiveGivesThemBack)
{
  std::stringstream bytes;
  {
    const PlacedValues<2>           values = rows_of_nodes(MPI_COMM_SELF);
    boost::archive::binary_oarchive archive(bytes);
    archive << values;
  }
  PlacedValues<2>                 values;
  boost::archive::binary_iarchive archive(bytes);
  archive >> values;
  expect_rows(values, 2);
  EXPECT_TRUE(values.is_whole(2));
  EXPECT_FALSE(values.is_whole(1));
}
} // namespace
} // namespace scree
