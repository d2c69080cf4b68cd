// Laws in increments against closed forms to 100 % strain, an elastic-plastic cycle, and the
// energy: no work on closed elastic paths, dissipation where the work goes in plastic flow.
#include <gtest/gtest.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <iostream>

#include "increment_points.h"

namespace scree
{
namespace
{
using namespace dealii;
using namespace increment_points;

/** Carries the history along the deformation gradients `path` (from the identity); the last answer.
 */
template <int dim>
IncrementResponse<dim>
follow(const IncrementLaw<dim> &law, const std::vector<Tensor<2, dim>> &path)
{
  PointHistory<dim>      history;
  IncrementResponse<dim> response;
  for (const Tensor<2, dim> &F : path)
    {
      const Tensor<2, dim> F_D = F * invert(history.deformation_gradient);
      response                 = answer(law, F_D, law.start(history)).response;
      history                  = law.finish(history, F_D, response);
    }
  return response;
}

/** Simple shear `F = I + gamma e_1 (x) e_2` to gamma in 20 increments. */
template <int dim>
IncrementResponse<dim>
sheared(const std::string &name, const double gamma)
{
  std::vector<Tensor<2, dim>> path;
  for (unsigned int i = 1; i <= 20; ++i)
    {
      path.push_back(unit<dim>());
      path.back()[0][1] = gamma * i / 20;
    }
  return follow<dim>(*make_increment_law<dim>(parameters_of(name)), path);
}

template <int dim>
void
check_simple_shear()
{
  for (const double g : {0.1, 0.5, 1.})
    {
      const auto neo_hookean = sheared<dim>("neo-Hookean", g);
      EXPECT_NEAR(neo_hookean.cauchy[0][1], mu * g, 1e-12 * young);
      EXPECT_NEAR(neo_hookean.cauchy[0][0], mu * g * g, 1e-12 * young);
      EXPECT_NEAR(neo_hookean.cauchy[1][1], 0, 1e-12 * young);
      EXPECT_NEAR(neo_hookean.energy, 0.5 * mu * g * g, 1e-12 * young);

      const auto   hencky      = sheared<dim>("Hencky", g);
      const double log_stretch = std::asinh(g / 2), root = std::sqrt(4 + g * g);
      EXPECT_NEAR(hencky.cauchy[0][1], 4 * mu * log_stretch / root, 1e-12 * young);
      EXPECT_NEAR(hencky.cauchy[0][0], 2 * mu * log_stretch * g / root, 1e-12 * young);
      EXPECT_NEAR(hencky.cauchy[1][1], -2 * mu * log_stretch * g / root, 1e-12 * young);
      EXPECT_NEAR(hencky.energy, 2 * mu * log_stretch * log_stretch, 1e-12 * young);

      const auto   svk  = sheared<dim>("Saint Venant-Kirchhoff", g);
      const double S_22 = (0.5 * lambda + mu) * g * g;
      EXPECT_NEAR(svk.cauchy[1][1], S_22, 1e-12 * young);
      EXPECT_NEAR(svk.cauchy[0][1], mu * g + g * S_22, 1e-12 * young);
      EXPECT_NEAR(svk.cauchy[2][2], 0.5 * lambda * g * g, 1e-12 * young);
    }
}

TEST(IncrementClosedForms, SimpleShear)
{
  check_simple_shear<2>();
  check_simple_shear<3>();
}

/** Stretches (axial, lateral) proportional in their logarithms, in 20 increments. */
template <int dim>
IncrementResponse<dim>
stretched(const std::string &name, const double axial, const double lateral)
{
  std::vector<Tensor<2, dim>> path;
  for (unsigned int i = 1; i <= 20; ++i)
    {
      Tensor<2, dim> F;
      F[0][0] = std::pow(axial, i / 20.);
      for (unsigned int d = 1; d < dim; ++d)
        F[d][d] = std::pow(lateral, i / 20.);
      path.push_back(F);
    }
  return follow<dim>(*make_increment_law<dim>(parameters_of(name)), path);
}

TEST(IncrementClosedForms, HenckyUniaxialStress)
{
  for (const double stretch : {0.5, 0.8, 1.25, 2.})
    {
      // In space: tau = E ln(stretch), the lateral stretch is stretch^-nu.
      const auto   bar = stretched<3>("Hencky", stretch, std::pow(stretch, -poisson));
      const double J   = std::pow(stretch, 1 - 2 * poisson);
      EXPECT_NEAR(bar.cauchy[0][0], young * std::log(stretch) / J, 1e-12 * young);
      EXPECT_NEAR(bar.cauchy[1][1], 0, 1e-12 * young);
      EXPECT_NEAR(bar.cauchy[2][2], 0, 1e-12 * young);

      // In plane strain: the moduli E/(1-nu^2) and nu/(1-nu); tau_zz = nu tau.
      const double ratio = poisson / (1 - poisson);
      const auto   strip = stretched<2>("Hencky", stretch, std::pow(stretch, -ratio));
      const double tau   = young / (1 - poisson * poisson) * std::log(stretch);
      EXPECT_NEAR(strip.cauchy[0][0], tau / std::pow(stretch, 1 - ratio), 1e-12 * young);
      EXPECT_NEAR(strip.cauchy[1][1], 0, 1e-12 * young);
      EXPECT_NEAR(strip.cauchy[2][2], poisson * tau / std::pow(stretch, 1 - ratio), 1e-12 * young);
    }
}

TEST(IncrementClosedForms, NeoHookeanUniaxialStress)
{
  // No lateral stress: mu (l_t^2 - 1) + lambda ln J = 0 with J = l l_t^2, hence l as a function of
  // J.
  double largest = 0;
  for (const double J : {0.75, 0.9, 1.1, 1.2, 1.28})
    {
      const double lateral_square = 1 - lambda / mu * std::log(J);
      const double stretch        = J / lateral_square;
      largest                     = std::max(largest, stretch);
      const auto bar              = stretched<3>("neo-Hookean", stretch, std::sqrt(lateral_square));
      EXPECT_NEAR(bar.cauchy[0][0], mu * (stretch * stretch - lateral_square) / J, 1e-12 * young);
      EXPECT_NEAR(bar.cauchy[1][1], 0, 1e-12 * young);
      EXPECT_NEAR(bar.cauchy[2][2], 0, 1e-12 * young);
    }
  EXPECT_GT(largest, 2);
  // In plane strain, without lateral strain.
  const auto strip = stretched<2>("neo-Hookean", 2, 1);
  EXPECT_NEAR(strip.cauchy[0][0], (3 * mu + lambda * std::log(2.)) / 2, 1e-12 * young);
  EXPECT_NEAR(strip.cauchy[2][2], lambda * std::log(2.) / 2, 1e-12 * young);
}

TEST(IncrementClosedForms, SaintVenantKirchhoffUniaxialStress)
{
  for (const double stretch : {0.6, 0.8, 1.25, 2.})
    {
      // In space: S = E_Y E along the bar, the lateral strain is -nu E.
      const double E = 0.5 * (stretch * stretch - 1), lateral = std::sqrt(1 - 2 * poisson * E);
      const auto   bar = stretched<3>("Saint Venant-Kirchhoff", stretch, lateral);
      EXPECT_NEAR(bar.cauchy[0][0], young * E * stretch / (lateral * lateral), 1e-11 * young);
      EXPECT_NEAR(bar.cauchy[1][1], 0, 1e-11 * young);
    }
}

/** One-dimensional plasticity with linear hardening: exact for a monotonic strain increment. */
struct Bar
{
  double modulus = young, yield = yield_stress, hardening = hardening_modulus;
  double plastic = 0, alpha = 0, stress = 0;

