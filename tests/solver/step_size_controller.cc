// The step size by the error of the last steps.
#include <gtest/gtest.h>

#include <scree/solver/step_size_controller.h>

#include <cmath>

namespace scree
{
namespace
{
TEST(StepSizeController, FindsTheStepOfAnErrorThatGoesWithAPower)
{
  for (const unsigned int order : {1u, 2u})
    for (const double first : {1e-3, 3.})
      {
        StepSizeController controller;
        double             dt = first, ratio = 0.;
        for (unsigned int n = 0; n < 60; ++n)
          {
            ratio = std::pow(dt, order);
            dt *= ratio > 1. ? StepSizeController::reject({ratio, order})
                             : controller.accept({ratio, order});
          }
        EXPECT_LE(ratio, 1.);
        EXPECT_GT(ratio, 0.25);
      }
}

TEST(StepSizeController, HasBounds)
{
  StepSizeController controller;
  EXPECT_EQ(controller.accept({0., 2}), 2.);
  EXPECT_EQ(controller.last_ratio(), 0.1);
  EXPECT_EQ(controller.accept({1e-9, 2}), 2.);
  EXPECT_EQ(StepSizeController::reject({1e9, 2}), 0.2);
  EXPECT_DOUBLE_EQ(StepSizeController::reject({1.5, 1}), 0.6);
}
} // namespace
} // namespace scree
