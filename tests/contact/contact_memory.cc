// What surface points remember: transfer between point sets, motion of the surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>

#include "surface_model.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
void
check_null_transfer()
{
  const auto surface = cylinder<dim>(20., 10., 1., two_points, 0.);
  auto       memory  = memory_of<dim>(surface, wave<dim>(20.));
  // Points of another pair in the same places.
  const std::size_t n = memory.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      memory.body_a.push_back(0);
      memory.body_b.push_back(2);
      memory.position.push_back(memory.position[i]);
      memory.normal.push_back(memory.normal[i]);
      memory.weight.push_back(1.);
      memory.cell_size.push_back(1.);
      memory.tau.push_back(-5. * memory.tau[i]);
      memory.pressure.push_back(7.);
    }
  const auto history
    = recall<dim>(surface.points, one_pair,
                  moved(memory, std::vector<Tensor<1, dim>>(memory.size(), Tensor<1, dim>())));
  ASSERT_EQ(history.tau.size(), n);
  for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_LE((history.tau[i] - memory.tau[i]).norm(), 1e-14);
      EXPECT_NEAR(history.pressure[i], memory.pressure[i], 1e-14);
      EXPECT_EQ(history.jump[i].norm(), 0.);
    }
}

TEST(ContactMemory, NullTransferIsExact)
{
  check_null_transfer<2>();
  check_null_transfer<3>();
}

template <int dim>
Tensor<2, dim>
rotation(const double angle)
{
  const double   c = std::cos(angle), s = std::sin(angle);
  Tensor<2, dim> result;
  result[dim - 1][dim - 1] = 1.;
  result[0][0] = result[1][1] = c;
  result[0][1]                = -s;
  result[1][0]                = s;
  if constexpr (dim == 3)
    // then about x, so that the surface spins about its normal, too
    return Tensor<2, 3>({{1., 0., 0.}, {0., c, -s}, {0., s, c}}) * result;
  return result;
}

/** A large rigid motion carries everything along; what is recalled there turns with it. */
template <int dim>
void
check_rigid_motion()
{
  const auto                  surface = cylinder<dim>(20., 10., 1., two_points, 0.);
  const auto                  memory  = memory_of<dim>(surface, wave<dim>(20.));
  const Tensor<2, dim>        R       = rotation<dim>(0.7);
  std::vector<Tensor<1, dim>> displacement;
  auto                        there = surface;
  for (ContactPoint<dim> &point : there.points)
    {
      Tensor<1, dim> x = R * Tensor<1, dim>(point.position);
      x[0] += 3.;
      displacement.push_back(x - point.position);
      point.position = Point<dim>(x);
      point.normal   = R * point.normal;
    }
  const auto result  = moved(memory, displacement);
  const auto history = recall<dim>(there.points, one_pair, result);
  for (std::size_t i = 0; i < memory.size(); ++i)
    {
      EXPECT_LE((result.normal[i] - R * memory.normal[i]).norm(), 1e-12);
      EXPECT_LE((result.tau[i] - R * memory.tau[i]).norm(), 1e-12);
      EXPECT_NEAR(result.weight[i], memory.weight[i], 1e-12);
      EXPECT_NEAR(result.pressure[i], memory.pressure[i], 1e-12);
      EXPECT_LE((history.tau[i] - R * memory.tau[i]).norm(), 1e-12);
    }
}

TEST(ContactMemory, TurnsWithTheSurface)
{
  check_rigid_motion<2>();
  check_rigid_motion<3>();
}

template <int dim>
void
check_stretch()
{
  // A plane that is stretched by 1.2 along its first tangent, in 3D by 0.9 along the other one.
  const auto                  surface = cylinder<dim>(1e9, 10., 1., two_points, 0.);
  const auto                  memory  = memory_of<dim>(surface, wave<dim>(20.));
  std::vector<Tensor<1, dim>> displacement(memory.size());
  for (std::size_t i = 0; i < memory.size(); ++i)
    {
      displacement[i][1] = 0.2 * memory.position[i][1];
      if (dim == 3)
        displacement[i][dim - 1] = -0.1 * memory.position[i][dim - 1];
    }
  const double area   = dim == 2 ? 1.2 : 1.08;
  const auto   result = moved(memory, displacement);
  for (std::size_t i = 0; i < memory.size(); ++i)
    {
      EXPECT_NEAR(result.weight[i], area * memory.weight[i], 1e-6);
      EXPECT_LE((result.weight[i] * result.tau[i] - memory.weight[i] * memory.tau[i]).norm(), 1e-6);
      EXPECT_NEAR(result.weight[i] * result.pressure[i], memory.weight[i] * memory.pressure[i],
                  1e-6);
    }
}

