// Bodies from their parameters, and which of them may touch.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/bodies/broad_phase.h>
#include <scree/parameters/file.h>

#include <cmath>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Bodies of one material in the box [-1, 1]^2. */
std::vector<Body<2>>
bodies(const std::string &text)
{
  ParameterFile    file       = ParameterFile::from_string(text);
  ParameterSection section    = file.root();
  const auto       parameters = declare_bodies<2>(section, {{"soft", {}}});
  file.check();
  MaterialParameters material;
  material.young                                = 1.;
  material.poisson                              = 0.;
  const std::shared_ptr<const Material<2>> soft = make_material<2>(material);
  const Point<2>                           lower(-1., -1.), upper(1., 1.);
  return make_bodies<2>(parameters, {{"soft", soft}}, {lower, 0.05, BoundingBox<2>({lower, upper})},
                        0.3);
}

std::string
disc(const std::string &name, const double x, const double radius)
{
  return "subsection " + name + "\n set Material = soft\n subsection Shape\n  set Type = disc\n"
         + "  set Centre = " + std::to_string(x) + ", 0\n  set Radius = " + std::to_string(radius)
         + "\n end\nend\n";
}

std::string
message(const std::string &text)
{
  return complaint([&]() { bodies(text); });
}

TEST(Bodies, LevelSetsAndBoxes)
{
  const auto found = bodies("set Names = a, b\n" + disc("a", -0.4, 0.3) + disc("b", 0.8, 0.3));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].name, "b");
  EXPECT_NEAR(found[0].level_set.nodal_value(Point<2>(-0.4, 0.)), -0.3, 1e-12);
  EXPECT_NEAR(found[0].level_set.nodal_value(Point<2>(0., 0.)), 0.1, 1e-12);
  // The box is clipped by the background box.
  EXPECT_NEAR(found[1].box.lower_bound(0), 0.5, 1e-12);
  EXPECT_NEAR(found[1].box.upper_bound(0), 1., 1e-12);
  EXPECT_NEAR(found[1].box.upper_bound(1), 0.3, 1e-12);
}

TEST(Bodies, CandidatePairs)
{
  const auto found = bodies("set Names = a, b, c\n" + disc("a", -0.7, 0.2) + disc("b", 0., 0.2)
                            + disc("c", 0.45, 0.2));
  using Pairs      = std::vector<std::pair<unsigned int, unsigned int>>;
  EXPECT_EQ(BodyBoxes<2>(found).pairs(0.01), (Pairs{}));
  EXPECT_EQ(BodyBoxes<2>(found).pairs(0.06), (Pairs{{1, 2}}));
  EXPECT_EQ(BodyBoxes<2>(found).pairs(0.31), (Pairs{{0, 1}, {1, 2}}));
  EXPECT_EQ(BodyBoxes<2>(found).pairs(2.), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(Bodies, WrongBodiesAreExplained)
{
  expect_contains(message("set Names = a\n" + disc("a", 5., 0.3)), "lies outside");
  expect_contains(message("set Names = a\nsubsection a\nend\n"), "no material is given");
  expect_contains(message("set Names = a\nsubsection a\n set Material = hard\nend\n"),
                  "there is no material 'hard'");
  std::string text = disc("a", 0., 0.3);
  text.insert(text.find(" subsection Shape"), " set Body force = 1; 2; 3\n");
  expect_contains(message("set Names = a\n" + text), "3 component(s)");
  const std::string formula
    = "set Names = a\nsubsection a\n set Material = soft\n subsection Shape\n"
      "  set Type = expression\n  set Expression = sqrt(x) - 1\n end\nend\n";
  expect_contains(message(formula), "no finite number");
}
} // namespace
} // namespace scree
