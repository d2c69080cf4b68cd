// The contact law as a function of the jump: tangent against finite differences, limits, work.
#include <gtest/gtest.h>

#include <scree/contact/contact_parameters.h>
#include <scree/contact/penalty.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <map>
#include <random>
#include <string>

namespace scree
{
namespace
{
using namespace dealii;

/** A contact point, its history and penalties. */
template <int dim>
struct Kinematics
{
  double         initial_gap;
  Tensor<1, dim> normal, jump, old_jump, old_tau;
  double         old_pressure, eps_n, eps_t, touching_gap;
};

/** The response of a law to penalties; what is tied is glued. */
template <int dim>
ContactResponse<dim>
contact_response(const ContactPairParameters &parameters, const Kinematics<dim> &k)
{
  std::vector<ContactMotion<dim>> motions(1, ContactMotion<dim>::between(k.initial_gap, k.normal,
                                                                         k.old_jump, k.jump,
                                                                         parameters.kind->glues));
  ContactMotion<dim>             &motion = motions[0];
  motion.touching_gap                    = k.touching_gap;
  const ContactHistory<dim>             history{{k.old_tau}, {k.old_jump}, {k.old_pressure}};
  const std::vector<TrialTraction<dim>> trials
    = Penalty<dim>({{k.eps_n, k.eps_t}}).trial_tractions({0}, motions, history);
  const std::vector<double>         pressures(1, std::max(0., trials[0].pressure));
  std::vector<FrictionBound>        bounds(1);
  std::vector<ContactResponse<dim>> responses(1);
  if (parameters.kind->bound)
    parameters.kind->bound(parameters, make_array_view(pressures), make_array_view(bounds));
  return_to_admissible<dim>(*parameters.kind, make_array_view(std::as_const(motions)),
                            make_array_view(trials), make_array_view(std::as_const(bounds)),
                            make_array_view(responses));
  return responses[0];
}

template <int dim>
ContactResponse<dim>
contact_response(const std::string &law, const double mu, const Kinematics<dim> &k)
{
  ContactPairParameters parameters;
  parameters.kind                 = &contact_law(law);
  parameters.friction_coefficient = mu;
  return contact_response(parameters, k);
}

/** Random vectors of size 1, always the same ones. */
template <int dim>
class Random
{
public:
  double number(const double lower, const double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(engine);
  }

  Tensor<1, dim> vector()
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = number(-1., 1.);
    return result;
  }

  Tensor<1, dim> normal()
  {
    const Tensor<1, dim> result = vector();
    return result / result.norm();
  }

