// Extension, advection and reinitialisation limited to narrow bands.
#include <gtest/gtest.h>

#include <scree/level_set/extension.h>
#include <scree/level_set/reinitialisation.h>

#include <cmath>
#include <limits>

#include "shapes.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
double
ball(const Point<dim> &x)
{
  return x.norm() - 0.53;
}

template <int dim>
void
check_extension(const double h, const Extrapolation extrapolation)
{
  const auto        lattice = sampled<dim>(h, 1, ball<dim>);
  std::vector<char> known;
  for (const double value : lattice.values())
    known.push_back(value < 0);
  auto everywhere = vectors(lattice, [](const Point<dim> &x) {
    Tensor<1, dim> v = 0.3 * Tensor<1, dim>(x);
    v[0] += std::sin(3 * x[1]);
    return v;
  });
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i])
      for (auto &component : everywhere)
        component[i] = std::numeric_limits<double>::quiet_NaN();
  auto                 in_band = everywhere;
  const ExtensionCount all     = extend(lattice, known, {extrapolation}, everywhere);
  const ExtensionCount count   = extend(lattice, known, {extrapolation, 6.}, in_band);
  std::size_t          n       = 0;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (lattice.values()[i] <= 6 * h)
      {
        n += !known[i];
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_EQ(in_band[d][i], everywhere[d][i]);
      }
    else
      EXPECT_TRUE(std::isnan(in_band[0][i]));
  EXPECT_EQ(count.n_extended, n);
  EXPECT_GT(all.n_extended, 2 * n);
}

// What is in the band gets the same values to the last bit, the rest none.
TEST(Bands, ExtensionIsTheSameInABand)
{
  for (const auto extrapolation : {Extrapolation::constant, Extrapolation::linear})
    {
      check_extension<2>(0.02, extrapolation);
      check_extension<3>(0.05, extrapolation);
    }
}

TEST(Bands, NodesThatNothingLeadsToKeepTheirValues)
{
  auto lattice = sampled<2>(0.05, 1, [](const Point<2> &x) { return std::abs(x[0]) - 0.5; });
  std::vector<char> known;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    known.push_back(lattice.node(lattice.index(i))[0] < -0.52); // one of two sides
  std::array<std::vector<double>, 1> v;
  v[0].assign(known.size(), 3.);
  const ExtensionCount count = extend(lattice, known, {Extrapolation::constant, 4.}, v);
  EXPECT_GT(count.n_extended, 0u);
  EXPECT_LT(count.n_extended, count.n_upstream);
  for (const double value : v[0])
    EXPECT_DOUBLE_EQ(value, 3.);
}

template <int dim>
void
check_reinitialisation(const double h)
{
  const auto steep = sampled<dim>(h, 1, [](const Point<dim> &x) { return 1.2 * ball<dim>(x); });
  auto       everywhere = steep, in_band = steep;
  const ReinitialisationCount all   = reinitialise(everywhere);
  const ReinitialisationCount count = reinitialise(in_band, {0.1, 3, 16.});
  EXPECT_EQ(count.n_changed_near, all.n_changed_near);
  EXPECT_EQ(count.contour_motion, all.contour_motion);
  EXPECT_LT(count.n_changed_far, all.n_changed_far);
  for (std::size_t i = 0; i < steep.values().size(); ++i)
    EXPECT_EQ(in_band.values()[i], std::abs(everywhere.values()[i]) <= 16 * h
                                     ? everywhere.values()[i]
                                     : steep.values()[i]);
  // the slope jumps at the edge of the band: marched again, the values are the same
  const Lattice<dim> once = in_band;
  EXPECT_EQ(reinitialise(in_band, {0.1, 3, 16.}).n_changed_near, 0u);
  for (std::size_t i = 0; i < steep.values().size(); ++i)
    EXPECT_NEAR(in_band.values()[i], once.values()[i], 1e-14);
}

TEST(Bands, ReinitialisationIsTheSameInABand)
{
  check_reinitialisation<2>(0.02);
  check_reinitialisation<3>(0.04);
}