TEST(ContactMemory, StretchKeepsForces)
{
  check_stretch<2>();
  check_stretch<3>();
}

template <int dim>
void
check_linear()
{
  // Points anywhere on a plane, up to its ends.
  const Traction<dim> tau = [](const std::array<double, dim - 1> &place) {
    Tensor<1, dim - 1> result;
    for (unsigned int k = 0; k < dim - 1; ++k)
      result[k] = 1. + 0.1 * place[k] + 0.02 * place[0];
    return result;
  };
  const auto from     = cylinder<dim>(1e9, 10., 1., two_points, 0.),
             to       = cylinder<dim>(1e9, 10., 0.8, three_points, 0.3);
  const auto memory   = memory_of<dim>(from, tau);
  const auto history  = recall<dim>(to.points, one_pair, memory);
  const auto expected = tractions<dim>(to, tau);
  double     largest  = 0.;
  for (const auto &old : memory.tau)
    largest = std::max(largest, old.norm());
  unsigned int n_checked = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (expected[i].norm() < largest && to.place[i][0] > 0.3 && to.place[i][dim - 2] > 0.3)
      {
        ++n_checked;
        EXPECT_LE((history.tau[i] - expected[i]).norm(), 2e-7);
      }
  EXPECT_GT(n_checked, 0.8 * expected.size());
}

TEST(ContactMemory, ReproducesLinearTractionsOnPlanes)
{
  check_linear<2>();
  check_linear<3>();
}

/**
 * Errors of one transfer of a wave between shifted point sets on a cylinder: of tau, in the inside
 * and within a cell of the ends, and of the force.
 */
struct TransferError
{
  double inside, at_ends, force;
};

template <int dim>
TransferError
transfer_wave(const double wave_length, const double h)
{
  const auto         tau  = wave<dim>(wave_length);
  const double       L    = 0.5 * wave_length;
  const Surface<dim> from = cylinder<dim>(wave_length, L, h, two_points, 0.),
                     to   = cylinder<dim>(wave_length, L, h, three_points, 0.37);
  const auto     memory   = memory_of<dim>(from, tau);
  const auto     history  = recall<dim>(to.points, one_pair, memory);
  const auto     expected = tractions<dim>(to, tau);
  TransferError  error{0., 0., 0.};
  Tensor<1, dim> before, after;
  for (std::size_t i = 0; i < memory.size(); ++i)
    before += memory.weight[i] * memory.tau[i];
  for (std::size_t i = 0; i < expected.size(); ++i)
    {
      const double difference = (history.tau[i] - expected[i]).norm();
      const auto  &place      = to.place[i];
      const bool   is_inside
        = std::min(place[0], place[dim - 2]) > h && std::max(place[0], place[dim - 2]) < L - h;
      double &largest = is_inside ? error.inside : error.at_ends;
      largest         = std::max(largest, difference);
      after += to.points[i].weight * history.tau[i];
    }
  error.force = (after - before).norm() / before.norm();
  return error;
}

template <int dim>
void
check_order()
{
  TransferError previous{};
  for (unsigned int n = 20; n <= 80; n *= 2)
    {
      const TransferError error = transfer_wave<dim>(20., 20. / n);
      std::cout << "  " << dim << "D, " << n << " cells per wave: largest error inside "
                << error.inside << ", at the ends " << error.at_ends << ", force " << error.force
                << "\n";
      EXPECT_LE(error.force, 0.005);
      if (n > 20)
        {
          EXPECT_GE(std::log2(previous.inside / error.inside), 2.);
          EXPECT_LE(error.force, 0.5 * previous.force);
        }
      previous = error;
    }
}

