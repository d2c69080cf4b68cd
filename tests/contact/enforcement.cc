// Enforcement by penalties and by multipliers.
#include <gtest/gtest.h>

#include <scree/contact/contact_energy.h>
#include <scree/contact/make_enforcement.h>

#include <cmath>
#include <memory>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Replaces the penalties of `contact` by multipliers on top of them. */
template <int dim>
void
use_multipliers(ContactPoints<dim> &contact, const double growth = 1.)
{
  EnforcementParameters parameters;
  parameters.type           = "augmented Lagrangian";
  parameters.largest_gap    = 1e-6;
  parameters.largest_growth = growth;
  contact.set_enforcement(make_enforcement<dim>(parameters, contact.points(),
                                                contact.enforcement().stiffness(), MPI_COMM_WORLD));
  contact.start_step(contact.initial_history());
}

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
  use_multipliers(plane.contact);
  plane.solve(force);
  EXPECT_NEAR(plane.largest_overlap(), overlap_of_penalty, 1e-9 * overlap_of_penalty);
  unsigned int n_updates = 0;
  for (; !plane.contact.update_enforcement() && n_updates < 10; ++n_updates)
    plane.solve(force);
  EXPECT_GT(n_updates, 0u);
  EXPECT_LT(n_updates, 5u);
  EXPECT_LT(plane.largest_overlap(), 1e-6 * plane.contact.points()[0].cell_size);
  double total = 0.;
  for (unsigned int i = 0; i < plane.contact.points().size(); ++i)
    total += plane.contact.points()[i].weight * plane.contact.responses()[i].pressure;
  EXPECT_NEAR(total, force + plane.spring * plane.height, 1e-8 * force);
  // What is enforced stores nothing.
  EXPECT_EQ(stored_energy(plane.contact, MPI_COMM_WORLD), 0.);
  // The next step starts with these tractions and changes nothing.
  const auto history = plane.contact.current_history();
  plane.contact.start_step(history);
  const double height = plane.height;
  EXPECT_LE(plane.solve(force), 1u);
  EXPECT_NEAR(plane.height, height, 1e-6 * plane.contact.points()[0].cell_size);
  EXPECT_TRUE(plane.contact.update_enforcement());
}

TEST(Enforcement, MultipliersHoldWhatSticks)
{
  const CutBodies<2> model(two_half_planes(0., -0.0004, 1));
  ContactPoints<2>   contact = contact_points(model, "stick");
  use_multipliers(contact);
  const auto history = contact.initial_history();
  const auto u = displacement<2>(model, contact, [](const unsigned int body, const Point<2> &) {
    return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({1e-4, 0.});
  });
  contact.evaluate(u, history);
  const double eps_t = contact.enforcement().stiffness()[0].tangential,
               first = contact.responses()[0].tau.norm();
  EXPECT_NEAR(first, 1e-4 * eps_t, 1e-9 * first);
  // A slide that does not give in meets ever larger tractions.
  EXPECT_FALSE(contact.update_enforcement());
  contact.evaluate(u, history);
  EXPECT_NEAR(contact.responses()[0].tau.norm(), 2. * first, 1e-3 * first);
  // A step that begins again has forgotten them.
  contact.start_step(history);
  contact.evaluate(u, history);
  EXPECT_NEAR(contact.responses()[0].tau.norm(), first, 1e-9 * first);
}

/** The tangents of all points after an update, by differences of jumps. */
TEST(Enforcement, TangentOfMultipliers)
{
  const CutBodies<2> model(two_half_planes(0.1, 0.0004, 1));
  for (const std::string law : {"frictionless", "coulomb", "stick"})
    {
      std::vector<ContactPair> pairs;
      for (const auto &[a, b] : model.pairs)
        {
          ContactPairParameters parameters;
          parameters.kind                 = &contact_law(law);
          parameters.friction_coefficient = 0.3;
          pairs.push_back({a, b, "pair", parameters});
        }
      ContactPoints<2> contact(
        model.bodies, pairs,
        level_set_surface(*model.space, *model.level_set_nodes, model.bodies, pairs,
                          CutBodies<2>::shift * model.grid.finest_size(), {}));
      use_multipliers(contact);
      const auto history = contact.initial_history();
      const auto moved   = [&](const double x, const double y) {
        return displacement<2>(
          model, contact, [x, y](const unsigned int body, const Point<2> &place) {
            return body == 0 ? Tensor<1, 2>() : Tensor<1, 2>({x * (1. + place[0]), y});
          });
      };
      contact.evaluate(moved(2e-4, -0.001), history);
      contact.update_enforcement();
      contact.evaluate(moved(3e-4, -0.0008), history);
      const auto                jumps = contact.jumps();
      std::vector<unsigned int> numbers;
      for (unsigned int p = 0; p < jumps.size(); ++p)
        numbers.push_back(p);
      const auto   responses = contact.responses_to(numbers, jumps, history);
      const double delta     = 1e-9;
      unsigned int n_closed  = 0;
      for (unsigned int d = 0; d < 2; ++d)
        {
          auto plus = jumps, minus = jumps;
          for (unsigned int p = 0; p < jumps.size(); ++p)
            {
              plus[p][d] += delta;
              minus[p][d] -= delta;
            }
          const auto up   = contact.responses_to(numbers, plus, history),
                     down = contact.responses_to(numbers, minus, history);
          for (unsigned int p = 0; p < jumps.size(); ++p)
            {
              const Tensor<1, 2> &n = contact.points()[p].normal;
              const Tensor<1, 2>  difference
                = (down[p].traction(n) - up[p].traction(n)) / (2. * delta);
              const double scale = contact.enforcement().stiffness()[p].normal;
              for (unsigned int c = 0; c < 2; ++c)
                EXPECT_NEAR(responses[p].tangent[c][d], difference[c], 1e-6 * scale) << law;
              n_closed += responses[p].pressure > 0.;
            }
        }
      EXPECT_GT(n_closed, 0u);
    }
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
  EXPECT_NEAR(dissipation(contact, contact.initial_history(), 0.5, MPI_COMM_WORLD), 0.,
              1e-12 * stored);
  const auto history = contact.current_history();
  EXPECT_EQ(cut_energy(contact, history, MPI_COMM_WORLD), 0.);
  contact.laws().resolve_overlap({0.});
  contact.evaluate(moved(x), history);
  EXPECT_NEAR(cut_energy(contact, history, MPI_COMM_WORLD), 0.5 * eps_t * x * x * 2.,
              1e-6 * eps_t * x * x);
}
} // namespace
} // namespace scree