// Load steps with everything in bands: a disc goes half its radius and is turned on the way; the
// increment is known in the disc only.
TEST(Bands, LoadStepsFollowTheBody)
{
  const double h       = 1. / 64;
  const auto   disc    = [](const Point<2> &x) { return (x + Point<2>(0.15, 0)).norm() - 0.3; };
  auto         lattice = sampled<2>(h, 1, disc), whole = lattice;
  const int    n_steps   = 40;
  unsigned int n_marched = 0;
  for (int step = 0; step < n_steps; ++step)
    {
      const double   c = std::cos(0.05), s = std::sin(0.05);
      const Point<2> centre(-0.15 + 0.3 * step / n_steps, 0);
      const auto     move = [&](Lattice<2> &phi, const double extension, const double advection,
                            const double reinitialisation) {
        std::vector<char> known;
        for (const double value : phi.values())
          known.push_back(value < 1.5 * h);
        auto du = vectors(phi, [&](const Point<2> &x) {
          const Tensor<1, 2> r = x - centre;
          return Tensor<1, 2>(
            {c * r[0] - s * r[1] - r[0] + 0.3 / n_steps, s * r[0] + c * r[1] - r[1]});
        });
        for (std::size_t i = 0; i < known.size(); ++i)
          if (!known[i])
            du[0][i] = du[1][i] = 0;
        extend(phi, known, {Extrapolation::linear, extension}, du);
        AdvectionScheme scheme;
        scheme.band = advection;
        EXPECT_EQ(
              advect_increment<2>(phi, du, IncrementMotion::semi_lagrangian, scheme).n_unconverged, 0u);
        return reinitialise(phi, {0.1, 3, reinitialisation});
      };
      n_marched += move(lattice, 17, 10, 17).n_changed_far > 0;
      const double all = std::numeric_limits<double>::infinity();
      move(whole, all, all, all);
    }
  double in_band = 0, everywhere = 0, slope = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      const Point<2> x     = lattice.node(lattice.index(i));
      const double   exact = (x - Point<2>(0.15, 0)).norm() - 0.3;
      if (std::abs(exact) < 2 * h)
        {
          in_band    = std::max(in_band, std::abs(lattice.values()[i] - exact));
          everywhere = std::max(everywhere, std::abs(whole.values()[i] - exact));
        }
      if (std::abs(exact) < 6 * h)
        slope = std::max(slope, std::abs(lattice.values()[i] - exact));
    }
  std::cout << "error/h near the contour " << in_band / h << " in bands, " << everywhere / h
            << " everywhere, " << slope / h << " within 6 h; marched in " << n_marched
            << " steps of " << n_steps << '\n';
  EXPECT_LT(in_band, 0.02 * h);
  EXPECT_LT(slope, 0.2 * h);
  EXPECT_GT(n_marched, 0u);
}

// The image of the initial level set: the same numbers in the band as everywhere, and nearly so
// beyond, for a displacement that turns and stretches.
template <int dim>
void
check_image(const double h)
{
  const auto        ball       = [](const Point<dim> &x) { return x.norm() - 0.4; };
  const auto        initial    = sampled<dim>(h, 1, ball);
  auto              everywhere = initial, in_band = initial;
  const auto        du = vectors(initial, [](const Point<dim> &x) {
    return 1.05 * (turned<dim>(x, 0.03) + 0.01 * Point<dim>::unit_vector(1)) - x;
  });
  const auto        u  = vectors(initial, [](const Point<dim> &x) {
    return Tensor<1, dim>(0.02 * x[1] * Point<dim>::unit_vector(0));
  });
  NodalVectors<dim> whole, part;
  const double      half_width = 8. * h;
  EXPECT_EQ(image_of_initial<dim>(everywhere, initial, du, u, whole).n_unconverged, 0u);
  const auto count = image_of_initial<dim>(in_band, initial, du, u, part, half_width);
  EXPECT_EQ(count.n_unconverged, 0u);
  EXPECT_LT(count.n_nodes, initial.values().size());
  double difference = 0.;
  for (std::size_t i = 0; i < initial.values().size(); ++i)
    {
      if (std::abs(initial.values()[i]) <= half_width)
        {
          EXPECT_EQ(in_band.values()[i], everywhere.values()[i]);
          for (unsigned int d = 0; d < dim; ++d)
            EXPECT_EQ(part[d][i], whole[d][i]);
        }
      difference = std::max(difference, std::abs(in_band.values()[i] - everywhere.values()[i]));
      EXPECT_EQ(in_band.values()[i] < 0., everywhere.values()[i] < 0.);
    }
  std::cout << "largest difference beyond " << difference / h << " h\n";
  EXPECT_LT(difference, 0.5 * h);
}

TEST(Bands, ImageOfTheInitialLevelSetIsTheSameInABand)
{
  check_image<2>(0.02);
  check_image<3>(0.04);
}
} // namespace
} // namespace scree
