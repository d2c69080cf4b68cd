// Laws in increments: the tangent is the derivative of the stress (finite differences), a rotation
// turns the answer, plane strain is the three-dimensional law, inputs are checked.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/material/linear_elastic.h>

#include <algorithm>
#include <ctime>
#include <iostream>

#include "increment_points.h"

namespace scree
{
namespace
{
using namespace dealii;
using namespace increment_points;

/** Largest difference of the tangent and central differences, over the largest entry. */
template <int dim>
double
difference_quotient_error(const IncrementLaw<dim> &law, const Tensor<2, dim> &F_D,
                          const IncrementStart &start)
{
  const double step    = 1e-6;
  const auto   tangent = answer(law, F_D, start).tangent;
  double       error   = 0;
  for (unsigned int k = 0; k < dim; ++k)
    for (unsigned int l = 0; l < dim; ++l)
      {
        Tensor<2, dim> change;
        change[k][l]          = step;
        const auto difference = (answer(law, F_D + change, start).response.piola
                                 - answer(law, F_D - change, start).response.piola)
                                / (2 * step);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            error = std::max(error, std::abs(difference[i][j] - tangent[i][j][k][l]));
      }
  return error / tangent.norm();
}

/** Distance of the trial state to the yield surface that a difference quotient must not cross. */
template <int dim>
bool
is_far_from_yield(const IncrementLaw<dim> &law, const Tensor<2, dim> &F_D,
                  const IncrementStart &start)
{
  const double growth = answer(law, F_D, start).response.alpha - start.alpha;
  if (growth > 0)
    return growth > 1e-4;
  const auto   response = answer(law, F_D, start).response;
  const double J        = law.internal() == InternalTensor::plastic_metric
                            ? determinant(F_D) * start.volume_ratio
                            : 1; // the yield stress is one of the Kirchhoff stress
  return std::sqrt(1.5) * J * deviator(response.cauchy).norm()
         < 0.95 * (yield_stress + hardening_modulus * start.alpha);
}

template <int dim>
void
check_tangents()
{
  std::mt19937 generator(dim);
  for (const std::string &name : increment_laws())
    {
      const auto   law       = make_increment_law<dim>(parameters_of(name));
      double       error     = 0;
      unsigned int n_loading = 0, n_elastic = 0, n_unloading = 0;
      for (unsigned int sample = 0; sample < 60; ++sample)
        {
          const double      size    = sample % 3 == 0 ? 0.003 : 0.2;
          PointHistory<dim> history = random_history(generator, *law);
          Tensor<2, dim>    F_D     = unit<dim>() + random_tensor<dim>(generator, size);
          // Every second state has first gone to the yield surface and then turns back a little.
          const bool turns = is_plastic(name) && sample % 2 == 0;
          if (turns)
            {
              const Tensor<2, dim> forth = unit<dim>() + random_tensor<dim>(generator, 0.1);
              history
                = law->finish(history, forth, answer(*law, forth, law->start(history)).response);
              F_D = unit<dim>() - 0.05 * (forth - unit<dim>());
            }
          const IncrementStart start = law->start(history);
          if (is_plastic(name) && !is_far_from_yield(*law, F_D, start))
            continue;
          error           = std::max(error, difference_quotient_error(*law, F_D, start));
          const bool flow = answer(*law, F_D, start).response.alpha > start.alpha;
          (flow ? n_loading : turns ? n_unloading : n_elastic) += 1;
        }
      std::cout << "  " << dim << "D " << name << ": " << error << " (elastic " << n_elastic
                << ", loading " << n_loading << ", unloading " << n_unloading << ")\n";
      EXPECT_LT(error, 1e-7) << name;
      if (is_plastic(name))
        {
          EXPECT_GT(n_loading, 10u) << name;
          EXPECT_GT(n_unloading, 5u) << name;
        }
      else
        EXPECT_EQ(n_elastic, 60u) << name;
    }
}

TEST(IncrementLaw, TangentIsTheDerivativeOfTheStress)
{
  check_tangents<2>();
  check_tangents<3>();
}

/** A rotation after the increment turns the answer; one before it turns the history. */
template <int dim>
void
check_objectivity()
{
  std::mt19937 generator(17);
  for (const std::string &name : increment_laws())
    for (unsigned int sample = 0; sample < 20 && is_geometric(name); ++sample)
      {
        const auto           law     = make_increment_law<dim>(parameters_of(name));
        const IncrementStart start   = law->start(random_history(generator, *law));
        const Tensor<2, dim> F_D     = unit<dim>() + random_tensor<dim>(generator, 0.2);
        const Tensor<2, dim> Q       = random_rotation<dim>(generator);
        const Tensor<2, 3>   Q3      = with_three_rows<dim>(Q);
        const auto           plain   = answer(*law, F_D, start).response;
        const auto           turned  = answer(*law, Q * F_D, start).response;
        const Tensor<2, 3>   cauchy  = Q3 * Tensor<2, 3>(plain.cauchy) * transpose(Q3);
        const Tensor<2, 3>   carried = Q3 * Tensor<2, 3>(plain.internal) * transpose(Q3);
        EXPECT_LT((Tensor<2, 3>(turned.cauchy) - cauchy).norm(), 1e-11 * young) << name;
        EXPECT_LT((Tensor<2, 3>(turned.internal) - carried).norm(), 1e-11 * young) << name;
        EXPECT_LT((turned.piola - Q * plain.piola).norm(), 1e-11 * young) << name;
        EXPECT_NEAR(turned.energy, plain.energy, 1e-12 * young) << name;
        EXPECT_NEAR(turned.alpha, plain.alpha, 1e-13) << name;

        IncrementStart turned_start       = start;
        turned_start.tensor               = Q3 * start.tensor * transpose(Q3);
        turned_start.deformation_gradient = Q3 * start.deformation_gradient;
        const auto same                   = answer(*law, F_D * transpose(Q), turned_start).response;
        EXPECT_LT((same.cauchy - plain.cauchy).norm(), 1e-11 * young) << name;
        EXPECT_LT((same.piola * Q - plain.piola).norm(), 1e-11 * young) << name;
      }
}

TEST(IncrementLaw, IsObjective)
{
  check_objectivity<2>();
  check_objectivity<3>();
}

TEST(IncrementLaw, OldStressTurnsOnlyInRotatedLaws)
{
  PointHistory<2> history;
  history.internal[0][0] = 1;
  Tensor<2, 2> quarter_turn;
  quarter_turn[0][1] = -1;
  quarter_turn[1][0] = 1;
  const auto rotated = make_increment_law<2>(parameters_of("linear elastic rotated"));
  const auto turned  = answer(*rotated, quarter_turn, rotated->start(history)).response.cauchy;
  EXPECT_NEAR(turned[0][0], 0, 1e-13);
  EXPECT_NEAR(turned[1][1], 1, 1e-13);
  EXPECT_NEAR(turned[2][2], 0, 1e-13);
  // Small strain without rotation: a pure spin leaves the stress, to first order and exactly.
  const auto   plain = make_increment_law<2>(parameters_of("linear elastic incremental"));
  Tensor<2, 2> spin  = unit<2>();
  spin[0][1]         = -0.1;
  spin[1][0]         = 0.1;
  const auto kept    = answer(*plain, spin, plain->start(history)).response.cauchy;
  EXPECT_NEAR(kept[0][0], 1, 1e-13);
  EXPECT_NEAR(kept[0][1], 0, 1e-13);
}

TEST(IncrementLaw, PlaneStrainIsTheLawInThreeDimensions)
{
  std::mt19937 generator(5);
  for (const std::string &name : increment_laws())
    for (unsigned int sample = 0; sample < 10; ++sample)
      {
        const auto           in_plane = make_increment_law<2>(parameters_of(name));
        const auto           in_space = make_increment_law<3>(parameters_of(name));
        const IncrementStart start    = in_plane->start(random_history(generator, *in_plane));
        const Tensor<2, 2>   F_D      = unit<2>() + random_tensor<2>(generator, 0.2);
        const auto           a        = answer(*in_plane, F_D, start);
        const auto           b        = answer(*in_space, with_three_rows<2>(F_D), start);
        EXPECT_LT((a.response.cauchy - b.response.cauchy).norm(), 1e-13 * young) << name;
        EXPECT_LT((a.response.internal - b.response.internal).norm(), 1e-13 * young) << name;
        EXPECT_NEAR(a.response.energy, b.response.energy, 1e-13 * young) << name;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            {
              EXPECT_NEAR(a.response.piola[i][j], b.response.piola[i][j], 1e-13 * young) << name;
              for (unsigned int k = 0; k < 2; ++k)
                for (unsigned int l = 0; l < 2; ++l)
                  EXPECT_NEAR(a.tangent[i][j][k][l], b.tangent[i][j][k][l], 1e-12 * young) << name;
            }
      }
}

TEST(IncrementLaw, FirstPiolaStressIsThatOfTheCauchyStress)
{
  std::mt19937 generator(6);
  for (const std::string &name : increment_laws())
    {
      const auto           law      = make_increment_law<3>(parameters_of(name));
      const IncrementStart start    = law->start(random_history(generator, *law));
      const Tensor<2, 3>   F_D      = unit<3>() + random_tensor<3>(generator, 0.2);
      const auto           response = answer(*law, F_D, start).response;
      const Tensor<2, 3>   cauchy(response.cauchy);
      const Tensor<2, 3>   expected
        = is_geometric(name) ? determinant(F_D) * cauchy * transpose(invert(F_D))
          : is_total(name)   ? cauchy * transpose(start.deformation_gradient) / start.volume_ratio
                             : cauchy;
      EXPECT_LT((response.piola - expected).norm(), 1e-12 * young) << name;
    }
}

/** One step and the same step by two increments, carried through the history. */
TEST(IncrementLaw, ElasticAnswersDoNotDependOnTheIncrements)
{
  std::mt19937 generator(7);
  for (const std::string name :
       {"linear elastic", "Hencky", "neo-Hookean", "Saint Venant-Kirchhoff"})
    {
      const auto         law    = make_increment_law<3>(parameters_of(name));
      const Tensor<2, 3> first  = unit<3>() + random_tensor<3>(generator, 0.2);
      const Tensor<2, 3> second = unit<3>() + random_tensor<3>(generator, 0.2);
      PointHistory<3>    history;
      const auto         once = answer(*law, second * first, law->start(history)).response;
      history = law->finish(history, first, answer(*law, first, law->start(history)).response);
      const auto twice = answer(*law, second, law->start(history)).response;
      EXPECT_LT((once.cauchy - twice.cauchy).norm(), 1e-12 * young) << name;
      EXPECT_NEAR(once.energy, twice.energy, 1e-12 * young) << name;
    }
}

/**
 * The total law is the linear theory on the reference configuration: for any `F_n`, the stress of
 * LinearElastic, its work `J_n P : grad v = sigma : grad_X v`, its tangent and its energy.
 */
template <int dim>
void
check_total_law()
{
  std::mt19937             generator(31);
  const MaterialParameters parameters = parameters_of("linear elastic");
  const auto               law        = make_increment_law<dim>(parameters);
  const LinearElastic<dim> elastic(parameters);
  for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const auto           history = random_history(generator, *law);
      const Tensor<2, dim> F_n     = history.deformation_gradient;
      const Tensor<2, dim> F_D     = unit<dim>() + random_tensor<dim>(generator, 0.2);
      const auto           result  = answer(*law, F_D, law->start(history));
      const auto           strain  = symmetrize(F_D * F_n - unit<dim>());
      const Tensor<2, dim> sigma(elastic.stress(strain));
      EXPECT_NEAR(result.response.energy, elastic.energy_density(strain), 1e-12 * young);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          EXPECT_NEAR(result.response.cauchy[i][j], sigma[i][j], 1e-12 * young);
      if (dim == 2)
        {
          EXPECT_NEAR(result.response.cauchy[2][2], elastic.out_of_plane_stress(strain),
                      1e-12 * young);
        }

      const Tensor<2, dim> grad_v = random_tensor<dim>(generator, 1.);
      const Tensor<2, dim> change = random_tensor<dim>(generator, 1.);
      const double         J_n    = determinant(F_n);
      EXPECT_NEAR(J_n * scalar_product(result.response.piola, grad_v),
                  scalar_product(sigma, grad_v * F_n), 1e-11 * young);
      const Tensor<2, dim> stress_change(elastic.tangent(strain) * symmetrize(change * F_n));
      EXPECT_NEAR(J_n * scalar_product(double_contract<2, 0, 3, 1>(result.tangent, change), grad_v),
                  scalar_product(stress_change, grad_v * F_n), 1e-11 * young);
    }
}

TEST(IncrementLaw, TotalLinearElasticityIsThatOfTheReferenceConfiguration)
{
  check_total_law<2>();
  check_total_law<3>();
}

/**
 * A rotation of the whole increment leaves the plastic metric as it is; elastic increments keep it
 * to the last bit, and `start()` recovers the `b_e` of the response.
 */
template <int dim>
void
check_carried_plastic_metric()
{
  std::mt19937 generator(23);
  const auto   law = make_increment_law<dim>(parameters_of("J2"));
  for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const PointHistory<dim> history  = random_history(generator, *law);
      const Tensor<2, dim>    F_D      = unit<dim>() + random_tensor<dim>(generator, 0.2);
      const Tensor<2, dim>    Q        = random_rotation<dim>(generator);
      const IncrementStart    start    = law->start(history);
      const auto              response = answer(*law, F_D, start).response;
      const PointHistory<dim> carried  = law->finish(history, F_D, response);
      const PointHistory<dim> turned
        = law->finish(history, Q * F_D, answer(*law, Q * F_D, start).response);
      EXPECT_GT(carried.alpha, history.alpha);
      EXPECT_NEAR(turned.alpha, carried.alpha, 1e-13);
      EXPECT_LT((turned.internal - carried.internal).norm(), 1e-12);
      EXPECT_NEAR(trace(carried.internal), 0, 1e-12);
      EXPECT_LT((law->start(carried).tensor - exponential(Tensor<2, 3>(response.internal))).norm(),
                1e-12);

      // Back inside the yield surface, and any small way from there.
      PointHistory<dim>    unloaded = carried;
      const Tensor<2, dim> back     = unit<dim>() - 0.05 * (F_D - unit<dim>());
      for (unsigned int step = 0; step < 20; ++step)
        {
          const Tensor<2, dim> wiggle = unit<dim>() + random_tensor<dim>(generator, 1e-4);
          const Tensor<2, dim> next   = random_rotation<dim>(generator) * (step ? wiggle : back);
          unloaded = law->finish(unloaded, next, answer(*law, next, law->start(unloaded)).response);
        }
      EXPECT_EQ(unloaded.alpha, carried.alpha);
      EXPECT_EQ((unloaded.internal - carried.internal).norm(), 0);
    }
}