  /** Overlaps and gaps, with a tangential traction from before. */
  Kinematics<dim> kinematics()
  {
    Kinematics<dim> k;
    k.normal      = normal();
    k.initial_gap = number(-0.5, 0.5);
    k.jump        = vector();
    k.old_jump    = vector();
    k.old_tau     = 3. * vector();
    k.old_tau -= k.normal * (k.normal * k.old_tau);
    k.old_pressure = number(-2., 2.);
    k.eps_n        = 10.;
    k.eps_t        = 4.;
    k.touching_gap = 1e-8;
    return k;
  }

private:
  std::mt19937 engine{42};
};

/** The trial traction: of the motion after the point has closed. */
template <int dim>
Tensor<1, dim>
trial_traction(const Kinematics<dim> &k)
{
  const double         gap     = k.initial_gap + k.normal * k.jump;
  const double         old_gap = k.initial_gap + k.normal * k.old_jump;
  const double         closed  = old_gap > 0. && gap < 0. ? -gap / (old_gap - gap) : 1.;
  const Tensor<1, dim> motion  = k.jump - k.old_jump;
  return k.old_tau - k.eps_t * closed * (motion - k.normal * (k.normal * motion));
}

template <int dim>
Tensor<2, dim>
finite_differences(const std::string &law, const double mu, const Kinematics<dim> &kinematics,
                   const double step)
{
  Tensor<2, dim> result;
  for (unsigned int j = 0; j < dim; ++j)
    {
      Tensor<1, dim> difference;
      for (const double sign : {1., -1.})
        {
          auto moved = kinematics;
          moved.jump[j] += sign * step;
          difference -= sign * contact_response<dim>(law, mu, moved).traction(kinematics.normal);
        }
      for (unsigned int i = 0; i < dim; ++i)
        result[i][j] = difference[i] / (2. * step);
    }
  return result;
}

const char *const all_laws[] = {"none", "frictionless", "coulomb", "stick", "tied"};

template <int dim>
void
compare_tangents()
{
  constexpr double step = 1e-5;
  for (const std::string law : all_laws)
    {
      Random<dim>                           random;
      std::map<ContactStatus, unsigned int> n_states;
      for (unsigned int trial = 0; trial < 600; ++trial)
        {
          const auto   k         = random.kinematics();
          const double mu        = random.number(0.1, 2.);
          const auto   response  = contact_response<dim>(law, mu, k);
          const double gap       = k.initial_gap + k.normal * k.jump;
          const double trial_tau = trial_traction(k).norm();
          // Not across the kinks of the law, where it has no derivative.
          if (std::abs(gap) < 0.05 || std::abs(trial_tau - mu * response.pressure) < 1e-2)
            continue;
          ++n_states[response.status];
          const Tensor<2, dim> difference = response.tangent - finite_differences(law, mu, k, step);
          EXPECT_LE(difference.norm(), 1e-6 * std::max(k.eps_n, response.tangent.norm()))
            << law << ", " << name_of(contact_status_names, response.status);
        }
      const bool may_open  = law != "tied";
      const bool may_stick = law == "coulomb" || law == "stick" || law == "tied";
      const bool may_slip  = law == "coulomb" || law == "frictionless";
      EXPECT_EQ(n_states[ContactStatus::open] > 20, may_open) << law;
      EXPECT_EQ(n_states[ContactStatus::stick] > 20, may_stick) << law;
      EXPECT_EQ(n_states[ContactStatus::slip] > 20, may_slip) << law;
    }
}

TEST(ContactLaw, TangentEqualsFiniteDifferences2D)
{
  compare_tangents<2>();
}

TEST(ContactLaw, TangentEqualsFiniteDifferences3D)
{
  compare_tangents<3>();
}

template <int dim>
void
check_limits()
{
  Random<dim>  random;
  unsigned int n_stick = 0, n_slip = 0;
  for (unsigned int i = 0; i < 500; ++i)
    {
      const auto           k        = random.kinematics();
      const double         mu       = random.number(0.1, 2.);
      const auto           response = contact_response<dim>("coulomb", mu, k);
      const double         gap      = k.initial_gap + k.normal * k.jump;
      const Tensor<1, dim> trial    = trial_traction(k);
      EXPECT_NEAR(response.pressure, k.eps_n * std::max(0., -gap), 1e-13);
      EXPECT_NEAR(response.tau * k.normal, 0., 1e-13);
      EXPECT_LE(response.tau.norm(), mu * response.pressure + 1e-13);
      if (response.status == ContactStatus::stick)
        {
          ++n_stick;
          EXPECT_LE((response.tau - trial).norm(), 1e-13);
        }
      else if (response.status == ContactStatus::slip)
        {
          ++n_slip;
          EXPECT_NEAR(response.tau.norm(), mu * response.pressure, 1e-13);
          // Along the trial traction.
          EXPECT_NEAR(response.tau * trial, response.tau.norm() * trial.norm(), 1e-12);
        }
      // The law stick has no limit.
      const auto stuck = contact_response<dim>("stick", 0., k);
      EXPECT_LE(gap < 0. ? (stuck.tau - trial).norm() : stuck.tau.norm(), 1e-13);
      // Frictionless contact has no tangential traction.
      EXPECT_EQ(contact_response<dim>("frictionless", 0., k).tau.norm(), 0.);
    }
  EXPECT_GT(n_stick, 20u);
  EXPECT_GT(n_slip, 20u);
}

TEST(ContactLaw, ReturnMappingKeepsTheLimit2D)
{
  check_limits<2>();
}

TEST(ContactLaw, ReturnMappingKeepsTheLimit3D)
{
  check_limits<3>();
}

TEST(ContactLaw, OpeningForgetsTheTraction)
{
  Random<3> random;
  for (const std::string law : {"frictionless", "coulomb", "stick"})
    {
      auto k        = random.kinematics();
      k.initial_gap = 0.01;
      k.jump        = 0.3 * (k.jump - k.normal * (k.normal * k.jump));
      EXPECT_GT(k.old_tau.norm(), 0.1);
      const auto response = contact_response<3>(law, 0.5, k);
      EXPECT_EQ(response.status, ContactStatus::open);
      EXPECT_EQ(response.pressure, 0.);
      EXPECT_EQ(response.tau.norm(), 0.);
      EXPECT_EQ(response.tangent.norm(), 0.);
    }
}

TEST(ContactLaw, TouchingPointsHoldInTheTangentOnly)
{
  Random<2> random;
  auto      k           = random.kinematics();
  k.initial_gap         = 0.5 * k.touching_gap;
  k.jump                = Tensor<1, 2>();
  const Tensor<2, 2> nn = outer_product(k.normal, k.normal);
  const Tensor<2, 2> stick
    = k.eps_n * nn + k.eps_t * (Tensor<2, 2>(unit_symmetric_tensor<2>()) - nn);
  for (const std::string law : {"coulomb", "stick"})
    {
      const auto response = contact_response<2>(law, 0.5, k);
      EXPECT_EQ(response.traction(k.normal).norm(), 0.);
      EXPECT_LE((response.tangent - stick).norm(), 1e-13);
    }
}

TEST(ContactLaw, TiedBothWays)
{
  Random<3> random;
  for (const double motion : {-0.2, 0.2})
    {
      auto k = random.kinematics();
      k.jump = k.old_jump + motion * k.normal + 0.1 * (k.jump - k.normal * (k.normal * k.jump));
      k.jump -= 0.1 * (k.old_jump - k.normal * (k.normal * k.old_jump));
      const auto response = contact_response<3>("tied", 0., k);
      EXPECT_EQ(response.status, ContactStatus::stick);
      // Whatever the initial gap: tension where the bodies move apart.
      EXPECT_NEAR(response.pressure, k.old_pressure - k.eps_n * motion, 1e-13);
      k.jump += 10. * k.normal;
      EXPECT_LE((contact_response<3>("tied", 0., k).tau - response.tau).norm(), 1e-12);
    }
}

TEST(ContactLaw, TiedRemembersItsTraction)
{
  // One step, two steps, and two steps with jumps that count from the start of each: the same.
  Random<3> random;
  for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const auto         first = random.kinematics();
      const Tensor<1, 3> end   = first.jump + random.vector();
      Kinematics<3>      once = first, again = first, moving = first;
      once.jump           = end;
      const auto halfway  = contact_response<3>("tied", 0., first);
      const auto expected = contact_response<3>("tied", 0., once);
      for (Kinematics<3> *k : {&again, &moving})
        {
          k->old_jump     = first.jump;
          k->old_tau      = halfway.tau;
          k->old_pressure = halfway.pressure;
          k->jump         = end;
        }
      moving.old_jump = Tensor<1, 3>();
      moving.jump     = end - first.jump;
      for (const Kinematics<3> &k : {again, moving})
        {
          const auto response = contact_response<3>("tied", 0., k);
          EXPECT_NEAR(response.pressure, expected.pressure, 1e-12);
          EXPECT_LE((response.tau - expected.tau).norm(), 1e-12);
        }
    }
}

