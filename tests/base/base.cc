// Formulas, names of enums, error messages, numbers in logs.
#include <gtest/gtest.h>

#include <scree/base/enum_names.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>
#include <scree/base/log.h>
#include <scree/base/text_file.h>
#include <scree/base/time_table.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sys/stat.h>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

TEST(Expression, ComponentsOfPositionAndTime)
{
  const Expression<2> f("x + 2*y; t*x^2; pi", 3, "here");
  const Point<2>      point(3., 4.);
  EXPECT_EQ(f.value(point, 0., 0), 11.);
  EXPECT_EQ(f.value(point, 2., 1), 18.);
  EXPECT_EQ(f.value(point, 2., 2), M_PI);
  const Tensor<1, 2> vector = f.vector(point, 1.);
  EXPECT_EQ(vector[0], 11.);
  EXPECT_EQ(vector[1], 9.);
  EXPECT_EQ(Expression<3>("z", 1, "here").value(Point<3>(1., 2., 7.)), 7.);
}

TEST(Expression, EmptyComponentsAreTold)
{
  for (const std::string text : {"0;", "; 0", " ;0", "0; "})
    expect_contains(complaint([&]() { Expression<2>(text, 2, "here"); }),
                    "a component of '" + text + "' is empty");
}

TEST(TimeTable, IsLinearBetweenItsRows)
{
  const TimeTable table("t, f\n0, 1 # start\n\n 0.5,\t2\n2,-1\n", "load.csv");
  EXPECT_EQ(table.value(0.), 1.);
  EXPECT_EQ(table.value(0.25), 1.5);
  EXPECT_EQ(table.value(0.5), 2.);
  EXPECT_EQ(table.value(1.), 1.);
  EXPECT_EQ(table.value(2.), -1.);
  EXPECT_EQ(table.value(2. + 1e-12), -1.); // rounding of times
  EXPECT_THROW(table.value(2.001), UserError);
  EXPECT_THROW(table.value(-0.001), UserError);
  for (const char *text :
       {"", "0, 1", "0, 1\n0, 2", "0, 1\n1", "0, 1\n1, 2, 3", "0, 1\n1, inf",
        "t, f\nt, f\n0, 1\n1, 1", "0; 1\n1; 2", "0, 1\n1, 2x", "0, 1\n1, 0x10", "0, 1\n1, +-1"})
    EXPECT_THROW(TimeTable(text, "load.csv"), UserError) << text;
}

TEST(TimeTable, InFormulas)
{
  const std::string file = testing::TempDir() + "scree_load.csv";
  std::ofstream(file) << "0, 0\n2, 4\n";
  const std::string   call = "table(" + file + ", 00000000)";
  const Expression<2> f("x + " + call + "; 2*" + call + " - " + call + "*t", 2, "here");
  for (const double time : {0., 1., 2., 0.5, 0.25, 0.75, 1.25, 1.5, 1.})
    {
      EXPECT_EQ(f.value(Point<2>(3., 0.), time, 0), 3. + 2. * time);
      EXPECT_EQ(f.value(Point<2>(3., 0.), time, 1), 4. * time - 2. * time * time);
    }
  EXPECT_THROW(f.value(Point<2>(), 2.1), UserError);
  EXPECT_THROW(Expression<2>("table(" + file + ")", 1, "here"), UserError); // no place for tables
  EXPECT_THROW(Expression<2>("table(/none.csv, 00000000)", 1, "here"), UserError);
  std::remove(file.c_str());
}

TEST(TimeTable, TellsWhatIsWrongWithACall)
{
  const auto told
    = [](const std::string &call) { return complaint([&] { table_calls("2*" + call, "here"); }); };
  EXPECT_EQ(told("table( load.csv , 0123abcd )"), "");
  expect_contains(told("table (load.csv)"), "a blank between table and the parenthesis");
  expect_contains(told("table(\"load.csv\")"), "in quotes: \"load.csv\"");
  expect_contains(told("table(load.csv, 2)"), "'2' behind the name of a table is no checksum");
  expect_contains(told("table(load.csv"), "a table without an end");
}

TEST(ConstantValue, OfFormulasWithoutVariables)
{
  EXPECT_EQ(constant_value("0.5 + 0.866"), 0.5 + 0.866);
  EXPECT_EQ(constant_value("max(1, 2)*pi"), 2. * M_PI);
  for (const char *text :
       {"", "x", "t", "1,2", "1;2", "2 mm", "a = 1", "rand()", "1 +", "(1", "0x10"})
    EXPECT_FALSE(constant_value(text)) << text;
}