TEST(IncrementLaw, PlasticMetricChangesByPlasticFlowOnly)
{
  check_carried_plastic_metric<2>();
  check_carried_plastic_metric<3>();
}

TEST(IncrementLaw, NullStepsDoNotDrift)
{
  std::mt19937 generator(29);
  for (const std::string &name : increment_laws())
    {
      const auto         law     = make_increment_law<3>(parameters_of(name));
      PointHistory<3>    history = random_history(generator, *law);
      const Tensor<2, 3> F_D     = unit<3>() + random_tensor<3>(generator, 0.2);
      const auto         loaded  = answer(*law, F_D, law->start(history)).response;
      EXPECT_EQ(loaded.alpha > history.alpha, is_plastic(name)) << name;
      history      = law->finish(history, F_D, loaded);
      auto resting = loaded;
      for (unsigned int step = 0; step < 1000; ++step)
        {
          resting = answer(*law, unit<3>(), law->start(history)).response;
          history = law->finish(history, unit<3>(), resting);
        }
      EXPECT_LT((resting.cauchy - loaded.cauchy).norm(), 1e-12 * young) << name;
      EXPECT_NEAR(history.alpha, loaded.alpha, 1e-13) << name;
    }
}

TEST(IncrementLaw, InvertedIncrementsAreNotANumber)
{
  Tensor<2, 2> inverted = unit<2>();
  inverted[0][0]        = -0.5;
  for (const std::string &name : increment_laws())
    {
      const auto law    = make_increment_law<2>(parameters_of(name));
      const auto result = answer(*law, inverted, law->start(PointHistory<2>()));
      EXPECT_EQ(std::isnan(result.response.piola.norm()), is_geometric(name)) << name;
      EXPECT_EQ(std::isnan(result.response.energy), is_geometric(name)) << name;
      EXPECT_EQ(std::isnan(result.tangent.norm()), is_geometric(name)) << name;
    }
}

