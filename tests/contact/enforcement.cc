// Enforcement by penalties, and by another one through the same interface.
#include <gtest/gtest.h>

#include <scree/contact/contact_energy.h>
#include <scree/contact/penalty.h>

#include <cmath>
#include <memory>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Uzawa's method for the pressure: p_t = lambda - eps_n g, lambda <- p till gaps close. */
class Uzawa : public Penalty<2>
{
public:
  Uzawa(const std::vector<ContactStiffness> &penalties, const double largest_gap)
      : Penalty<2>(penalties)
      , multipliers(penalties.size())
      , largest_gap(largest_gap)
  {
  }

  std::vector<TrialTraction<2>> trial_tractions(const std::vector<unsigned int>     &numbers,
                                                const std::vector<ContactMotion<2>> &motions,
                                                const ContactHistory<2> &history) const override
  {
    auto result = Penalty<2>::trial_tractions(numbers, motions, history);
    for (unsigned int i = 0; i < numbers.size(); ++i)
      result[i].pressure += multipliers[numbers[i]];
    return result;
  }

  std::vector<double> stored_energy(const std::vector<double>       &pressures,
                                    const std::vector<Tensor<1, 2>> &tau) const override
  {
    std::vector<double> elastic = pressures;
    for (unsigned int i = 0; i < elastic.size(); ++i)
      elastic[i] -= multipliers[i];
    return Penalty<2>::stored_energy(elastic, tau);
  }

  bool update(const std::vector<ContactResponse<2>> &responses) override
  {
    ++n_updates;
    bool is_enforced = true;
    for (unsigned int i = 0; i < responses.size(); ++i)
      is_enforced
        &= std::abs(responses[i].pressure - multipliers[i]) <= largest_gap * stiffness()[i].normal;
    for (unsigned int i = 0; i < responses.size() && !is_enforced; ++i)
      multipliers[i] = responses[i].pressure;
    return is_enforced;
  }

  unsigned int n_updates = 0;

private:
  std::vector<double> multipliers;
  double              largest_gap;
};

/** Two half planes; the upper one is pressed down by a force, and held by a soft spring. */
class PressedPlane
{
public:
  PressedPlane()
      : model(two_half_planes(0., 0.0004, 1))
      , contact(contact_points(model))
  {
  }

  /** Newton's method for the height v of the upper body; the steps it took. */
  unsigned int solve(const double force)
  {
    for (unsigned int n = 0; n < 10; ++n)
      {
        contact.evaluate(
          displacement<2>(model, contact,
                          [&](const unsigned int body, const Point<2> &) {
                            return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({0., height});
                          }),
          contact.initial_history());
        double residual = -force - spring * height, stiffness = spring;
        for (unsigned int i = 0; i < contact.points().size(); ++i)
          {
            const auto &point    = contact.points()[i];
            const auto &response = contact.responses()[i];
            residual += point.weight * response.traction(point.normal)[1];
            stiffness += point.weight * response.tangent[1][1];
          }
        if (std::abs(residual) <= 1e-10 * force)
          return n;
        height += residual / stiffness;
      }
    ADD_FAILURE() << "no equilibrium";
    return 0;
  }

  double largest_overlap() const
  {
    double result = 0.;
    for (unsigned int i = 0; i < contact.points().size(); ++i)
      result = std::max(result, -contact.gap(i));
    return result;
  }

  CutBodies<2>     model;
  ContactPoints<2> contact;
  const double     spring = 1.;
  double           height = 0.;
};

constexpr double force = 100.;

TEST(Enforcement, PenaltyIsFinished)
{
  PressedPlane plane;
  plane.solve(force);
  EXPECT_TRUE(plane.contact.update_enforcement());
  // Springs in parallel, on the length 2.
  const double eps_n = plane.contact.enforcement().stiffness()[0].normal;
  EXPECT_NEAR(plane.largest_overlap(), force / (2. * eps_n), 1e-3 * force / eps_n);
  EXPECT_NEAR(stored_energy(plane.contact, MPI_COMM_WORLD), 0.5 * force * plane.largest_overlap(),
              1e-3 * force * plane.largest_overlap());
}

TEST(Enforcement, MultipliersCloseTheGap)
{
  PressedPlane plane;
  plane.solve(force);
  const double overlap_of_penalty = plane.largest_overlap();
  auto         uzawa
    = std::make_unique<Uzawa>(plane.contact.enforcement().stiffness(), 1e-6 * overlap_of_penalty);
  auto &state = *uzawa;
  plane.contact.set_enforcement(std::move(uzawa));
  plane.solve(force);
  EXPECT_NEAR(plane.largest_overlap(), overlap_of_penalty, 1e-9 * overlap_of_penalty);
  while (!plane.contact.update_enforcement() && state.n_updates < 10)
    plane.solve(force);
  EXPECT_GT(state.n_updates, 1u);
  EXPECT_LT(state.n_updates, 5u);
  EXPECT_LT(plane.largest_overlap(), 1e-5 * overlap_of_penalty);
  double total = 0.;
  for (unsigned int i = 0; i < plane.contact.points().size(); ++i)
    total += plane.contact.points()[i].weight * plane.contact.responses()[i].pressure;
  EXPECT_NEAR(total, force + plane.spring * plane.height, 1e-8 * force);
  // What is enforced stores nothing.
  EXPECT_LT(stored_energy(plane.contact, MPI_COMM_WORLD), 1e-9 * force * overlap_of_penalty);
}

TEST(Enforcement, CutTractionsLoseTheirEnergy)
{
  const CutBodies<2> model(two_half_planes(0., -0.0004, 1));
  ContactPoints<2>   contact = contact_points(model, "stick");
  const auto         moved   = [&](const double x) {
    return displacement<2>(model, contact, [x](const unsigned int body, const Point<2> &) {
      return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({x, 0.});
    });
  };
  const double x = 1e-4, eps_t = contact.enforcement().stiffness()[0].tangential;
  contact.evaluate(moved(x), contact.initial_history());
  const double stored = stored_energy(contact, MPI_COMM_WORLD);
  EXPECT_NEAR(dissipation(contact, contact.initial_history(), MPI_COMM_WORLD), 0., 1e-12 * stored);
  const auto history = contact.current_history();
  EXPECT_EQ(cut_energy(contact, history, MPI_COMM_WORLD), 0.);
  contact.laws().resolve_overlap({0.});
  contact.evaluate(moved(x), history);
  EXPECT_NEAR(cut_energy(contact, history, MPI_COMM_WORLD), 0.5 * eps_t * x * x * 2.,
              1e-6 * eps_t * x * x);
}
} // namespace
} // namespace scree
