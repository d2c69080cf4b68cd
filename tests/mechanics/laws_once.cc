// Laws are asked once per Newton iteration on a moving geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "started_step.h"

namespace scree
{
namespace
{
using namespace dealii;

std::string
held_disc()
{
  return grid_text("-1.1, -1.1", "1.1, 1.1", "1, 1", 3) + degree_text(1)
         + bodies_text(
           {{"disc", ball_text("0.01, 0.02", 0.9)
                       + conditions_text(
                         {{"hold", "set On = surface\nset Where = x < -0.4\nset Value = 0; 0"},
                          {"press", "set Type = pressure\nset Where = x > 0.4\nset Value = 30"}})}})
         + contact_text("set Law = frictionless");
}

Tensor<1, 2>
wavy(const Point<2> &x)
{
  return Tensor<1, 2>({0.05 * std::sin(2. * x[1]) + 0.1 * x[0], 0.04 * x[0] * x[1]});
}

/** A law that counts its points. */
class CountingLaw : public IncrementLaw<2>
{
public:
  explicit CountingLaw(const std::shared_ptr<const IncrementLaw<2>> &law)
      : IncrementLaw<2>(*law)
      , law(law)
  {
  }
  InternalTensor internal() const override
  {
    return law->internal();
  }
  WorkOf work() const override
  {
    return law->work();
  }
  void respond(const ArrayView<const Tensor<2, 2>>   &increments,
               const ArrayView<const IncrementStart> &starts,
               const ArrayView<IncrementResponse<2>> &responses,
               const ArrayView<Tensor<4, 2>>         &tangents) const override
  {
    n_points += increments.size();
    law->respond(increments, starts, responses, tangents);
  }
  mutable std::size_t n_points = 0;

private:
  std::shared_ptr<const IncrementLaw<2>> law;
};
} // namespace

TEST(MovingEquilibrium, LawsAreAskedOncePerIteration)
{
  StartedStep<2> step(held_disc(), "J2", wavy);
  const auto     law = std::make_shared<const CountingLaw>(step.cut.bodies[0].law);
  const auto asked   = [&]() { return static_cast<unsigned int>(std::exchange(law->n_points, 0)); };
  step.cut.bodies[0].law              = law;
  const ContactHistory<2> history     = step.contact.initial_history();
  StartedStep<2>::Vector  u           = step.random(0.005, 1), r(u);
  Equilibrium<2>         &equilibrium = step.equilibrium;
  equilibrium.set_time(0., u);
  equilibrium.residual(u, history, r);
  const unsigned int all = asked();
  EXPECT_GT(all, 0u);
  equilibrium.tangent(); // no tangent had been expected
  EXPECT_EQ(asked(), all);
  for (const unsigned int iteration : {1u, 2u})
    {
      u.add(1e-4 * iteration, step.random(1., 2));
      equilibrium.residual(u, history, r);
      equilibrium.force_scale();
      equilibrium.tangent();
      EXPECT_EQ(asked(), all);
    }
  equilibrium.accept(u, history);
  EXPECT_EQ(asked(), 0u);
}
} // namespace scree