/** Along a random path: the work against friction is at least the elastic energy that it stored. */
template <int dim>
void
check_work()
{
  for (const std::string law : {"coulomb", "stick"})
    {
      Random<dim>  random;
      auto         k      = random.kinematics();
      unsigned int n_open = 0, n_slip = 0;
      double       lost = 0.;
      k.initial_gap     = 0.;
      k.jump = k.old_jump = k.old_tau = Tensor<1, dim>();
      for (unsigned int i = 0; i < 2000; ++i)
        {
          const Tensor<1, dim> step = 0.3 * random.vector();
          k.jump += step - 0.1 * k.jump;
          const auto           response = contact_response<dim>(law, 0.4, k);
          const Tensor<1, dim> motion   = k.jump - k.old_jump;
          const double         work     = -response.tau * motion;
          const double         stored
            = (response.tau.norm_square() - k.old_tau.norm_square()) / 2. / k.eps_t;
          EXPECT_GE(work - stored, -1e-13);
          lost += work - stored;
          n_open += response.status == ContactStatus::open;
          n_slip += response.status == ContactStatus::slip;
          k.old_jump = k.jump;
          k.old_tau  = response.tau;
        }
      EXPECT_GT(n_open, 100u);
      EXPECT_EQ(n_slip > 100, law == "coulomb");
      EXPECT_GT(lost, 0.);
    }
}

