// The contact law as a function of the jump: tangent against finite differences, limits, work.
#include <gtest/gtest.h>

#include <scree/contact/contact_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <map>
#include <random>

namespace scree
{
namespace
{
using namespace dealii;

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
  ContactKinematics<dim> kinematics()
  {
    ContactKinematics<dim> k;
    k.normal      = normal();
    k.initial_gap = number(-0.5, 0.5);
    k.jump        = vector();
    k.old_jump    = vector();
    k.old_tau     = 3. * vector();
    k.old_tau -= k.normal * (k.normal * k.old_tau);
    k.old_pressure = number(-2., 2.);
    k.eps_n        = 10.;
    k.eps_t        = 4.;
    k.closing_gap  = 1e-8;
    return k;
  }

private:
  std::mt19937 engine{42};
};

/** The trial traction: of the motion after the point has closed. */
template <int dim>
Tensor<1, dim>
trial_traction(const ContactKinematics<dim> &k)
{
  const double         gap     = k.initial_gap + k.normal * k.jump;
  const double         old_gap = k.initial_gap + k.normal * k.old_jump;
  const double         closed  = old_gap > 0. && gap < 0. ? -gap / (old_gap - gap) : 1.;
  const Tensor<1, dim> motion  = k.jump - k.old_jump;
  return k.old_tau - k.eps_t * closed * (motion - k.normal * (k.normal * motion));
}

template <int dim>
Tensor<2, dim>
finite_differences(const ContactLaw law, const double mu, const ContactKinematics<dim> &kinematics,
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

constexpr ContactLaw all_laws[] = {ContactLaw::none, ContactLaw::frictionless, ContactLaw::coulomb,
                                   ContactLaw::stick, ContactLaw::tied};

template <int dim>
void
compare_tangents()
{
  constexpr double step = 1e-5;
  for (const ContactLaw law : all_laws)
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
            << name_of(contact_law_names, law) << ", "
            << name_of(contact_status_names, response.status);
        }
      const bool may_open = law != ContactLaw::tied;
      const bool may_stick
        = law == ContactLaw::coulomb || law == ContactLaw::stick || law == ContactLaw::tied;
      const bool may_slip = law == ContactLaw::coulomb || law == ContactLaw::frictionless;
      EXPECT_EQ(n_states[ContactStatus::open] > 20, may_open) << name_of(contact_law_names, law);
      EXPECT_EQ(n_states[ContactStatus::stick] > 20, may_stick) << name_of(contact_law_names, law);
      EXPECT_EQ(n_states[ContactStatus::slip] > 20, may_slip) << name_of(contact_law_names, law);
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
      const auto           response = contact_response<dim>(ContactLaw::coulomb, mu, k);
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
      const auto stuck = contact_response<dim>(ContactLaw::stick, 0., k);
      EXPECT_LE(gap < 0. ? (stuck.tau - trial).norm() : stuck.tau.norm(), 1e-13);
      // Frictionless contact has no tangential traction.
      EXPECT_EQ(contact_response<dim>(ContactLaw::frictionless, 0., k).tau.norm(), 0.);
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
  for (const ContactLaw law : {ContactLaw::frictionless, ContactLaw::coulomb, ContactLaw::stick})
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
  k.initial_gap         = 0.5 * k.closing_gap;
  k.jump                = Tensor<1, 2>();
  const Tensor<2, 2> nn = outer_product(k.normal, k.normal);
  const Tensor<2, 2> stick
    = k.eps_n * nn + k.eps_t * (Tensor<2, 2>(unit_symmetric_tensor<2>()) - nn);
  for (const ContactLaw law : {ContactLaw::coulomb, ContactLaw::stick})
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
      const auto response = contact_response<3>(ContactLaw::tied, 0., k);
      EXPECT_EQ(response.status, ContactStatus::stick);
      // Whatever the initial gap: tension where the bodies move apart.
      EXPECT_NEAR(response.pressure, k.old_pressure - k.eps_n * motion, 1e-13);
      k.jump += 10. * k.normal;
      EXPECT_LE((contact_response<3>(ContactLaw::tied, 0., k).tau - response.tau).norm(), 1e-12);
    }
}

TEST(ContactLaw, TiedRemembersItsTraction)
{
  // One step, two steps, and two steps with jumps that count from the start of each: the same.
  Random<3> random;
  for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const auto           first = random.kinematics();
      const Tensor<1, 3>   end   = first.jump + random.vector();
      ContactKinematics<3> once = first, again = first, moving = first;
      once.jump           = end;
      const auto halfway  = contact_response<3>(ContactLaw::tied, 0., first);
      const auto expected = contact_response<3>(ContactLaw::tied, 0., once);
      for (ContactKinematics<3> *k : {&again, &moving})
        {
          k->old_jump     = first.jump;
          k->old_tau      = halfway.tau;
          k->old_pressure = halfway.pressure;
          k->jump         = end;
        }
      moving.old_jump = Tensor<1, 3>();
      moving.jump     = end - first.jump;
      for (const ContactKinematics<3> &k : {again, moving})
        {
          const auto response = contact_response<3>(ContactLaw::tied, 0., k);
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
  for (const ContactLaw law : {ContactLaw::coulomb, ContactLaw::stick})
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
      EXPECT_EQ(n_slip > 100, law == ContactLaw::coulomb);
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
  for (const ContactLaw law : all_laws)
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
} // namespace
} // namespace scree
