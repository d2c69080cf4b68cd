#include <gtest/gtest.h>

#include <scree/points/material_points.h>
#include <scree/points/migration.h>
#include <scree/points/splitting.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <cmath>
#include <iostream>
#include <sstream>

namespace scree
{
namespace
{
using namespace dealii;

// n^dim points per body on the unit box, bodies side by side, every quantity a number of its own.
template <int dim>
MaterialPoints<dim>
make_points(const unsigned int n, const unsigned int n_bodies, const unsigned int n_internal)
{
  MaterialPoints<dim> points(n_internal);
  const unsigned int  n_points = dim == 2 ? n * n : n * n * n;
  for (unsigned int b = 0; b < n_bodies; ++b)
    for (unsigned int i = 0; i < n_points; ++i)
      {
        Point<dim>   x;
        unsigned int rest = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= n)
          x[d] = (rest % n + 0.5) / n;
        x[0] += b;
        points.add(x, b, 1. / n_points, 1. / n, (b + 1.) / n_points);
        for (unsigned int d = 0; d < dim; ++d)
          {
            points.velocity.back()[d] = 0.1 * d + x[0];
            points.deformation_gradient.back()[d][dim - 1] += 0.01 * x[d];
            points.stress.back()[d][d] = 100. * d + x[1];
          }
        points.out_of_plane_stress.back() = 7. * x[0] - x[1];
        for (unsigned int k = 0; k < n_internal; ++k)
          points.internal[points.internal.size() - n_internal + k] = 1000. * k + i;
      }
  return points;
}

template <int dim>
void
expect_equal(const MaterialPoints<dim> &a, const MaterialPoints<dim> &b)
{
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.n_internal(), b.n_internal());
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.reference_position, b.reference_position);
  EXPECT_EQ(a.initial_volume, b.initial_volume);
  EXPECT_EQ(a.initial_spacing, b.initial_spacing);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.deformation_gradient, b.deformation_gradient);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.out_of_plane_stress, b.out_of_plane_stress);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.internal, b.internal);
  EXPECT_EQ(a.body, b.body);
}

template <int dim>
void
check_storage()
{
  const auto         points = make_points<dim>(3, 2, 4);
  std::ostringstream out;
  {
    boost::archive::binary_oarchive archive(out);
    archive                        &points;
  }
  MaterialPoints<dim> restored;
  {
    std::istringstream              in(out.str());
    boost::archive::binary_iarchive archive(in);
    archive                        &restored;
  }
  expect_equal(points, restored);

  std::vector<double> message;
  MaterialPoints<dim> unpacked(4);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.pack(i, message);
  EXPECT_EQ(message.size(), points.size() * points.n_values());
  for (std::size_t i = 0; i < points.size(); ++i)
    unpacked.unpack(&message[i * points.n_values()]);
  expect_equal(points, unpacked);

  // every third point removed, by keep() and by copying the others
  std::vector<bool>   kept(points.size());
  MaterialPoints<dim> copied(4), removed = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((kept[i] = i % 3 != 1))
      copied.add_copy(points, i);
  removed.keep(kept);
  expect_equal(copied, removed);
  EXPECT_LT(removed.size(), points.size());
}

TEST(MaterialPoints, storage)
{
  check_storage<2>();
  check_storage<3>();
}