TEST(ContactLaw, FrictionNeverGivesWork2D)
{
  check_work<2>();
}

TEST(ContactLaw, FrictionNeverGivesWork3D)
{
  check_work<3>();
}

TEST(ContactLaw, TurnsWithTheFrame)
{
  Random<3>          random;
  const double       c = std::cos(0.7), s = std::sin(0.7);
  const Tensor<2, 3> rotation({{c, 0., s}, {0., 1., 0.}, {-s, 0., c}});
  for (const std::string law : all_laws)
    for (unsigned int i = 0; i < 20; ++i)
      {
        const auto k     = random.kinematics();
        auto       k_r   = k;
        k_r.normal       = rotation * k.normal;
        k_r.jump         = rotation * k.jump;
        k_r.old_jump     = rotation * k.old_jump;
        k_r.old_tau      = rotation * k.old_tau;
        const auto here  = contact_response<3>(law, 0.4, k),
                   there = contact_response<3>(law, 0.4, k_r);
        EXPECT_EQ(here.status, there.status);
        EXPECT_LE((rotation * here.traction(k.normal) - there.traction(k_r.normal)).norm(), 1e-12);
        EXPECT_LE((rotation * here.tangent * transpose(rotation) - there.tangent).norm(), 1e-11);
      }
}
/** Friction that Coulomb's law limits only up to a shear strength of 1. */
void
capped_bound(const ContactPairParameters &parameters, const ArrayView<const double> &pressures,
             const ArrayView<FrictionBound> &bounds)
{
  const double mu = parameters.friction_coefficient;
  for (std::size_t i = 0; i < pressures.size(); ++i)
    bounds[i]
      = mu * pressures[i] < 1. ? FrictionBound{mu * pressures[i], mu} : FrictionBound{1., 0.};
}

TEST(ContactLaw, ANewLawIsADescription)
{
  ContactLaw capped;
  capped.bound = capped_bound;
  ContactPairParameters parameters;
  parameters.kind                 = &capped;
  parameters.friction_coefficient = 0.5;
  EXPECT_EQ(parameters.friction(), 0.);
  Random<3>    random;
  unsigned int n_capped = 0;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const auto k        = random.kinematics();
      const auto response = contact_response(parameters, k);
      if (response.pressure < 2.)
        EXPECT_EQ(response.tau, contact_response<3>("coulomb", 0.5, k).tau);
      else if (response.status == ContactStatus::slip)
        {
          ++n_capped;
          EXPECT_NEAR(response.tau.norm(), 1., 1e-14);
          // The pressure does not change tau.
          const Tensor<2, 3> of_tau
            = response.tangent - k.eps_n * outer_product(k.normal, k.normal);
          if (k.initial_gap + k.normal * k.old_jump < 0.)
            {
              EXPECT_LE((of_tau * k.normal).norm(), 1e-12);
            }
        }
    }
  EXPECT_GT(n_capped, 20u);
}

TEST(ContactLaw, TellsItsFriction)
{
  const auto friction = [](const std::string &name) {
    ContactPairParameters parameters;
    parameters.kind                 = &contact_law(name);
    parameters.friction_coefficient = 0.3;
    return parameters.friction();
  };
  EXPECT_EQ(friction("frictionless"), 0.);
  EXPECT_EQ(friction("coulomb"), 0.3);
  EXPECT_TRUE(std::isinf(friction("stick")));
  EXPECT_TRUE(std::isinf(friction("tied")));
}
} // namespace
} // namespace scree