  void move_to(const double strain)
  {
    const double trial = modulus * (strain - plastic);
    const double f     = std::abs(trial) - yield - hardening * alpha;
    const double flow  = std::max(0., f / (modulus + hardening));
    plastic += std::copysign(flow, trial);
    alpha += flow;
    stress = modulus * (strain - plastic);
  }
};

/**
 * Axial strain 0 -> 0.3 -> -0.2 -> 0.4 under uniaxial stress, in increments that do not stop at
 * the yield point; the body also turns in every increment where the law allows it.
 */
void
check_cycle(const std::string &name)
{
  const auto      law       = make_increment_law<3>(parameters_of(name));
  const double    corners[] = {0, 0.3, -0.2, 0.4};
  const unsigned  n_steps   = 15;
  std::mt19937    generator(8);
  PointHistory<3> history;
  Bar             bar;
  double          lateral = 0, axial = 0, error = 0, volume_error = 0;
  Tensor<2, 3>    old_turn = unit<3>();
  for (unsigned int leg = 0; leg < 3; ++leg)
    for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double strain = corners[leg] + (corners[leg + 1] - corners[leg]) * i / n_steps;
        bar.move_to(strain);
        const double new_lateral = -poisson * bar.stress / young - bar.plastic / 2;
        Tensor<2, 3> change; // the increment of the strain: additive or logarithmic
        change[0][0]            = strain - axial;
        change[1][1]            = new_lateral - lateral;
        change[2][2]            = new_lateral - lateral;
        const bool   is_turning = is_geometric(name);
        const auto   turn       = is_turning ? random_rotation<3>(generator) : unit<3>();
        Tensor<2, 3> F_D        = unit<3>();
        for (unsigned int d = 0; d < 3; ++d)
          F_D[d][d] = is_turning ? std::exp(change[d][d])
                                 : 1 + change[d][d] / history.deformation_gradient[d][d];
        F_D                 = turn * F_D * transpose(old_turn);
        const auto response = answer(*law, F_D, law->start(history)).response;
        history             = law->finish(history, F_D, response);
        const double J      = name == "J2" ? determinant(history.deformation_gradient) : 1;
        Tensor<2, 3> expected;
        expected[0][0] = bar.stress / J;
        expected       = turn * expected * transpose(turn);
        error          = std::max(error, (Tensor<2, 3>(response.cauchy) - expected).norm());
        error          = std::max(error, young * std::abs(response.alpha - bar.alpha));
        if (name == "J2")
          volume_error = std::max(volume_error, std::abs(trace(history.internal)));
        old_turn = turn;
        axial    = strain;
        lateral  = new_lateral;
      }
  std::cout << "  " << name << ": stress " << bar.stress << " alpha " << bar.alpha << ", error "
            << error / young << " E\n";
  EXPECT_GT(bar.alpha, 0.9);
  EXPECT_LT(error, 1e-12 * young) << name;
  EXPECT_LT(volume_error, 1e-12) << name;
}

TEST(IncrementClosedForms, ElasticPlasticCycle)
{
  for (const std::string name : {"J2", "J2 small strain", "J2 small strain rotated"})
    check_cycle(name);
}

/**
 * Shear 0 -> 0.3 -> -0.2 -> 0.4 without change of volume: simple shear in the linear theory, else
 * pure shear by the stretches exp(+-gamma/2), seen in axes that turn in every increment. The shear
 * stress is that of a bar with the modulus mu, the yield stress sigma_y/sqrt(3) and the hardening
 * H/3, whose plastic strain is sqrt(3) alpha; other stresses are zero, and so the volume ratio
 * is 1.
 */
template <int dim>
void
check_shear_cycle(const std::string &name)
{
  const auto        law       = make_increment_law<dim>(parameters_of(name));
  const double      corners[] = {0, 0.3, -0.2, 0.4};
  const unsigned    n_steps   = 13;
  std::mt19937      generator(12);
  PointHistory<dim> history;
  Bar               shear{mu, yield_stress / std::sqrt(3.), hardening_modulus / 3};
  double            error = 0;
  for (unsigned int leg = 0; leg < 3; ++leg)
    for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double gamma = corners[leg] + (corners[leg + 1] - corners[leg]) * i / n_steps;
        shear.move_to(gamma);
        Tensor<2, dim> F = unit<dim>(), turn = unit<dim>();
        Tensor<2, 3>   expected;
        if (is_geometric(name))
          {
            turn           = random_rotation<dim>(generator);
            F[0][0]        = std::exp(gamma / 2);
            F[1][1]        = std::exp(-gamma / 2);
            expected[0][0] = shear.stress;
            expected[1][1] = -shear.stress;
          }
        else
          {
            F[0][1]        = gamma;
            expected[0][1] = shear.stress;
            expected[1][0] = shear.stress;
          }
        const Tensor<2, dim> F_D      = turn * F * invert(history.deformation_gradient);
        const auto           response = answer(*law, F_D, law->start(history)).response;
        const Tensor<2, 3>   Q        = with_three_rows<dim>(turn);
        history                       = law->finish(history, F_D, response);
        error
          = std::max(error, (Tensor<2, 3>(response.cauchy) - Q * expected * transpose(Q)).norm());
        error = std::max(error, young * std::abs(std::sqrt(3.) * response.alpha - shear.alpha));
      }
  std::cout << "  " << dim << "D " << name << ": shear stress " << shear.stress << " alpha "
            << history.alpha << ", error " << error / young << " E\n";
  EXPECT_GT(history.alpha, 0.5);
  EXPECT_LT(error, 1e-12 * young) << name;
}

