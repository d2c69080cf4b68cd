// Which law belongs to a pair of bodies.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/contact/contact_parameters.h>
#include <scree/parameters/file.h>

#include <cmath>

#include "../messages.h"

namespace scree
{
namespace
{
ContactParameters
contact(const std::string &text)
{
  ParameterFile     file    = ParameterFile::from_string("subsection Contact\n" + text + "\nend\n");
  ParameterSection  section = file.root().subsection("Contact", "");
  ContactParameters result;
  result.declare(section, {"block", "grain 1", "grain 2", "wall"});
  file.check();
  return result;
}

std::string
message(const std::string &text)
{
  return complaint([&]() { contact(text); });
}

TEST(ContactParameters, FrictionlessWithoutLaws)
{
  const auto law = contact("").law_of("block", "wall");
  EXPECT_EQ(law.kind->name, "frictionless");
  EXPECT_EQ(law.normal_factor, 10.);
}

TEST(ContactParameters, LastMatchCountsInEitherOrder)
{
  const auto parameters = contact("set Names = default, grains, special\n"
                                  "subsection default\n set Friction coefficient = 0.1\nend\n"
                                  "subsection grains\n set Bodies = grain*, grain*\n"
                                  " set Law = stick\nend\n"
                                  "subsection special\n set Bodies = wall, *2\n"
                                  " set Law = tied\nend\n");
  EXPECT_EQ(parameters.law_of("block", "wall").name, "default");
  EXPECT_EQ(parameters.law_of("block", "wall").friction_coefficient, 0.1);
  EXPECT_EQ(parameters.law_of("grain 1", "grain 2").name, "grains");
  EXPECT_EQ(parameters.law_of("grain 1", "wall").name, "default");
  EXPECT_EQ(parameters.law_of("grain 2", "wall").name, "special");
  EXPECT_EQ(parameters.law_of("wall", "grain 2").name, "special");
}

TEST(ContactParameters, WildcardsStandForAnyText)
{
  ContactPairParameters law;
  law.bodies = {"g*n*", "*"};
  EXPECT_TRUE(law.matches("grain 1", "x"));
  EXPECT_TRUE(law.matches("x", "gn"));
  EXPECT_FALSE(law.matches("grai", "block"));
  law.bodies = {"a", "b"};
  EXPECT_FALSE(law.matches("a", "a"));
  EXPECT_FALSE(law.matches("ab", "b"));
}

TEST(ContactParameters, WrongLawsAreExplained)
{
  expect_contains(message("set Names = f\nsubsection f\nend"), "needs a friction coefficient");
  expect_contains(
    message("set Names = f\nsubsection f\n set Law = tied\n set Friction coefficient = 1\nend"),
    "the law tied does not use it");
  expect_contains(
    message("set Names = f\nsubsection f\n set Law = tied\n set Bodies = block, blok\nend"),
    "no body is called 'blok'");
  expect_contains(message("set Names = f\nsubsection f\n set Law = tied\n set Bodies = block\nend"),
                  "two names");
}
TEST(ContactParameters, LawsForNoPairAreRefused)
{
  const std::string two = message("set Names = first, second\n"
                                  "subsection first\n set Friction coefficient = 0.1\nend\n"
                                  "subsection second\n set Law = frictionless\nend\n");
  expect_contains(two, "Contact/first");
  expect_contains(two, "the law 'first' is used for no pair of bodies: 'second'");
  expect_contains(two, "block and grain 1");
  const std::string self = message("set Names = self\nsubsection self\n set Law = stick\n"
                                   " set Bodies = wall, wall\nend\n");
  expect_contains(self, "the law 'self' fits no two bodies");
  expect_contains(self, "not in contact with itself");
  // One pair is enough.
  EXPECT_EQ(message("set Names = default, grains\n"
                    "subsection default\n set Friction coefficient = 0.1\nend\n"
                    "subsection grains\n set Bodies = *, grain*\n set Law = stick\nend\n"),
            "");
}

TEST(ContactParameters, PenaltiesAndShiftHaveBounds)
{
  for (const std::string value : {"1e-300", "1e-3", "1e300"})
    expect_contains(message("set Names = a\nsubsection a\n set Law = stick\n"
                            " set Normal penalty factor = "
                            + value + "\nend\n"),
                    "Normal penalty factor");
  expect_contains(message("set Shift = 1e6"), "Shift");
}

TEST(ContactParameters, ManyStarsAreMatchedAtOnce)
{
  ContactPairParameters law;
  std::string           stars;
  for (unsigned int i = 0; i < 40; ++i)
    stars += "*a";
  law.bodies = {stars, "b*d"};
  EXPECT_TRUE(law.matches(std::string(40, 'a'), "bd"));
  EXPECT_TRUE(law.matches("b c d", std::string(60, 'a')));
  EXPECT_FALSE(law.matches(std::string(100, 'a') + "b", "bcd"));
  EXPECT_FALSE(law.matches(std::string(40, 'a'), "bdc"));
}

} // namespace
} // namespace scree