// A homogeneous deformation in steps: F, x and V follow the product of the increments.
TEST(MaterialPoints, move)
{
  MaterialPoints<3> points(0);
  points.add(Point<3>(1, 2, 3), 0, 2., 0.1, 5.);
  points.add(Point<3>(-1, 0, 1), 1, 0.5, 0.2, 3.);
  points.velocity[1][2] = 4.;
  Tensor<2, 3> expected = unit_symmetric_tensor<3>();
  for (unsigned int step = 0; step < 20; ++step)
    {
      Tensor<2, 3> gradient;
      for (unsigned int i = 0; i < 9; ++i)
        gradient[i / 3][i % 3] = 0.03 * std::sin(7. * step + i);
      std::vector<Tensor<1, 3>> increment;
      for (const auto &x : points.position)
        increment.push_back(gradient * x);
      EXPECT_EQ(points.move(increment, {gradient, gradient}), 0u);
      expected = (unit_symmetric_tensor<3>() + gradient) * expected;
    }
  EXPECT_GT((expected - unit_symmetric_tensor<3>()).norm(), 0.1);
  for (unsigned int i = 0; i < 2; ++i)
    {
      EXPECT_LT((points.deformation_gradient[i] - expected).norm(), 1e-14);
      EXPECT_LT((points.position[i] - expected * Tensor<1, 3>(points.reference_position[i])).norm(),
                1e-13);
    }
  const auto totals = points.totals(3);
  EXPECT_EQ(totals[0].count, 1u);
  EXPECT_EQ(totals[1].mass, 3.);
  EXPECT_EQ(totals[1].momentum[2], 12.);
  EXPECT_EQ(totals[1].initial_volume, 0.5);
  EXPECT_NEAR(totals[0].volume, 2. * determinant(expected), 1e-13);
  EXPECT_EQ(totals[2].count, 0u);

  // a point turned inside out, and one that is not a number, are counted
  Tensor<2, 3> inverting, undefined;
  inverting[0][0] = -2.;
  undefined[1][1] = std::nan("");
  EXPECT_EQ(points.move(std::vector<Tensor<1, 3>>(2), {inverting, undefined}), 2u);
}

TEST(MaterialPoints, sums_do_not_depend_on_the_order_of_many_points)
{
  // 0.1 is no binary fraction: plain sums of 3e5 terms would differ by 1e-12 and more.
  constexpr unsigned int n = 300000;
  MaterialPoints<2>      forwards, backwards;
  for (unsigned int i = 0; i < n; ++i)
    for (const bool is_forwards : {true, false})
      {
        const unsigned int k      = is_forwards ? i : n - 1 - i;
        MaterialPoints<2> &points = is_forwards ? forwards : backwards;
        points.add(Point<2>(), 0, 0.1 * (1. + 1e-3 * (k % 977)), 0.1, 1. / (1. + k % 13));
      }
  const auto a = forwards.totals(1)[0], b = backwards.totals(1)[0];
  EXPECT_NEAR(a.mass, b.mass, 1e-15 * a.mass);
  EXPECT_NEAR(a.initial_volume, b.initial_volume, 1e-15 * a.initial_volume);
}

TEST(MaterialPoints, spacing_follows_the_largest_stretch)
{
  MaterialPoints<2> points(0);
  points.add(Point<2>(), 0, 1., 0.5, 1.);
  const double c = std::cos(0.7), s = std::sin(0.7);
  Tensor<2, 2> rotation({{c, -s}, {s, c}}), stretch({{0.8, 0.}, {0., 3.}});
  points.deformation_gradient[0] = rotation * stretch;
  EXPECT_NEAR(points.spacing(0), 1.5, 1e-14);
  // tiny shears at equal stretches
  for (double shear = 1e-6; shear > 1e-12; shear *= 0.37)
    {
      points.deformation_gradient[0] = Tensor<2, 2>({{1.1, shear}, {0.3 * shear, 1.1}});
      EXPECT_NEAR(points.spacing(0), 0.55, 1e-6);
    }
}

