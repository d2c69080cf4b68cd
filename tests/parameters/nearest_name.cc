#include <gtest/gtest.h>

#include <scree/parameters/nearest_name.h>

// The nearest valid name is told only if it is close.

using namespace scree;

TEST(NearestName, IsTheOneWithTheFewestChanges)
{
  const std::vector<std::string> names = {"Material", "Materials", "Shape", "Law"};
  EXPECT_EQ(nearest_name("Materal", names), "Material");
  EXPECT_EQ(nearest_name("materialss", names), "Materials");
  EXPECT_EQ(nearest_name("sHAPE", names), "Shape");
  EXPECT_EQ(nearest_name("Low", names), "Law");
}

TEST(NearestName, IsEmptyIfNoneIsClose)
{
  const std::vector<std::string> names = {"Material", "Law"};
  EXPECT_EQ(nearest_name("Gravity", names), "");
  EXPECT_EQ(nearest_name("x", names), "");
  EXPECT_EQ(nearest_name("ab", {"cd"}), "");
  // Three changes are allowed in nine letters, not in eight.
  EXPECT_EQ(nearest_name("abcdefghi", {"abcdef"}), "abcdef");
  EXPECT_EQ(nearest_name("abcdefgh", {"abcde"}), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

TEST(NearestName, IsPutAsAQuestion)
{
  EXPECT_EQ(did_you_mean("Lav", {"Law"}), "; did you mean 'Law'?");
  EXPECT_EQ(did_you_mean("Gravity", {"Law"}), "");
}
