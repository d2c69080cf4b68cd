// Expressions that are declared to be distances.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/distance_claim.h>
#include <scree/geometry/expression_shape.h>
#include <scree/geometry/level_set_from_shape.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

const BoundingBox<2> box({Point<2>(-1, -1), Point<2>(1, 1)});

std::string
message(const std::string &expression, const double unit = 1., const double spacing = 0.05)
{
  const ExpressionShape<2> shape(Expression<2>(expression, 1, "Expression"), true);
  const BoundingBox<2>     scaled({Point<2>(-unit, -unit), Point<2>(unit, unit)});
  try
    {
      require_distance<2>(shape, spacing * unit, scaled, "Bodies/a/Shape");
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

TEST(DistanceClaim, DistancesPass)
{
  for (const double spacing : {0.2, 0.05, 0.01})
    for (const std::string expression :
         {"sqrt(x^2+y^2)-0.8", "0.6*x+0.8*y-0.1", "max(abs(x),abs(y))-0.5",
          "abs(sqrt(x^2+y^2)-0.6)-0.2", "min(sqrt((x-0.4)^2+y^2),sqrt((x+0.4)^2+y^2))-0.3"})
      EXPECT_EQ(message(expression, 1., spacing), "") << expression << " " << spacing;
  EXPECT_EQ(message("sqrt(x^2+y^2)-800", 1000.), "");
  EXPECT_EQ(message("sqrt(x^2+y^2)-0.0008", 0.001), "");
}

TEST(DistanceClaim, OthersAreToldWithTheirSlope)
{
  const std::string twice = message("2*(sqrt(x^2+y^2)-0.8)");
  EXPECT_NE(twice.find("Bodies/a/Shape/Expression"), std::string::npos) << twice;
  EXPECT_NE(twice.find("changes by 2 per length"), std::string::npos) << twice;
  for (const std::string expression :
       {"0.5*(sqrt(x^2+y^2)-0.8)", "x^2+y^2-0.64", "x^2/0.8+y^2/0.3-0.8", "1e155*x", "1e-200*y",
        "sqrt(x^2+2*y^2)-0.7"})
    EXPECT_NE(message(expression), "") << expression;
}

// The level set of a formula does not depend on its scale.
TEST(DistanceClaim, TheScaleOfOtherFormulasDoesNotMatter)
{
  LatticeFrame<2> frame;
  frame.spacing      = 0.05;
  frame.origin       = Point<2>(-1, -1);
  frame.box          = box;
  const auto lattice = [&](const std::string &factor) {
    const Expression<2> expression(factor + "*(x^2+(y-0.1)^2-0.49)", 1, "Expression");
    return make_lattice<2>(std::make_shared<ExpressionShape<2>>(expression, false), frame, 0.1);
  };
  const auto expected = lattice("1");
  for (const std::string factor : {"1e155", "1e-155", "1e300", "1e-290", "3"})
    {
      const auto found = lattice(factor);
      ASSERT_EQ(found.values().size(), expected.values().size()) << factor;
      double difference = 0.;
      for (std::size_t i = 0; i < found.values().size(); ++i)
        difference = std::max(difference, std::abs(found.values()[i] - expected.values()[i]));
      EXPECT_LT(difference, 1e-10) << factor;
    }
}
} // namespace
} // namespace scree
