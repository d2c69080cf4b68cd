// Shares that laws in increments tell of their moduli.
#include <gtest/gtest.h>

#include <scree/material/increment_law.h>

namespace scree
{
TEST(IncrementLaw, ShareOfProjectedVolumeAndSecantRatio)
{
  MaterialParameters parameters;
  parameters.law     = "neo-Hookean";
  parameters.young   = 260.;
  parameters.poisson = 0.3;
  // lambda = 150, mu = 100: less than 4 mu
  EXPECT_EQ(make_increment_law<2>(parameters)->projected_share(), 0.);
  // lambda = 900, mu = 100
  parameters.young   = 290.;
  parameters.poisson = 0.45;
  EXPECT_NEAR(make_increment_law<2>(parameters)->projected_share(), 0.5, 1e-12);
  EXPECT_NEAR(make_increment_law<3>(parameters)->projected_share(), 500. / (900. + 200. / 3.),
              1e-12);
  EXPECT_EQ(make_increment_law<2>(parameters)->secant_ratio(1.), 1.);
  parameters.poisson = -0.2;
  EXPECT_EQ(make_increment_law<2>(parameters)->projected_share(), 0.);
  parameters.law               = "J2";
  parameters.young             = 260.;
  parameters.poisson           = 0.3;
  parameters.yield_stress      = 3.;
  parameters.hardening_modulus = 300.;
  const auto law               = make_increment_law<3>(parameters);
  EXPECT_EQ(law->projected_share(), 1.);
  EXPECT_EQ(law->secant_ratio(-1e-9), 1.);
  // elastic strain (3 + 300 * 0.03)/300 = 0.04
  EXPECT_NEAR(law->secant_ratio(0.03), 0.04 / 0.07, 1e-12);
}
} // namespace scree