// Splitting keeps mass, initial volume and momentum, reproduces linear fields, and leaves no point
// too far from its neighbours. Two generations in one quarter of the box.
template <int dim>
void
check_splitting()
{
  constexpr unsigned int n      = 6;
  auto                   points = make_points<dim>(n, 2, 2);
  // Linear in x like the other quantities
  for (std::size_t i = 0; i < points.size(); ++i)
    points.internal[2 * i] = points.internal[2 * i + 1] = points.position[i][0];
  const auto          before = points.totals(2);
  const auto          old    = points;
  std::vector<double> cell_size;
  for (const auto &x : points.position)
    cell_size.push_back((x[0] < 0.5 && x[1] < 0.5 ? 0.6 : 2.1) / n);
  const auto report = split_points<dim>(
    points, cell_size, 2, {1, 1.75}, [](const MaterialPoints<dim> &own) { return own; },
    MPI_COMM_SELF);

  const unsigned int n_first  = before[0].count / 4; // points of the quarter, two generations
  const unsigned int children = 1 << dim;
  EXPECT_EQ(report.n_split, n_first * (1 + children));
  EXPECT_EQ(points.size(), old.size() + n_first * (children * children - 1));
  EXPECT_EQ(report.transfer.lowered, 0u);
  const auto after = points.totals(2);
  for (unsigned int b = 0; b < 2; ++b)
    {
      // equal up to the round-off of the sums themselves
      const double round_off = 1.2e-16 * after[b].count;
      EXPECT_NEAR(after[b].mass, before[b].mass, round_off * before[b].mass);
      EXPECT_NEAR(after[b].initial_volume, before[b].initial_volume, round_off);
      EXPECT_NEAR((after[b].momentum - before[b].momentum).norm(), 0., 1e-13);
      EXPECT_NEAR(after[b].volume, before[b].volume, 1e-3);
    }
  double error = 0.;
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto &x = points.position[i];
      for (unsigned int d = 0; d < dim; ++d)
        {
          error = std::max(error, std::abs(points.deformation_gradient[i][d][dim - 1]
                                           - (d == dim - 1) - 0.01 * x[d]));
          error = std::max(error, std::abs(points.stress[i][d][d] - 100. * d - x[1]));
          error = std::max(error, std::abs(points.velocity[i][d] - 0.1 * d - x[0]));
        }
      error = std::max(error, std::abs(points.out_of_plane_stress[i] - 7. * x[0] + x[1]));
      error = std::max(error, std::abs(points.internal[2 * i + 1] - x[0]));
      if (x[0] < 0.5 && x[1] < 0.5)
        {
          EXPECT_LT(points.spacing(i), 0.26 / n);
        }
    }
  std::cout << "  " << dim << "D: error of linear fields after two divisions " << error
            << std::endl;
  EXPECT_LT(error, 1e-10);
}

TEST(Splitting, keeps_sums_and_linear_fields)
{
  check_splitting<2>();
  check_splitting<3>();
}

// Every point goes where it should with all it carries, and back: nothing is lost.
template <int dim>
void
check_migration()
{
  const MPI_Comm     comm        = MPI_COMM_WORLD;
  const unsigned int me          = Utilities::MPI::this_mpi_process(comm);
  const unsigned int n_processes = Utilities::MPI::n_mpi_processes(comm);
  auto               points      = make_points<dim>(5 + me, 2, 3);
  for (auto &x : points.reference_position)
    x[1] += 10. * me; // marks the origin
  const auto before = points.totals(2, comm);
  const auto owner  = [&](const Point<dim> &x) {
    return std::min(static_cast<unsigned int>(x[dim - 1] * n_processes), n_processes - 1);
  };
  const auto n_sent = send_to_owners<dim>(points, owner, comm);
  EXPECT_EQ(n_sent > 0, n_processes > 1);
  for (const auto &x : points.position)
    EXPECT_EQ(owner(x), me);
  const auto after = points.totals(2, comm);
  for (unsigned int b = 0; b < 2; ++b)
    {
      EXPECT_EQ(after[b].count, before[b].count);
      EXPECT_NEAR(after[b].mass, before[b].mass, 1e-13);
      EXPECT_NEAR(after[b].volume, before[b].volume, 1e-13);
      EXPECT_NEAR((after[b].momentum - before[b].momentum).norm(), 0., 1e-13);
    }
  EXPECT_EQ(send_to_owners<dim>(points, owner, comm), 0u);

  // back to where the reference position says; the order of the points may differ
  for (std::size_t i = 0; i < points.size(); ++i)
    std::swap(points.position[i], points.reference_position[i]);
  send_to_owners<dim>(
    points, [](const Point<dim> &x) { return static_cast<unsigned int>(x[1] / 10.); }, comm);
  const auto original = make_points<dim>(5 + me, 2, 3);
  ASSERT_EQ(points.size(), original.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t n_per_body = original.size() / 2;
      const std::size_t k          = points.internal[3 * i] + points.body[i] * n_per_body;
      EXPECT_EQ(points.reference_position[i], original.position[k]);
      EXPECT_EQ(points.velocity[i], original.velocity[k]);
      EXPECT_EQ(points.deformation_gradient[i], original.deformation_gradient[k]);
      EXPECT_EQ(points.stress[i], original.stress[k]);
      EXPECT_EQ(points.out_of_plane_stress[i], original.out_of_plane_stress[k]);
      EXPECT_EQ(points.internal[3 * i + 2], original.internal[3 * k + 2]);
    }
}

TEST(MigrationMPI, nothing_is_lost)
{
  check_migration<2>();
  check_migration<3>();
}