TEST(IncrementClosedForms, ElasticPlasticShearCycle)
{
  for (const std::string name : {"J2", "J2 small strain", "J2 small strain rotated"})
    {
      check_shear_cycle<2>(name);
      check_shear_cycle<3>(name);
    }
}

/** Plastic flow keeps the volume: `det C_p = 1` after any increments. */
TEST(IncrementClosedForms, PlasticFlowIsIsochoric)
{
  const auto      law = make_increment_law<3>(parameters_of("J2"));
  std::mt19937    generator(9);
  PointHistory<3> history;
  for (unsigned int step = 0; step < 200; ++step)
    {
      const Tensor<2, 3> F_D = unit<3>() + random_tensor<3>(generator, 0.1);
      history = law->finish(history, F_D, answer(*law, F_D, law->start(history)).response);
    }
  EXPECT_GT(history.alpha, 1);
  EXPECT_NEAR(trace(history.internal), 0, 1e-12);
}

/** A closed path of `F` through three random states. */
template <int dim>
std::vector<Tensor<2, dim>>
closed_path()
{
  std::mt19937 generator(10);
  return {unit<dim>(), unit<dim>() + random_tensor<dim>(generator, 0.3),
          unit<dim>() + random_tensor<dim>(generator, 0.3),
          unit<dim>() + random_tensor<dim>(generator, 0.3), unit<dim>()};
}

