#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>

#include <deal.II/base/point.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
// Visiting, overriding, checking and writing back parameter files.

using namespace scree;

namespace
{
const double NaN = std::numeric_limits<double>::quiet_NaN();

enum class Law
{
  elastic,
  plastic
};
const EnumNames<Law> law_names = {{Law::elastic, "linear elastic"}, {Law::plastic, "plastic"}};

struct Material
{
  Law    law     = Law::elastic;
  double young   = NaN;
  double poisson = 0.3;
};

/** One entry of every type, a plain section and a named one. */
struct Everything
{
  bool                            flag   = true;
  int                             offset = -1;
  unsigned int                    steps  = 10;
  double                          time   = 0.1;
  double                          unset  = NaN;
  std::string                     title  = "a run";
  std::vector<std::string>        words  = {"x", "y"};
  std::vector<double>             numbers;
  dealii::Point<2>                centre{1., 2.};
  dealii::Tensor<1, 3>            axis;
  std::vector<dealii::Point<2>>   vertices = {{0., 0.}, {1., 0.}};
  dealii::Point<3>                origin{NaN, NaN, NaN};
  std::vector<std::string>        names;
  std::map<std::string, Material> materials;

  void visit(const ParameterSection &root)
  {
    root.entry("Flag", flag, "A switch.");
    root.entry("Offset", offset, "A shift.");
    root.entry("Steps", steps, dealii::Patterns::Integer(1, 1000), "How many. Not too many.");
    const ParameterSection times = root.subsection("Times", "All in seconds.");
    times.entry("End time", time, positive_number(), "The last time.");
    times.entry("Unset", unset, "Not given by default.");
    const ParameterSection shape = root.subsection("Shape", "The shape.");
    shape.entry("Title", title, "A text.");
    shape.entry("Words", words, "Some words.");
    shape.entry("Numbers", numbers, dealii::Patterns::Double(0.), "Lengths.");
    shape.entry("Centre", centre, "A point.");
    shape.entry("Axis", axis, "A vector.");
    shape.entry("Vertices", vertices, "Of a polygon.");
    shape.entry("Origin", origin, "A point that may be missing.");
    const ParameterSection all = root.subsection("Materials", "What bodies consist of.");
    for (const auto &[name, section] : all.named("Names", "The materials."))
      {
        Material &material = materials[name];
        names.push_back(name);
        section.entry("Law", material.law, law_names, "The constitutive law.");
        section.entry("Young's modulus", material.young, positive_number(), "E | stiffness.");
        section.entry("Poisson's ratio", material.poisson, dealii::Patterns::Double(-1., 0.5),
                      "nu.");
      }
  }
};

/** What check() says about `text` after the visit, or "" if nothing. */
std::string
complaint(const std::string &text, const std::vector<std::string> &overrides = {})
{
  try
    {
      ParameterFile file = ParameterFile::from_string(text);
      for (const auto &override : overrides)
        file.override_value(override);
      Everything everything;
      everything.visit(file.root());
      file.check();
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

std::string
written(const ParameterFile &file)
{
  std::ostringstream out;
  file.write(out);
  return out.str();
}
} // namespace

TEST(Parameters, NothingWrittenLeavesTheDefaults)
{
  ParameterFile file = ParameterFile::from_string("");
  Everything    everything;
  everything.visit(file.root());
  file.check();
  EXPECT_EQ(everything.steps, 10u);
  EXPECT_TRUE(std::isnan(everything.unset));
  EXPECT_TRUE(everything.names.empty());
  EXPECT_EQ(everything.centre, (dealii::Point<2>(1., 2.)));
}

TEST(Parameters, EveryTypeIsReadAndWrittenBackIdentically)
{
  const std::string text = "set Flag = false # comments may follow\n"
                           "set Offset = -7\n"
                           "SET Steps = 20\n"
                           "subsection Times\n"
                           "  set End time = 0.30000000000000004\n"
                           "end\n"
                           "subsection Shape\n"
                           "  set Title = if(x > 1, y = 2, 3)\n"
                           "  set Words = one word, two\n"
                           "  set Numbers = 1e-300, \\\n"
                           "    # a comment between continued lines\n"
                           "    +2.5,\\\n"
                           "    3.1415926535897931\n"
                           "  set Centre = -1e22, 0.1\n"
                           "  set Axis = 0, 0, 1\n"
                           "  set Vertices = 0,0; 1,0; 1,1\n"
                           "end\n"
                           "subsection Materials\n"
                           "  set Names = steel, soft rubber\n"
                           "  subsection soft rubber\n"
                           "    set Law = plastic\n"
                           "    set Young's modulus = 2.1e5\n"
                           "  end\n"
                           "end\n";
  ParameterFile     file = ParameterFile::from_string(text);
  Everything        first;
  first.visit(file.root());
  file.check();
  EXPECT_FALSE(first.flag);
  EXPECT_EQ(first.offset, -7);
  EXPECT_EQ(first.steps, 20u);
  EXPECT_EQ(first.time, 0.1 + 0.2);
  EXPECT_EQ(first.title, "if(x > 1, y = 2, 3)");
  EXPECT_EQ(first.words, (std::vector<std::string>{"one word", "two"}));
  EXPECT_EQ(first.numbers, (std::vector<double>{1e-300, 2.5, 3.1415926535897931}));
  EXPECT_EQ(first.centre, (dealii::Point<2>(-1e22, 0.1)));
  EXPECT_EQ(first.axis[2], 1.);
  ASSERT_EQ(first.vertices.size(), 3u);
  EXPECT_EQ(first.vertices[2], (dealii::Point<2>(1., 1.)));
  EXPECT_EQ(first.names, (std::vector<std::string>{"steel", "soft rubber"}));
  EXPECT_EQ(first.materials["soft rubber"].law, Law::plastic);
  EXPECT_EQ(first.materials["soft rubber"].young, 210000.);
  EXPECT_TRUE(std::isnan(first.materials["steel"].young));

  const std::string resolved = written(file);
  ParameterFile     again    = ParameterFile::from_string(resolved);
  Everything        second;
  second.visit(again.root());
  again.check();
  EXPECT_EQ(written(again), resolved);
  EXPECT_EQ(second.time, first.time);
  EXPECT_EQ(second.numbers, first.numbers);
  EXPECT_EQ(second.centre, first.centre);
  EXPECT_EQ(second.title, first.title);
  EXPECT_EQ(second.names, first.names);
  EXPECT_TRUE(std::isnan(second.unset));
  EXPECT_TRUE(std::isnan(second.origin[0]));
}

TEST(Parameters, DoublesSurviveWritingToTheLastBit)
{
  for (const double x : {1. / 3., 4.9406564584124654e-324, 1.7976931348623157e308, 5e-7, 123456789.,
                         -0.1, std::nextafter(1., 2.)})
    {
      ParameterFile file  = ParameterFile::from_string("");
      double        value = x;
      file.root().entry("x", value, "");
      ParameterFile again = ParameterFile::from_string(written(file));
      double        read  = 0.;
      again.root().entry("x", read, "");
      again.check();
      EXPECT_EQ(read, x);
    }
}

TEST(Parameters, ResolvedFileIsInOrderOfDeclarationWithDocumentation)
{
  ParameterFile file = ParameterFile::from_string("subsection B\nset b = 2\nend\nset z = 5\n");
  double        z = 1., a = 2.5, b = NaN;
  file.root().entry("z", z, "The last letter. And more about it.");
  const auto section = file.root().subsection("B", "A section.");
  section.entry("b", b, "The second.");
  file.root().entry("a", a, "");
  EXPECT_EQ(written(file), "# The last letter.\n"
                           "set z = 5\n"
                           "set a = 2.5\n"
                           "\n"
                           "# A section.\n"
                           "subsection B\n"
                           "  # The second.\n"
                           "  set b = 2\n"
                           "end\n");
}

TEST(Parameters, SetMeansDifferentFromTheDefault)
{
  ParameterFile file  = ParameterFile::from_string("set a = 1.0\nset b = 2\nset c = \n");
  double        value = 1., b = 1., c = NaN, d = 0.;
  file.root().entry("a", value, "");
  file.root().entry("b", b, "");
  file.root().entry("c", c, "");
  file.root().entry("d", d, "");
  EXPECT_FALSE(file.root().is_set("a"));
  EXPECT_TRUE(file.root().is_set("b"));
  EXPECT_FALSE(file.root().is_set("c"));
  EXPECT_FALSE(file.root().is_set("d"));
  EXPECT_FALSE(file.root().is_set("e"));
}

TEST(Parameters, OverridesReplaceAndCreate)
{
  ParameterFile file = ParameterFile::from_string("set Steps = 20\n");
  file.override_value("Steps=30");
  file.override_value(" Materials/Names = steel");
  file.override_value("Materials/steel/Young's modulus=7");
  Everything everything;
  everything.visit(file.root());
  file.check();
  EXPECT_EQ(everything.steps, 30u);
  EXPECT_EQ(everything.materials["steel"].young, 7.);

  for (const std::string wrong : {"Steps", "=3", "A//B=3", "A/=3", "", "Steps=3 # three"})
    EXPECT_THROW(file.override_value(wrong), UserError) << wrong;
}

TEST(Parameters, WrongOverridesAreToldAsSuch)
{
  EXPECT_EQ(complaint("", {"Stebs=3"}), "--set: unknown entry 'Stebs'; did you mean 'Steps'?");
  EXPECT_EQ(complaint("subsection Times\nend\n", {"Times/End time=0"}),
            "--set: Times: \"End time\" = 0 is not allowed: a number > 0");
  EXPECT_EQ(complaint("", {"Tmes/End time=1"}),
            "--set: unknown section 'Tmes'; did you mean 'Times'?");
}

TEST(Parameters, UnknownNamesAreToldWithTheNearest)
{
  EXPECT_EQ(complaint("\nset steps = 3\n"),
            "input:2: unknown entry 'steps'; did you mean 'Steps'?");
  EXPECT_EQ(complaint("set Gravity = 3\n"), "input:1: unknown entry 'Gravity'\n"
                                            "  remedy: entries here: Flag, Offset, Steps");
  EXPECT_EQ(complaint("set Times = 3\n"),
            "input:1: unknown entry 'Times'\n"
            "  remedy: 'Times' is a section: write 'subsection Times' ... 'end'");
  EXPECT_EQ(complaint("subsection Solver\nset a = 1\nend\n"),
            "input:1: unknown section 'Solver'\n"
            "  remedy: sections here: Times, Shape, Materials");
  EXPECT_EQ(complaint("subsection Times\nsubsection a\nend\nend\n"),
            "input:2: Times: unknown section 'a'\n  remedy: there are no sections here");
}

TEST(Parameters, WrongValuesAreToldWithWhatIsAllowed)
{
  const auto in = [](const std::string &section, const std::string &line) {
    return complaint("subsection " + section + "\n  set " + line + "\nend\n");
  };
  const std::string units = "\n  remedy: write the number alone, without 'mm': units are not "
                            "converted, use one consistent system";
  EXPECT_EQ(in("Times", "End time = 3 mm"),
            "input:2: Times: \"End time\" = 3 mm is not allowed: a number > 0" + units);
  EXPECT_EQ(in("Times", "End time = 1,5"),
            "input:2: Times: \"End time\" = 1,5 is not allowed: a number > 0\n"
            "  remedy: write one number; a decimal fraction has a point, not a comma");
  for (const std::string value : {"nan", "inf", "-infinity", "1e999", "0x10", "+-3", "--3"})
    EXPECT_NE(in("Times", "Unset = " + value)
                .find("input:2: Times: \"Unset\" = " + value + " is not allowed: a number"),
              std::string::npos)
      << value << in("Times", "Unset = " + value);
  EXPECT_EQ(in("Times", "End time ="),
            "input:2: Times: \"End time\" = (nothing) is not allowed: a number > 0\n"
            "  remedy: write a value behind '='");
  EXPECT_EQ(complaint("set Flag = yes\n"), "input:1: \"Flag\" = yes is not allowed: true or false");
  EXPECT_EQ(complaint("set Offset = 1.5\n"),
            "input:1: \"Offset\" = 1.5 is not allowed: an integer");
  EXPECT_EQ(complaint("set Steps = -1\n"),
            "input:1: \"Steps\" = -1 is not allowed: an integer in [1, 1000]");
  EXPECT_EQ(complaint("set Steps = 0\n"),
            "input:1: \"Steps\" = 0 is not allowed: an integer in [1, 1000]");
  EXPECT_EQ(in("Shape", "Centre = 1, 2, 3"),
            "input:2: Shape: \"Centre\" = 1, 2, 3 is not allowed: 2 numbers separated by commas\n"
            "  remedy: there are 3 instead of 2 numbers");
  EXPECT_EQ(in("Shape", "Axis = 1, a, 3"),
            "input:2: Shape: \"Axis\" = 1, a, 3 is not allowed: 3 numbers separated by commas");
  EXPECT_EQ(in("Shape", "Vertices = 0,0; 1; 2,2"),
            "input:2: Shape: \"Vertices\" = 0,0; 1; 2,2 is not allowed: a list of points as in "
            "'0, 0; 1, 0'\n  remedy: '1' is not an element of such a list: there are 1 instead of "
            "2 numbers");
  EXPECT_EQ(in("Shape", "Numbers = 1, -2"),
            "input:2: Shape: \"Numbers\" = 1, -2 is not allowed: a list of numbers separated by "
            "commas, each >= 0");
  EXPECT_EQ(in("Shape", "Words = a,, b"),
            "input:2: Shape: \"Words\" = a,, b is not allowed: a list of texts separated by "
            "commas\n  remedy: an element between two separators is missing");
}

TEST(Parameters, PatternsAreToldInWords)
{
  const auto told = [](const dealii::Patterns::PatternBase &pattern) {
    ParameterFile file = ParameterFile::from_string("set k = ?\n");
    std::string   text;
    file.root().entry("k", text, pattern, "");
    try
      {
        file.check();
      }
    catch (const UserError &error)
      {
        const std::string message = error.what();
        return message.substr(message.find("allowed: ") + 9);
      }
    return std::string();
  };
  using namespace dealii::Patterns;
  EXPECT_EQ(told(Selection("a|b c|d")), "a, b c, d");
  EXPECT_EQ(told(Double()), "a number");
  EXPECT_EQ(told(Double(std::numeric_limits<double>::lowest(), 3.)), "a number <= 3");
  EXPECT_EQ(told(Integer(2)), "an integer >= 2");
  EXPECT_EQ(told(Bool()), "true or false");
  EXPECT_EQ(told(Anything()), "");
}

TEST(Parameters, WrongChoicesAreToldWithTheNearest)
{
  const auto law = [](const std::string &name) {
    return complaint("subsection Materials\nset Names = steel\nsubsection steel\nset Law = " + name
                     + "\nset Poisson's ratio = 0.25\nend\nend\n");
  };
  EXPECT_EQ(law("plastic"), "");
  EXPECT_EQ(law("Linear Elastic"),
            "input:4: Materials/steel: \"Law\" = Linear Elastic is not allowed: linear elastic, "
            "plastic\n  remedy: did you mean 'linear elastic'?");
  EXPECT_EQ(law("viscous"),
            "input:4: Materials/steel: \"Law\" = viscous is not allowed: linear elastic, "
            "plastic\n  remedy: write one of these names");
}

TEST(Parameters, NamedSectionsAreCheckedAgainstTheirList)
{
  const auto names = [](const std::string &list, const std::string &sections = "") {
    return complaint("subsection Materials\nset Names = " + list + "\n" + sections + "end\n");
  };
  EXPECT_EQ(names("steel, rubber"), "");
  EXPECT_EQ(names(""), "");
  EXPECT_EQ(names("steel", "subsection Steal\nend\n"),
            "input:3: Materials: subsection 'Steal' is not listed in 'Names'; did you mean "
            "'steel'?");
  EXPECT_EQ(names("steel", "subsection granite\nend\n"),
            "input:3: Materials: subsection 'granite' is not listed in 'Names'\n"
            "  remedy: add the name to the list or remove the subsection");
  EXPECT_EQ(names("a, b, a"), "input:2: Materials: \"Names\" = a, b, a lists 'a' more than once\n"
                              "  remedy: give each its own name");
  EXPECT_EQ(names("a,, b"), "input:2: Materials: \"Names\" = a,, b has an empty name\n"
                            "  remedy: remove the surplus comma or write the missing name");
  EXPECT_EQ(names("a/b"), "input:2: Materials: \"Names\" = a/b: 'a/b' cannot be a name\n"
                          "  remedy: use names without '/' and '='");
}

TEST(Parameters, AllProblemsAreToldAtOnceInTheOrderOfTheFile)
{
  EXPECT_EQ(complaint("set Flag = 2\nsubsection Times\nset Ende time = 1\nend\nset Offset = x\n"),
            "input: 3 problems\n"
            "input:1: \"Flag\" = 2 is not allowed: true or false\n"
            "input:3: Times: unknown entry 'Ende time'; did you mean 'End time'?\n"
            "input:5: \"Offset\" = x is not allowed: an integer");
}

TEST(Parameters, ModulesRecordErrorsAtTheirKeyOrSection)
{
  const auto told = [](const std::function<void(const ParameterSection &)> &record) {
    ParameterFile file = ParameterFile::from_string("\nsubsection A\n  set x = 1\nend\n", "f.prm");
    const ParameterSection a = file.root().subsection("A", "");
    double                 x = 0., y = NaN;
    a.entry("x", x, "");
    a.entry("y", y, "");
    record(a.subsection("inner", ""));
    record(a);
    record(a);
    try
      {
        file.check();
      }
    catch (const UserError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  const auto only_a
    = [&](const std::string &key, const std::string &what, const std::string &remedy) {
        return told([&](const ParameterSection &s) {
          if (s.path() == "A")
            s.error(key, what, remedy);
        });
      };
  EXPECT_EQ(only_a("x", "is less than y", "make it larger"),
            "f.prm:3: A: \"x\" = 1: is less than y\n  remedy: make it larger");
  EXPECT_EQ(only_a("y", "is needed here", ""), "f.prm:2: A: \"y\": is needed here");
  EXPECT_EQ(only_a("", "is too big", ""), "f.prm:2: A: is too big");
  EXPECT_EQ(told([](const ParameterSection &s) {
              if (s.path() == "A/inner")
                s.error("k", "is missing");
            }),
            "f.prm:2: A/inner: \"k\": is missing");
}

TEST(Parameters, DocumentationVisitsOneNameAndComplainsOfNothing)
{
  ParameterFile file = ParameterFile::documentation();
  Everything    everything;
  EXPECT_TRUE(file.root().is_documentation());
  everything.visit(file.root());
  file.root().error("Steps", "are wrong");
  file.check();
  EXPECT_EQ(everything.names, std::vector<std::string>{"<name>"});

  std::ostringstream out;
  file.write_markdown(out);
  const std::string text = out.str();
  for (
    const std::string line :
    {"| Steps | 10 | an integer in [1, 1000] | How many. Not too many. |\n",
     "## Times\n\nAll in seconds.\n\n| Entry | Default | Allowed | Meaning |\n|---|---|---|---|\n"
     "| End time | 0.1 | a number > 0 | The last time. |\n",
     "| Unset | (none) | a number | Not given by default. |\n",
     "## Materials\n\nWhat bodies consist of.\n\n",
     "| Names | (none) | names separated by commas, each of a subsection here | The materials. |",
     "## Materials/\\<name>\n\n",
     "| Law | linear elastic | linear elastic, plastic | The constitutive law. |\n",
     "| Young's modulus | (none) | a number > 0 | E \\| stiffness. |\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nin\n" << text;
}

TEST(Parameters, DocumentationOfSectionsInSectionsOfTheirKindEnds)
{
  ParameterFile                                       file  = ParameterFile::documentation();
  unsigned int                                        n     = 0;
  const std::function<void(const ParameterSection &)> visit = [&](const ParameterSection &shape) {
    ++n;
    double radius = 1.;
    shape.entry("Radius", radius, "");
    for (const auto &part : shape.named("Parts", ""))
      visit(part.second);
  };
  visit(file.root().subsection("Shape", ""));
  EXPECT_EQ(n, 2u);
}

TEST(Parameters, ValuesByPathAreTheResolvedOnes)
{
  ParameterFile file
    = ParameterFile::from_string("set Size = 2\nsubsection Inner\n  set Name = a\nend");
  file.override_value("Inner/Name=b");
  double           size = 1., other = 3.;
  std::string      name;
  ParameterSection root = file.root();
  root.entry("Size", size, "");
  root.entry("Other", other, "");
  root.subsection("Inner", "").entry("Name", name, "");
  const auto values = file.values();
  EXPECT_EQ(values.size(), 3u);
  EXPECT_EQ(values.at("Size"), "2");
  EXPECT_EQ(values.at("Other"), "3");
  EXPECT_EQ(values.at("Inner/Name"), "b");
}