/** The points in the slab of this process. */
template <int dim>
MaterialPoints<dim>
own_slab(const MaterialPoints<dim> &all)
{
  const unsigned int  n_processes = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  MaterialPoints<dim> own(all.n_internal());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::min(static_cast<unsigned int>(all.position[i][0] * n_processes), n_processes - 1)
        == Utilities::MPI::this_mpi_process(MPI_COMM_WORLD))
      own.add_copy(all, i);
  return own;
}

/** The processes whose slabs are nearer than a radius. */
template <int dim>
std::function<std::vector<unsigned int>(const Point<dim> &)>
takers_within(const double radius)
{
  return [radius](const Point<dim> &x) {
    const unsigned int        n_processes = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::vector<unsigned int> ranks;
    for (unsigned int rank = 0; rank < n_processes; ++rank)
      if (x[0] > double(rank) / n_processes - radius
          && x[0] < double(rank + 1) / n_processes + radius)
        ranks.push_back(rank);
    return ranks;
  };
}

// Moving least squares from own points and copies of the others' near the boundary between the
// processes are those from all points.
template <int dim>
void
check_neighbours()
{
  const MPI_Comm      comm        = MPI_COMM_WORLD;
  const unsigned int  me          = Utilities::MPI::this_mpi_process(comm);
  const unsigned int  n_processes = Utilities::MPI::n_mpi_processes(comm);
  const double        cell_size = 0.1, radius = 1.75 * cell_size, slab = 1. / n_processes;
  const auto          all    = make_points<dim>(12, 1, 1);
  MaterialPoints<dim> own    = own_slab(all);
  const auto          takers = takers_within<dim>(radius);
  const auto          others = neighbours_from_others<dim>(own, takers, comm);
  EXPECT_EQ(others.size() > 0, n_processes > 1);
  EXPECT_LT(own.size() + others.size(), all.size() + (n_processes == 1));
  for (std::size_t i = 0; i < others.size(); ++i)
    own.add_copy(others, i);

  Targets<dim> targets;
  for (unsigned int i = 0; i <= 10; ++i)
    {
      Point<dim> x;
      x[0] = (me + 0.1 * i) * slab;
      x[1] = 0.4 + 0.03 * i;
      targets.position.push_back(x);
      targets.body.push_back(0);
      targets.cell_size.push_back(cell_size);
    }
  const auto value = [&](const MaterialPoints<dim> &points) {
    return moving_least_squares(points, {0, 1.75}).weights(targets).values(points.internal, 1);
  };
  const auto from_all = value(all), from_near = value(own);
  for (std::size_t t = 0; t < from_all.size(); ++t)
    EXPECT_NEAR(from_near[t], from_all[t], 1e-9);
}

TEST(MigrationMPI, neighbours_of_targets)
{
  check_neighbours<2>();
  check_neighbours<3>();
}

// Points that are divided beside those of other processes get what they get on one.
TEST(MigrationMPI, Division)
{
  constexpr unsigned int n   = 12;
  auto                   all = make_points<2>(n, 1, 1);
  for (std::size_t i = 0; i < all.size(); ++i)
    all.internal[i] = std::exp(2. * all.position[i][0]);
  auto       own = own_slab(all);
  const auto divide
    = [&](MaterialPoints<2> &points, const auto &with_neighbours, const MPI_Comm comm) {
        split_points<2>(points, std::vector<double>(points.size(), 1. / n), 2, {1, 1.75},
                        with_neighbours, comm);
      };
  divide(
    all, [](const MaterialPoints<2> &points) { return points; }, MPI_COMM_SELF);
  divide(
    own,
    [](const MaterialPoints<2> &points) {
      auto       cloud  = points;
      const auto others = neighbours_from_others<2>(points, takers_within<2>(0.5), MPI_COMM_WORLD);
      for (std::size_t i = 0; i < others.size(); ++i)
        cloud.add_copy(others, i);
      return cloud;
    },
    MPI_COMM_WORLD);
  const auto expected = own_slab(all);
  ASSERT_EQ(own.size(), expected.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    {
      EXPECT_NEAR((own.position[i] - expected.position[i]).norm(), 0., 1e-14);
      EXPECT_NEAR(own.internal[i], expected.internal[i], 1e-12);
    }
}
} // namespace
} // namespace scree