/** `F_D - I` of a change of F: an incremental law adds increments, the others multiply them. */
template <int dim>
Tensor<2, dim>
increment_of(const std::string &name, const Tensor<2, dim> &change,
             const PointHistory<dim> &history)
{
  return name == "linear elastic incremental" ? change
                                              : change * invert(history.deformation_gradient);
}

/** Work of `P` per reference volume from one to the next corner, by Gauss points within increments.
 */
template <int dim>
void
check_elastic_energy(const std::string &name)
{
  const auto        law     = make_increment_law<dim>(parameters_of(name));
  const auto        corners = closed_path<dim>();
  const QGauss<1>   rule(12);
  PointHistory<dim> history;
  double            work = 0, largest = 0;
  for (unsigned int leg = 0; leg + 1 < corners.size(); ++leg)
    for (unsigned int step = 0; step < 4; ++step)
      {
        const Tensor<2, dim> change    = 0.25 * (corners[leg + 1] - corners[leg]);
        const Tensor<2, dim> increment = increment_of(name, change, history);
        const IncrementStart start     = law->start(history);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Tensor<2, dim> F_D = unit<dim>() + rule.point(q)[0] * increment;
            work += rule.weight(q) * start.volume_ratio
                    * scalar_product(answer(*law, F_D, start).response.piola, increment);
          }
        const Tensor<2, dim> F_D      = unit<dim>() + increment;
        const auto           response = answer(*law, F_D, start).response;
        history                       = law->finish(history, F_D, response);
        EXPECT_NEAR(work, response.energy, 1e-11 * young) << name;
        EXPECT_EQ(response.dissipation, 0) << name;
        largest = std::max(largest, work);
      }
  EXPECT_GT(largest, 0.01 * young) << name;
  EXPECT_NEAR(work, 0, 1e-11 * young) << name;
}

TEST(IncrementClosedForms, WorkOfAClosedElasticPathIsZero)
{
  for (const std::string name : {"linear elastic", "linear elastic incremental", "Hencky",
                                 "neo-Hookean", "Saint Venant-Kirchhoff"})
    {
      check_elastic_energy<2>(name);
      check_elastic_energy<3>(name);
    }
}

/** Work - stored energy - dissipation over a closed path in n increments per leg, over the work. */
template <int dim>
double
plastic_balance(const std::string &name, const unsigned int n_steps)
{
  const auto             law     = make_increment_law<dim>(parameters_of(name));
  const auto             corners = closed_path<dim>();
  PointHistory<dim>      history;
  IncrementResponse<dim> response;
  double                 work = 0, dissipation = 0;
  for (unsigned int leg = 0; leg + 1 < corners.size(); ++leg)
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const Tensor<2, dim> change    = (corners[leg + 1] - corners[leg]) / n_steps;
        const Tensor<2, dim> increment = increment_of(name, change, history);
        const IncrementStart start     = law->start(history);
        const Tensor<2, dim> F_D       = unit<dim>() + increment;
        const auto           before    = answer(*law, unit<dim>(), start).response.piola;
        response                       = answer(*law, F_D, start).response;
        work += start.volume_ratio * scalar_product(0.5 * (before + response.piola), increment);
        dissipation += response.dissipation;
        EXPECT_GE(response.dissipation, 0);
        history = law->finish(history, F_D, response);
      }
  EXPECT_GT(dissipation, 0.1 * work) << name;
  return (work - response.energy - dissipation) / work;
}

TEST(IncrementClosedForms, DissipationIsWorkMinusStoredEnergy)
{
  for (const std::string name : {"J2", "J2 small strain"})
    {
      const double coarse = plastic_balance<2>(name, 50), fine = plastic_balance<2>(name, 800);
      const double coarse_3 = plastic_balance<3>(name, 50), fine_3 = plastic_balance<3>(name, 800);
      std::cout << "  " << name << ": " << coarse << " -> " << fine << " (2D), " << coarse_3
                << " -> " << fine_3 << " (3D) of the work\n";
      EXPECT_LT(std::abs(fine), 1e-3) << name;
      EXPECT_LT(std::abs(fine_3), 1e-3) << name;
      EXPECT_LT(std::abs(fine), std::abs(coarse) / 10) << name;
      EXPECT_LT(std::abs(fine_3), std::abs(coarse_3) / 10) << name;
    }
}
} // namespace
} // namespace scree