TEST(IncrementLaw, ConstantsAreChecked)
{
  for (const std::string &name : increment_laws())
    {
      MaterialParameters parameters = parameters_of(name);
      parameters.poisson            = 0.5;
      EXPECT_THROW(make_increment_law<2>(parameters), UserError) << name;
      parameters                   = parameters_of(name);
      parameters.hardening_modulus = -1;
      EXPECT_THROW(make_increment_law<2>(parameters), UserError) << name;
      parameters              = parameters_of(name);
      parameters.yield_stress = is_plastic(name) ? 0 : 1;
      EXPECT_THROW(make_increment_law<3>(parameters), UserError) << name;
    }
  MaterialParameters unset = parameters_of("J2");
  unset.yield_stress       = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_increment_law<2>(unset), UserError);
  try
    {
      make_increment_law<2>(parameters_of("Henky"));
      ADD_FAILURE();
    }
  catch (const UserError &error)
    {
      EXPECT_NE(std::string(error.what()).find("neo-Hookean"), std::string::npos) << error.what();
    }
}

/** Processor time of a flat loop, in blocks as an assembly has them. */
template <int dim>
void
print_time_per_point(const std::string &name, const unsigned int n_points, const bool with_tangent)
{
  const unsigned int                  block = 64; // divides n_points
  const auto                          law   = make_increment_law<dim>(parameters_of(name));
  std::mt19937                        generator(3);
  std::vector<Tensor<2, dim>>         increments(n_points);
  std::vector<IncrementStart>         starts(n_points);
  std::vector<IncrementResponse<dim>> responses(block);
  std::vector<Tensor<4, dim>>         tangents(with_tangent ? block : 0);
  for (unsigned int q = 0; q < n_points; ++q)
    {
      increments[q] = unit<dim>() + random_tensor<dim>(generator, 0.05);
      starts[q]     = law->start(PointHistory<dim>());
    }
  unsigned int       n_plastic = 0;
  double             sum       = 0;
  const std::clock_t begin     = std::clock();
  for (unsigned int q = 0; q < n_points; q += block)
    {
      law->respond(make_array_view(increments.begin() + q, increments.begin() + q + block),
                   make_array_view(starts.begin() + q, starts.begin() + q + block),
                   make_array_view(responses), make_array_view(tangents));
      for (const auto &response : responses)
        {
          n_plastic += response.alpha > 0;
          sum += response.piola.norm_square();
        }
    }
  const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
  std::cout << "  " << dim << "D " << name << (with_tangent ? " with" : " without")
            << " tangent: " << 1e9 * seconds / n_points << " ns per point, "
            << 100. * n_plastic / n_points << " % plastic\n";
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_EQ(n_plastic > n_points / 4, is_plastic(name));
}