TEST(ContactMemory, ErrorIsOfSecondOrderOrBetter)
{
  check_order<2>();
  check_order<3>();
}

/** Half an ellipse of half width 4 about the place 10, as in Hertz's contact. */
Tensor<1, 1>
ellipse(const std::array<double, 1> &place)
{
  const double x = (place[0] - 10.) / 4.;
  return Tensor<1, 1>({std::sqrt(std::max(0., 1. - x * x))});
}

/** Changes of the force and of the largest traction after 50 transfers between shifted points. */
std::pair<double, double>
after_many_transfers(const Traction<2> &tau, const double L, const double h)
{
  auto       surface = cylinder<2>(2. * L, L, h, two_points, 0.);
  auto       memory  = memory_of<2>(surface, tau);
  const auto force   = [](const ContactMemory<2> &m) {
    Tensor<1, 2> sum;
    for (std::size_t i = 0; i < m.size(); ++i)
      sum += m.weight[i] * m.tau[i];
    return sum;
  };
  const Tensor<1, 2> before  = force(memory);
  double             largest = 0.;
  for (unsigned int step = 1; step <= 50; ++step)
    {
      surface            = cylinder<2>(2. * L, L, h, two_points, std::fmod(0.37 * step, 1.));
      const auto history = recall<2>(surface.points, one_pair, memory);
      memory             = memory_of<2>(surface, tau);
      memory.tau         = history.tau;
    }
  for (const auto &t : memory.tau)
    largest = std::max(largest, t.norm());
  return {(force(memory) - before).norm() / before.norm(), largest - 1.};
}

TEST(ContactMemory, ManyTransfersKeepTheTraction)
{
  const auto [force, largest] = after_many_transfers(wave<2>(20.), 10., 1.);
  std::cout << "  50 transfers, wave of 20 cells: change of force " << force << ", largest "
            << largest << "\n";
  EXPECT_LE(force, 0.005);
  EXPECT_LE(std::abs(largest), 0.02);
  const auto [hertz_force, hertz_largest] = after_many_transfers(ellipse, 20., 0.5);
  std::cout << "  50 transfers, 8 cells per half width: change of force " << hertz_force
            << ", largest " << hertz_largest << "\n";
  EXPECT_LE(hertz_force, 0.005);
  EXPECT_LE(std::abs(hertz_largest), 0.02);
}

TEST(ContactMemory, EndsOfContact)
{
  // tau of Hertz, half width 4: with the open points around it, and where the surface ends instead.
  const Traction<2> tau  = ellipse;
  const auto        from = cylinder<2>(40., 20., 0.5, two_points, 0.),
             to          = cylinder<2>(40., 20., 0.5, two_points, 0.4);
  for (const bool with_open : {true, false})
    {
      Surface<2> remembered;
      for (unsigned int i = 0; i < from.points.size(); ++i)
        if (with_open || tau(from.place[i])[0] > 0.)
          {
            remembered.points.push_back(from.points[i]);
            remembered.place.push_back(from.place[i]);
            remembered.tangent.push_back(from.tangent[i]);
          }
      const auto memory  = memory_of<2>(remembered, tau);
      const auto history = recall<2>(to.points, one_pair, memory);
      double     before = 0., after = 0., inside = 0.;
      for (unsigned int i = 0; i < memory.size(); ++i)
        before += memory.weight[i] * memory.tau[i].norm();
      for (unsigned int i = 0; i < to.points.size(); ++i)
        {
          const double x     = to.place[i][0] - 10.;
          const double value = history.tau[i] * to.tangent[i][0];
          EXPECT_LE(value, 1.);
          // With open points the interpolation swings by a little where contact ends. Without them
          // it goes on for two cells.
          const double end = 4. + (with_open ? 0.5 : 1.);
          if (std::abs(x) > end)
            {
              EXPECT_LE(std::abs(value), with_open ? 0.01 : 0.);
            }
          EXPECT_GE(value, with_open ? -0.02 : 0.);
          after += to.points[i].weight * value;
          if (std::abs(x) < 4.)
            inside += to.points[i].weight * value;
        }
      std::cout << "  force after transfer / before: " << after / before << ", inside "
                << inside / before << "\n";
      EXPECT_NEAR((with_open ? after : inside) / before, 1., 0.01);
    }
}

