// Contact by an interior-point method.
#include <gtest/gtest.h>

#include <scree/contact/interior_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "contact_model.h"

namespace scree
{
namespace
{
using Tensor = dealii::Tensor<1, 2>;

/** Two half planes of a gap, with friction 0.3, the upper one moved by what `motion` says. */
struct HalfPlanes
{
  HalfPlanes(const double gap, const std::string &law)
      : model(two_half_planes(0., gap, 1))
      , pairs(with_friction(pairs_with(model, law)))
      , contact(model.bodies, pairs,
                level_set_surface(*model.space, *model.level_set_nodes, model.bodies, pairs,
                                  CutBodies<2>::shift * model.grid.finest_size()))
      , history(contact.initial_history())
  {
  }

  static std::vector<ContactPair> with_friction(std::vector<ContactPair> pairs)
  {
    for (ContactPair &pair : pairs)
      pair.law.friction_coefficient = 0.3;
    return pairs;
  }

  void move(const Tensor &motion)
  {
    u = displacement<2>(model, contact, [&](const unsigned int body, const dealii::Point<2> &) {
      return body == 1 ? motion : Tensor();
    });
    contact.evaluate(u, history);
  }

  InteriorContact<2> interior()
  {
    return {contact, history, {0.5}, model.grid.communicator()};
  }

  CutBodies<2>                          model;
  std::vector<ContactPair>              pairs;
  ContactPoints<2>                      contact;
  ContactHistory<2>                     history;
  dealii::TrilinosWrappers::MPI::Vector u;
};

/** The largest difference of forces from those of the laws, in parts of the largest of these. */
double
difference_from_laws(const HalfPlanes &planes, const std::vector<Tensor> &forces)
{
  double difference = 0., largest = 0.;
  for (unsigned int i = 0; i < forces.size(); ++i)
    {
      const auto  &point = planes.contact.points()[i];
      const Tensor f     = point.weight * planes.contact.responses()[i].traction(point.normal);
      difference         = std::max(difference, (forces[i] - f).norm());
      largest            = std::max(largest, f.norm());
    }
  return difference / largest;
}

// With bodies that stay, p s -> 0 leads to the tractions of the laws.
TEST(InteriorContact, EndsAtTheTractionsOfTheLaws)
{
  for (const auto &[law, motion] : {std::make_pair("frictionless", Tensor({0.01, -0.002})),
                                    std::make_pair("coulomb", Tensor({0.01, -0.002})),
                                    std::make_pair("coulomb", Tensor({1e-4, -0.002}))})
    {
      HalfPlanes planes(-0.01, law);
      planes.move(motion);
      auto interior = planes.interior();
      for (unsigned int n = 0; n < 60; ++n)
        {
          interior.tangent(0.1 * interior.complementarity());
          interior.advance(interior.step_length());
        }
      EXPECT_LT(interior.complementarity(), 1e-12);
      EXPECT_LT(interior.infeasibility(), 1e-12);
      EXPECT_LT(difference_from_laws(planes, interior.tangent(0.).forces), 1e-6) << law;
    }
}

// A whole step makes s = g + p/eps, and p s = mu but for dp ds; forces change as the tangent says.
TEST(InteriorContact, StepsAreThoseOfNewton)
{
  HalfPlanes planes(0.02, "frictionless");
  planes.move(Tensor());
  auto         interior = planes.interior();
  const double first    = interior.complementarity();
  EXPECT_GT(first, 0.);
  const auto   tangent = interior.tangent(0.9 * first);
  const Tensor motion({0., -1e-4});
  planes.contact.take_jumps(displacement<2>(planes.model, planes.contact,
                                            [&](const unsigned int body, const dealii::Point<2> &) {
                                              return body == 1 ? motion : Tensor();
                                            }));
  ASSERT_EQ(interior.step_length(), 1.);
  interior.advance(1.);
  EXPECT_LT(interior.infeasibility(), 1e-14);
  EXPECT_NEAR(interior.complementarity(), 0.9 * first, 0.02 * first);
  const auto after = interior.tangent(0.9 * first);
  for (unsigned int i = 0; i < after.forces.size(); ++i)
    {
      const auto  &point = planes.contact.points()[i];
      const Tensor expected
        = tangent.forces[i] + tangent.changes[i] - tangent.stiffness[i] * motion;
      EXPECT_NEAR(after.forces[i] * point.normal, expected * point.normal,
                  1e-10 * std::abs(tangent.forces[i] * point.normal));
    }
}

// What opens ever so far keeps p and s above zero: the step is shortened.
TEST(InteriorContact, StepsKeepPressuresPositive)
{
  HalfPlanes planes(-0.01, "coulomb");
  planes.move(Tensor());
  auto interior = planes.interior();
  interior.tangent(0.1 * interior.complementarity());
  planes.contact.take_jumps(displacement<2>(planes.model, planes.contact,
                                            [&](const unsigned int body, const dealii::Point<2> &) {
                                              return body == 1 ? Tensor({0., -1.}) : Tensor();
                                            }));
  const double alpha = interior.step_length();
  EXPECT_GT(alpha, 0.);
  EXPECT_LT(alpha, 0.99);
  interior.advance(alpha);
  EXPECT_GT(interior.complementarity(), 0.);
}
// Points that are farther than a cell are left out until bodies come near; no step goes past them.
TEST(InteriorContact, TakesUpPointsThatComeNear)
{
  HalfPlanes   planes(0., "frictionless");
  const double h = planes.model.grid.finest_size();
  planes.move(Tensor({0., 2. * h}));
  auto       interior = planes.interior();
  const auto n_taken  = [&]() {
    const auto taken = interior.taken();
    return std::count(taken.begin(), taken.end(), true);
  };
  const auto move_back = [&](const double y) {
    planes.contact.take_jumps(displacement<2>(
      planes.model, planes.contact, [&](const unsigned int body, const dealii::Point<2> &) {
        return body == 1 ? Tensor({0., y}) : Tensor();
      }));
  };
  EXPECT_EQ(n_taken(), 0);
  EXPECT_FALSE(interior.take_near());
  interior.tangent(0.);
  move_back(-2. * h);
  EXPECT_NEAR(interior.step_length(), 0.99 * 0.5, 1e-6);
  move_back(0.5 * h);
  interior.advance(1.);
  EXPECT_TRUE(interior.take_near());
  EXPECT_EQ(n_taken(), static_cast<long>(planes.contact.points().size()));
  EXPECT_FALSE(interior.take_near());
}
} // namespace
} // namespace scree
