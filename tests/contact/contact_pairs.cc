// Pairs are found among boxes within reach; bodies that pass through each other are no pair.
#include <gtest/gtest.h>

#include <scree/contact/contact_pairs.h>

#include "../discretization/cut_bodies.h"

namespace scree
{
namespace
{
TEST(ContactPairs, AreWithinReachAndHaveALaw)
{
  const auto box = [](const std::string &lower, const std::string &upper) {
    return shape_text("box", "set Lower corner = " + lower + "\nset Upper corner = " + upper);
  };
  const CutBodies<2> model(grid_text("0, 0", "4, 4", "4, 4", 2)
                           + bodies_text({{"a", box("0.1, 0.1", "1.05, 1.05")},
                                          {"b", box("1.35, 0.1", "2.05, 1.05")},
                                          {"c", box("3.35, 3.1", "3.85, 3.85")}}));
  ContactParameters  parameters;
  const auto         near = pairs_within(0.5, model.bodies, parameters);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].name, "a-b");
  EXPECT_EQ(near[0].law.kind->name, "frictionless");
  EXPECT_EQ(pairs_within(4., model.bodies, parameters).size(), 3u);
  EXPECT_TRUE(has_more_pairs_than(2, model.bodies, parameters));
  EXPECT_FALSE(has_more_pairs_than(3, model.bodies, parameters));

  ContactPairParameters none;
  none.bodies     = {"a", "b"};
  none.kind       = &contact_law("none");
  parameters.laws = {none};
  EXPECT_TRUE(pairs_within(0.5, model.bodies, parameters).empty());
  EXPECT_FALSE(has_more_pairs_than(2, model.bodies, parameters));
  EXPECT_TRUE(has_more_pairs_than(1, model.bodies, parameters));

  none.bodies     = {"*", "c"};
  parameters.laws = {none};
  EXPECT_FALSE(has_more_pairs_than(1, model.bodies, parameters));
  EXPECT_TRUE(has_more_pairs_than(0, model.bodies, parameters));
}
} // namespace
} // namespace scree