/** Processor time of what is done once per step and point. */
template <int dim>
void
print_time_of_history(const std::string &name)
{
  const unsigned int                  n_points = 100000;
  const auto                          law      = make_increment_law<dim>(parameters_of(name));
  std::mt19937                        generator(4);
  std::vector<PointHistory<dim>>      histories(64);
  std::vector<Tensor<2, dim>>         increments(64);
  std::vector<IncrementResponse<dim>> responses(64);
  for (unsigned int q = 0; q < 64; ++q)
    {
      histories[q]  = random_history(generator, *law);
      increments[q] = unit<dim>() + random_tensor<dim>(generator, 0.2);
      responses[q]  = answer(*law, increments[q], law->start(histories[q])).response;
    }
  double       sum   = 0;
  std::clock_t begin = std::clock();
  for (unsigned int i = 0; i < n_points; ++i)
    sum += law->start(histories[i % 64]).tensor[0][0];
  const double start = double(std::clock() - begin) / CLOCKS_PER_SEC;
  begin              = std::clock();
  for (unsigned int i = 0; i < n_points; ++i)
    {
      const unsigned int q = i % 64;
      sum += law->finish(histories[q], increments[q], responses[q]).internal[0][0];
    }
  const double finish = double(std::clock() - begin) / CLOCKS_PER_SEC;
  std::cout << "  " << dim << "D " << name << ": start " << 1e9 * start / n_points
            << " ns per point, finish " << 1e9 * finish / n_points << " ns per point\n";
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(ReleaseIncrementLaw, TimePerPoint)
{
  for (const std::string name : {"linear elastic", "linear elastic rotated", "neo-Hookean",
                                 "Saint Venant-Kirchhoff", "Hencky", "J2 small strain", "J2"})
    for (const bool with_tangent : {false, true})
      {
        const unsigned int n_points = name == "J2" ? 1000000 : 128000;
        print_time_per_point<2>(name, n_points, with_tangent);
        print_time_per_point<3>(name, n_points, with_tangent);
      }
  for (const std::string name : {"neo-Hookean", "J2"})
    {
      print_time_of_history<2>(name);
      print_time_of_history<3>(name);
    }
}
} // namespace
} // namespace scree