TEST(Expression, Selects)
{
  const Expression<2> right("x > 1 && y < 2", 1, "Where");
  EXPECT_TRUE(right.selects(Point<2>(1.5, 1.)));
  EXPECT_FALSE(right.selects(Point<2>(0.5, 1.)));
  // Copies evaluate alike.
  const Expression<2> copy(right);
  EXPECT_TRUE(copy.selects(Point<2>(1.5, 1.)));
}

template <int dim>
std::string
message(const std::string &formula, const unsigned int n_components)
{
  try
    {
      Expression<dim>(formula, n_components, "Bodies/disc/Value");
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

TEST(Expression, WrongFormulasAreExplained)
{
  for (const std::string formula : {"x +", "z", "sin(x", "f(x)", ""})
    {
      const std::string told = message<2>(formula, 1);
      EXPECT_NE(told.find("Bodies/disc/Value"), std::string::npos) << formula << ": " << told;
      EXPECT_NE(told.find("'" + formula + "'"), std::string::npos) << formula << ": " << told;
      EXPECT_NE(told.find("remedy"), std::string::npos) << formula << ": " << told;
    }
  EXPECT_NE(message<2>("x; y", 1).find("has 2 component(s)"), std::string::npos);
  EXPECT_NE(message<3>("x; y", 3).find("give 3 expression(s)"), std::string::npos);
  EXPECT_EQ(message<3>("z", 1), "");
}

TEST(Expression, WrongFormulasAreToldOnceAndInFull)
{
  testing::internal::CaptureStderr();
  const std::string told = message<2>("x + sin(", 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(told.find("Unexpected end of expression at position"), std::string::npos) << told;
}

TEST(Expression, VariablesAreCompared_NotSet)
{
  EXPECT_NE(message<2>("x = 3", 1).find("compare with '=='"), std::string::npos);
  for (const std::string formula : {"x == 3", "x <= 3", "x >= 3", "x != 3"})
    EXPECT_EQ(message<2>(formula, 1), "") << formula;
}

enum class Colour
{
  red,
  green
};

TEST(EnumNames, BothWays)
{
  const EnumNames<Colour> names = {{Colour::red, "red"}, {Colour::green, "green"}};
  EXPECT_EQ(name_of(names, Colour::green), "green");
  EXPECT_EQ(value_of(names, "red"), Colour::red);
  EXPECT_THROW(value_of(names, "blue"), std::logic_error);
  EXPECT_EQ(joined_names(names), "red|green");
}

TEST(Exceptions, OneMessage)
{
  EXPECT_STREQ(UserError("Grid", "is wrong", "mend it").what(),
               "Grid: is wrong\n  remedy: mend it");
  EXPECT_STREQ(UserError("Grid", "is wrong").what(), "Grid: is wrong");
  EXPECT_NO_THROW(require(true, "Grid", "is wrong"));
  EXPECT_THROW(require(false, "Grid", "is wrong"), UserError);
}

TEST(TextFile, APipeIsRefusedWithARemedyForWhateverItIs)
{
  const std::string pipe = testing::TempDir() + "scree_pipe";
  std::remove(pipe.c_str());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string what : {"parameters", "a table"})
    expect_contains(complaint([&]() { read_bytes(pipe, 100, "here", "check it", what); }),
                    "remedy: write what it gives to a file, and name that");
  expect_contains(complaint([&]() { require_regular_if_there(pipe); }), "no regular file");
  std::remove(pipe.c_str());
  EXPECT_NO_THROW(require_regular_if_there(pipe));
}

TEST(Log, ListsOfNames)
{
  std::vector<std::string> names(most_told, "a");
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  EXPECT_EQ(listed(names).size(), 3 * most_told - 2);
  names.emplace_back("b");
  EXPECT_EQ(listed(names), "a, a, a, a, a, a, a, a and " + std::to_string(most_told - 7) + " more");
}

TEST(Log, NumbersAndDurations)
{
  EXPECT_EQ(short_number(0.0312512345), "0.03125");
  EXPECT_EQ(short_number(123456.), "1.235e+05");
  EXPECT_EQ(short_duration(1.234), "1.23 s");
  EXPECT_EQ(short_duration(59.4), "59 s");
  EXPECT_EQ(short_duration(200.), "3 min 20 s");
  EXPECT_EQ(short_duration(7500.), "2 h 5 min");
}
} // namespace
} // namespace scree
