// What a boundary condition says, and what is wrong with it.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/parameters/file.h>

#include <functional>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
BoundaryCondition<dim>
condition(const std::string &text)
{
  ParameterFile                    file    = ParameterFile::from_string(text);
  ParameterSection                 section = file.root();
  BoundaryConditionParameters<dim> parameters;
  parameters.declare(section);
  file.check();
  return BoundaryCondition<dim>("top", "Bodies/disc/Boundary conditions/top", parameters);
}

std::string
message(const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

void
expect_refused(const std::string &text, const std::string &part)
{
  const std::string told = message([&]() { condition<2>(text); });
  EXPECT_NE(told.find(part), std::string::npos) << "'" << part << "' is not in:\n" << told;
}

TEST(BoundaryCondition, ValuesOfComponents)
{
  const auto c = condition<3>("set On = z+\nset Components = z, x\nset Value = 2*t*x; y - z");
  EXPECT_EQ(c.components, (std::vector<unsigned int>{2, 0}));
  EXPECT_EQ(c.box_face, 5u);
  EXPECT_TRUE(c.is_strong());
  const Point<3> point(1., 2., 5.);
  EXPECT_EQ(c.value(0, point, 3.), 6.);
  const Tensor<1, 3> vector = c.vector(point, 3.);
  EXPECT_EQ(vector[0], -3.);
  EXPECT_EQ(vector[1], 0.);
  EXPECT_EQ(vector[2], 6.);
}

TEST(BoundaryCondition, Defaults)
{
  const auto c = condition<2>("");
  EXPECT_EQ(c.box_face, BoundaryCondition<2>::no_face);
  EXPECT_EQ(c.components, (std::vector<unsigned int>{0, 1}));
  EXPECT_FALSE(c.is_strong());
  EXPECT_EQ(c.vector(Point<2>(1., 1.), 1.).norm(), 0.);
  EXPECT_TRUE(c.selects(Point<2>(1., 1.)));
}

TEST(BoundaryCondition, RegionsAndRotations)
{
  const auto c = condition<2>("set Type = mean support\nset Where = x > 1 && y < 0\n"
                              "set Components = y, rotation\nset Value = 1; 2");
  EXPECT_EQ(c.components, (std::vector<unsigned int>{1, BoundaryCondition<2>::rotation}));
  EXPECT_TRUE(c.selects(Point<2>(1.5, -0.5)));
  EXPECT_FALSE(c.selects(Point<2>(1.5, 0.5)));
  EXPECT_FALSE(condition<2>("set On = x-\nset Method = nitsche").is_strong());
}

TEST(BoundaryCondition, WrongEntriesAreExplained)
{
  expect_refused("set Components = x, x", "'x' is listed twice");
  expect_refused("set Components = z\nset Value = 1", "'z' is no component here");
  expect_refused("set Value = 1", "has 1 component(s)");
  expect_refused("set Type = springs", "needs a value");
  expect_refused("set Type = pressure\nset Value = 1\nset Components = x", "does not use it");
  expect_refused("set Type = traction\nset Value = 1; 2\nset Method = penalty", "does not use it");
  expect_refused("set Type = traction\nset Value = 1; 2\nset Penalty factor = 3",
                 "does not use it");
  expect_refused("set Point = 1, 2", "does not use it");
  expect_refused("set Type = point support\nset On = x-", "does not use it");
  expect_refused("set Type = point support\nset Where = x > 0", "does not use it");
  expect_refused("set Penalty factor = 0", "without a penalty");
  EXPECT_EQ(
    message([]() { condition<2>("set Method = nonsymmetric nitsche\nset Penalty factor = 0"); }),
    "");
}

TEST(BoundaryCondition, ValuesMustBeFinite)
{
  const auto c = condition<2>("set Type = traction\nset Value = 1/x; log(y)");
  EXPECT_EQ(c.value(0, Point<2>(2., 1.), 0.), 0.5);
  for (const auto &point : {Point<2>(0., 1.), Point<2>(1., -1.)})
    {
      const std::string told = message([&]() { c.vector(point, 0.25); });
      EXPECT_NE(told.find("Bodies/disc/Boundary conditions/top/Value"), std::string::npos) << told;
      EXPECT_NE(told.find("no finite number"), std::string::npos) << told;
      EXPECT_NE(told.find("t = 0.25"), std::string::npos) << told;
    }
}
} // namespace
} // namespace scree
