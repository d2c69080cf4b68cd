#include <gtest/gtest.h>

#include <scree/mechanics/balance_checks.h>

using namespace scree;

TEST(BalanceChecks, RoundingIsNoImbalanceOnlyWhereThereAreNoForces)
{
  const double tolerance = 1e-9, rounding = 6e-9;
  // Forces
  EXPECT_DOUBLE_EQ(balanced_residual(100., tolerance, rounding, 1.), 1e-7);
  EXPECT_DOUBLE_EQ(balanced_residual(1., tolerance, rounding, 1.), rounding);
  EXPECT_DOUBLE_EQ(balanced_residual(1e-5, tolerance, rounding, 1.), 1e-11);
  // Grains that lost contact: 67 of them stood at 3e-8 and were refused.
  EXPECT_DOUBLE_EQ(balanced_residual(3e-8, tolerance, rounding, 1.), rounding);
  // The same forces on a soft body beside a stiff one are forces.
  EXPECT_DOUBLE_EQ(balanced_residual(3e-8, tolerance, rounding, 1e-6), 3e-14);
}
