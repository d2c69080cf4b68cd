#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

// The syntax of parameter files: continuation, includes, and what is said about wrong lines.

using namespace scree;

namespace
{
/** What is said when `text` is read, or "" if nothing. */
std::string
complaint(const std::string &text)
{
  try
    {
      ParameterFile::from_string(text);
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

/** A folder that is removed at the end of the test. */
class Folder : public testing::Test
{
protected:
  Folder()
      : path(std::filesystem::temp_directory_path()
             / ("scree_parameters_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path / "common");
  }

  ~Folder() override
  {
    std::filesystem::remove_all(path);
  }

  std::string write_file(const std::string &name, const std::string &content) const
  {
    std::ofstream(path / name) << content;
    return (path / name).string();
  }

  /** The message of reading `file_path`, without the path of the folder. */
  std::string reading_error(const std::string &file_path) const
  {
    try
      {
        ParameterFile::read(file_path);
      }
    catch (const UserError &error)
      {
        std::string       message = error.what();
        const std::string prefix  = path.string() + "/";
        for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
          message.erase(at, prefix.size());
        return message;
      }
    return "";
  }

  std::filesystem::path path;
};
using ParameterFiles = Folder;
} // namespace

TEST(ParameterSyntax, SyntaxErrorsAreToldWithTheirLine)
{
  EXPECT_EQ(complaint("sett A = 1\n"),
            "input:1: 'sett A = 1' is not understood; did you mean 'set'?\n"
            "  remedy: lines are 'set KEY = VALUE', 'subsection NAME', 'end' or 'include FILE'");
  EXPECT_EQ(complaint("\nset A 1\n"), "input:2: 'set A 1' has no '='\n"
                                      "  remedy: write 'set KEY = VALUE'");
  EXPECT_EQ(complaint("set = 1\n"), "input:1: the key before '=' is missing\n"
                                    "  remedy: write 'set KEY = VALUE'");
  EXPECT_EQ(complaint("subsection A\nset b = 1\n"),
            "input:1: 'subsection A' has no 'end' in this file\n"
            "  remedy: add a line 'end' behind the last entry of the section");
  EXPECT_EQ(complaint("subsection A\nend\nend\n"),
            "input:3: 'end' without 'subsection'\n"
            "  remedy: remove it, or add the missing 'subsection' line");
  EXPECT_EQ(complaint("subsection A/B\nend\n"),
            "input:1: 'A/B' cannot be the name of a section\n"
            "  remedy: write 'subsection NAME' with a name without '/' and '='");
  EXPECT_EQ(complaint("set A = 1 \\\n"),
            "input:1: the file ends in a line that is to be continued\n"
            "  remedy: remove the '\\' at its end");
  EXPECT_EQ(complaint("subsection A\nset b = 1\nend\nsubsection A\nset b = 2\nend\n"),
            "input:5: A: 'b' is set a second time; the first is in line 2\n"
            "  remedy: keep one of the two lines");
}

TEST(ParameterSyntax, ContinuedLinesCountInPositions)
{
  ParameterFile file = ParameterFile::from_string("set a = 1\\\n  # of three\n  2\nset b = x\n");
  double        a = 0., b = 0.;
  file.root().entry("a", a, "");
  file.root().entry("b", b, "");
  EXPECT_EQ(a, 12.);
  try
    {
      file.check();
      FAIL();
    }
  catch (const UserError &error)
    {
      EXPECT_STREQ(error.what(), "input:4: \"b\" = x is not allowed: a number");
    }
}

TEST_F(ParameterFiles, IncludesAreRelativeAndOverridden)
{
  write_file("common/base.prm", "set Steps = 5\nset Offset = 4\ninclude times.prm\n");
  write_file("common/times.prm", "subsection Times\nset End time = 9\nend\n");
  write_file("common/steel.prm", "set Young's modulus = 3\n");
  const std::string main = write_file(
    "main.prm", "include common/base.prm\nset Steps = 6\nsubsection Materials\n"
                "set Names = steel\nsubsection steel\ninclude common/steel.prm\nend\nend\n");
  ParameterFile file   = ParameterFile::read(main);
  unsigned int  steps  = 0;
  int           offset = 0;
  double        time = 0., young = 0.;
  file.root().entry("Steps", steps, "");
  file.root().entry("Offset", offset, "");
  file.root().subsection("Times", "").entry("End time", time, "");
  for (const auto &[name, section] : file.root().subsection("Materials", "").named("Names", ""))
    section.entry("Young's modulus", young, "");
  file.check();
  EXPECT_EQ(steps, 6u);
  EXPECT_EQ(offset, 4);
  EXPECT_EQ(time, 9.);
  EXPECT_EQ(young, 3.);
}

TEST_F(ParameterFiles, ProblemsNameTheIncludedFile)
{
  write_file("common/base.prm", "\nset Stepz = 5\n");
  ParameterFile parameters
    = ParameterFile::read(write_file("main.prm", "include common/base.prm\nset Flag = false\n"));
  unsigned int steps = 0;
  bool         flag  = true;
  parameters.root().entry("Steps", steps, "");
  parameters.root().entry("Flag", flag, "");
  try
    {
      parameters.check();
      FAIL();
    }
  catch (const UserError &error)
    {
      EXPECT_EQ(std::string(error.what()), (path / "common/base.prm").string()
                                             + ":2: unknown entry 'Stepz'; did you mean 'Steps'?");
    }
}

TEST_F(ParameterFiles, MissingFilesAndCyclesAreErrors)
{
  EXPECT_EQ(reading_error((path / "none.prm").string()),
            "none.prm: cannot open the file 'none.prm'\n  remedy: check the path");
  EXPECT_EQ(reading_error((path / "common").string()),
            "common: 'common' is a directory\n  remedy: name a file");
  EXPECT_EQ(reading_error(write_file("a.prm", "\ninclude common/none.prm\n")),
            "a.prm:2: cannot open the file 'common/none.prm'\n"
            "  remedy: the path of an included file is relative to the file that includes it");
  write_file("common/c.prm", "include ../b.prm\n");
  EXPECT_EQ(reading_error(write_file("b.prm", "include common/c.prm\n")),
            "common/c.prm:1: the file 'b.prm' includes itself, directly or through other files\n"
            "  remedy: remove one of the 'include' lines");
  write_file("common/open.prm", "subsection A\n");
  EXPECT_EQ(reading_error(write_file("d.prm", "include common/open.prm\nend\n")),
            "common/open.prm:1: 'subsection A' has no 'end' in this file\n"
            "  remedy: add a line 'end' behind the last entry of the section");
}
TEST(ReadParameters, CommasInFunctionsDoNotSplitLists)
{
  ParameterFile       file = ParameterFile::from_string("set Centre = max(0, 1), min(1, 2)\n"
                                                              "set Sizes = 1, max(2, min(3, 4))\n"
                                                              "set Corners = 0, max(1,2); 3, 4\n"
                                                              "set Wrong = max(0, 1\n");
  dealii::Point<2>    centre, wrong;
  std::vector<double> sizes;
  std::vector<dealii::Point<2>> corners;
  file.root().entry("Centre", centre, "");
  file.root().entry("Sizes", sizes, dealii::Patterns::Double(0.), "");
  file.root().entry("Corners", corners, "");
  EXPECT_EQ(centre, (dealii::Point<2>(1., 1.)));
  EXPECT_EQ(sizes, (std::vector<double>{1., 3.}));
  EXPECT_EQ(corners, (std::vector<dealii::Point<2>>{{0., 2.}, {3., 4.}}));
  EXPECT_EQ(file.values().at("Centre"), "1, 1");
  file.root().entry("Wrong", wrong, "");
  EXPECT_TRUE(file.root().is_wrong("Wrong"));
  EXPECT_FALSE(file.root().is_wrong("Centre"));
  file.root().error("Wrong", "follows from that"); // is not told
  try
    {
      file.check();
      FAIL();
    }
  catch (const UserError &error)
    {
      EXPECT_EQ(std::string(error.what()).find("follows"), std::string::npos) << error.what();
    }
}

TEST(ReadParameters, NumbersMayBeFormulasWithoutVariables)
{
  ParameterFile       file  = ParameterFile::from_string("set Angle = - pi/2\nset Steps = 2*16\n"
                                                                "set Sizes = 1/4, 2, sqrt(4)\n"
                                                                "set Corners = 0, 1 + 1; 2^3, 1\n"
                                                                "set Half = 3/2\nset Share = 3/2\n");
  double              angle = 0., share = 0.5;
  unsigned int        steps = 1, half = 7;
  std::vector<double> sizes;
  std::vector<dealii::Point<2>> corners;
  file.root().entry("Angle", angle, "");
  file.root().entry("Steps", steps, dealii::Patterns::Integer(1, 100), "");
  file.root().entry("Sizes", sizes, dealii::Patterns::Double(0.), "");
  file.root().entry("Corners", corners, "");
  EXPECT_EQ(angle, -M_PI / 2.);
  EXPECT_EQ(steps, 32u);
  EXPECT_EQ(sizes, (std::vector<double>{0.25, 2., 2.}));
  EXPECT_EQ(corners, (std::vector<dealii::Point<2>>{{0., 2.}, {8., 1.}}));
  EXPECT_EQ(file.values().at("Sizes"), "0.25, 2, 2");
  // What they give must be allowed.
  file.root().entry("Half", half, "");
  file.root().entry("Share", share, dealii::Patterns::Double(0., 1.), "");
  EXPECT_EQ(half, 7u);
  EXPECT_EQ(share, 0.5);
  try
    {
      file.check();
      FAIL();
    }
  catch (const UserError &error)
    {
      const std::string told = error.what();
      EXPECT_NE(told.find("\"Half\" = 3/2 is not allowed: an integer >= 0"), std::string::npos);
      EXPECT_NE(told.find("\"Share\" = 3/2 is not allowed: a number in [0, 1]"), std::string::npos);
    }
}