TEST(ContactMemory, OppositeSidesOfAPlateDoNotMix)
{
  const Traction<2> one     = [](const auto &) { return Tensor<1, 1>({1.}); };
  const auto        surface = cylinder<2>(1e9, 5., 1., two_points, 0.);
  auto              memory  = memory_of<2>(surface, one);
  const std::size_t n       = memory.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      memory.body_a.push_back(0);
      memory.body_b.push_back(1);
      memory.position.push_back(memory.position[i] - 0.3 * memory.normal[i]);
      memory.normal.push_back(-memory.normal[i]);
      memory.weight.push_back(1.);
      memory.cell_size.push_back(1.);
      memory.tau.push_back(-memory.tau[i]);
      memory.pressure.push_back(0.);
    }
  const auto to      = cylinder<2>(1e9, 5., 1., two_points, 0.3);
  const auto history = recall<2>(to.points, one_pair, memory);
  for (std::size_t i = 0; i < to.points.size(); ++i)
    {
      EXPECT_NEAR(history.tau[i] * to.tangent[i][0], 1., 1e-12);
      EXPECT_NEAR(history.pressure[i], 3., 1e-12);
    }
}

TEST(ContactMemory, LonelyPoints)
{
  // One old point: its value nearby, turned into the new plane; nothing far away.
  ContactMemory<3> memory;
  EXPECT_EQ(recall<3>({}, one_pair, memory).tau.size(), 0u);
  memory.body_a        = {0};
  memory.body_b        = {1};
  memory.position      = {Point<3>()};
  memory.normal        = {Tensor<1, 3>({0., 0., 1.})};
  memory.weight        = {1.};
  memory.cell_size     = {1.};
  memory.tau           = {Tensor<1, 3>({3., 4., 0.})};
  memory.pressure      = {6.};
  const double       c = std::cos(0.5), s = std::sin(0.5);
  const Tensor<1, 3> n({s, 0., c});
  const auto         history = recall<3>(
    {{0, Point<3>(0.4, 0., 0.1), n, 1., 0., 1.}, {0, Point<3>(3., 0., 0.), n, 1., 0., 1.}},
    one_pair, moved(memory, {Tensor<1, 3>({0., 0., 0.1})}));
  EXPECT_LE((history.tau[0] - Tensor<1, 3>({3. * c, 4., -3. * s})).norm(), 1e-14);
  EXPECT_NEAR(history.pressure[0], 6., 1e-14);
  EXPECT_EQ(history.tau[1].norm(), 0.);
  EXPECT_EQ(history.pressure[1], 0.);
}

template <int dim>
void
time_transfer(const std::vector<double> &cell_sizes)
{
  std::vector<double> per_point;
  for (const double h : cell_sizes)
    {
      const auto tau     = wave<dim>(1.);
      const auto from    = cylinder<dim>(1., 1., h, two_points, 0.),
                 to      = cylinder<dim>(1., 1., h, two_points, 0.37);
      const auto memory  = memory_of<dim>(from, tau);
      auto       start   = std::clock();
      const auto seconds = [&start] { return double(std::clock() - start) / CLOCKS_PER_SEC; };
      const auto result
        = moved(memory, std::vector<Tensor<1, dim>>(memory.size(), Tensor<1, dim>()));
      const double moving    = seconds();
      start                  = std::clock();
      const auto   history   = recall<dim>(to.points, one_pair, result);
      const double recalling = seconds();
      ASSERT_EQ(history.tau.size(), to.points.size());
      std::cout << "  " << dim << "D, " << memory.size()
                << " points, microseconds per point: moved " << 1e6 * moving / memory.size()
                << ", recall " << 1e6 * recalling / to.points.size() << "\n";
      per_point.push_back((moving + recalling) / memory.size());
    }
  // A search through all points would take a hundred times longer.
  EXPECT_LE(per_point.back(), 5. * per_point.front());
}

TEST(ReleaseContactMemory, TimePerPoint)
{
  time_transfer<2>({2e-3, 2e-5});
  time_transfer<3>({5e-2, 5e-3});
}
} // namespace
} // namespace scree
