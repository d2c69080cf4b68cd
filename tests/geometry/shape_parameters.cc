#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/shape_family.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

// Reads the lines of a section Shape and makes the shape.
template <int dim>
ShapePointer<dim>
shape(const std::string &text)
{
  ParameterFile        file = ParameterFile::from_string("subsection Shape\n" + text + "\nend\n");
  ShapeParameters<dim> parameters;
  parameters.declare(file.root().subsection("Shape", "A shape."));
  file.check();
  return make_shape(parameters);
}

// The message that a section Shape is answered with.
template <int dim>
std::string
message(const std::string &text)
{
  return complaint([&]() { shape<dim>(text); });
}

TEST(ShapeParameters, MakeEachType)
{
  const Point<2> x(2, 0.5);
  EXPECT_NEAR(shape<2>("set Type = disc\nset Centre = 2, 1\nset Radius = 0.7")->signed_distance(x),
              -0.2, 1e-14);
  EXPECT_NEAR(shape<2>("set Type = box\nset Lower corner = 0, 0\nset Upper corner = 1, 1")
                ->signed_distance(x),
              1, 1e-14);
  EXPECT_NEAR(
    shape<2>("set Type = half space\nset Point = 0, 0\nset Normal = 0, 3")->signed_distance(x), 0.5,
    1e-14);
  EXPECT_NEAR(
    shape<2>("set Type = ellipse\nset Centre = 0, 0.5\nset Semi-axes = 1, 0.2")->signed_distance(x),
    1, 1e-14);
  EXPECT_NEAR(
    shape<2>("set Type = ring\nset Centre = 2, 0.5\nset Inner radius = 0.25\nset Radius = 1")
      ->signed_distance(x),
    0.25, 1e-14);
  EXPECT_NEAR(
    shape<2>(
      "set Type = capsule\nset First point = 0, 0\nset Second point = 4, 0\nset Radius = 0.6")
      ->signed_distance(x),
    -0.1, 1e-14);
  EXPECT_NEAR(shape<2>("set Type = polygon\nset Vertices = 0,0; 1,0; 1,1; 0,1")->signed_distance(x),
              1, 1e-14);
  EXPECT_NEAR(
    shape<2>("set Type = superellipse\nset Centre = 0, 0.5\nset Semi-axes = 1, 1\nset Exponent = 4")
      ->signed_distance(x),
    1, 1e-14);
  EXPECT_NEAR(shape<2>("set Type = expression\nset Expression = x - y")->signed_distance(x), 1.5,
              1e-14);
  EXPECT_TRUE(
    shape<2>("set Type = expression\nset Expression = x\nset Expression is distance = true")
      ->is_distance());
  EXPECT_NEAR(
    shape<3>("set Type = ball\nset Centre = 0, 0, 1\nset Radius = 1")->signed_distance({0, 0, 4}),
    2, 1e-14);
}

TEST(ShapeParameters, RotateAndTranslate)
{
  const std::string box    = "set Type = box\nset Lower corner = 0, 0\nset Upper corner = 2, 1\n";
  const auto        turned = shape<2>(box + "set Rotation angle = 30\nset Translation = 5, 0");
  // The corner (2, 1), turned by 30 degrees about the origin and moved.
  const double c = std::sqrt(3.) / 2, s = 0.5;
  EXPECT_NEAR(turned->signed_distance({5 + 2 * c - s, 2 * s + c}), 0, 1e-14);
  EXPECT_NEAR(turned->signed_distance({5 + c - 0.5 * s, s + 0.5 * c}), -0.5, 1e-14); // its centre
  const auto about = shape<2>(box + "set Rotation angle = 90\nset Rotation centre = 2, 0");
  EXPECT_NEAR(about->signed_distance({1.5, -1}), -0.5, 1e-14);

  const auto block = shape<3>("set Type = box\nset Lower corner = 0,0,0\nset Upper corner = 3,2,1\n"
                              "set Rotation angle = 120\nset Rotation axis = 2, 2, 2");
  // That turns x to y to z to x.
  EXPECT_NEAR(block->signed_distance({0.5, 1.5, 3}), 1, 1e-13);
  EXPECT_NEAR(block->signed_distance({0.5, 3.25, 1}), 0.25, 1e-13);
  EXPECT_NEAR(block->bounding_box().upper_bound(2), 2, 1e-13);
}

TEST(ShapeParameters, CombineNamedPartsRecursively)
{
  const std::string text  = "set Type = difference\nset Parts = plate, holes\n"
                            "subsection plate\n set Type = box\n set Lower corner = 0, 0\n"
                            " set Upper corner = 4, 2\nend\n"
                            "subsection holes\n set Type = union\n set Parts = left, right\n"
                            " subsection left\n  set Centre = 1, 1\n  set Radius = 0.5\n end\n"
                            " subsection right\n  set Centre = 3, 1\n  set Radius = 0.25\n end\nend";
  const auto        plate = shape<2>(text);
  EXPECT_NEAR(plate->signed_distance({1, 1}), 0.5, 1e-14);
  EXPECT_NEAR(plate->signed_distance({3, 1}), 0.25, 1e-14);
  EXPECT_NEAR(plate->signed_distance({2, 1}), -0.5, 1e-14);
  EXPECT_FALSE(plate->is_distance());
}

TEST(ShapeParameters, WrongInputIsTold)
{
  const std::string disc = "set Type = disc\nset Centre = 0, 0\n";
  expect_contains(message<2>(disc), "needs the entry 'Radius'");
  expect_contains(message<2>(disc), "Shape");
  expect_contains(message<2>(disc + "set Radius = 0"), "'Radius' must be greater than zero");
  expect_contains(message<2>(disc + "set Radius = 1\nset Normal = 0, 1"),
                  "'Normal' is not used by Type = disc");
  expect_contains(message<2>("set Type = disc\nset Centre = 0, 0, 0\nset Radius = 1"),
                  "'Centre' has 3 number(s)");
  expect_contains(message<2>("set Type = circle"), "circle");
  expect_contains(message<2>("set Type = box\nset Lower corner = 0, 1\nset Upper corner = 1, 1"),
                  "is not below 'Upper corner'");
  expect_contains(message<2>("set Type = half space\nset Point = 0, 1\nset Normal = 0, 0"),
                  "'Normal' is zero");
  expect_contains(message<2>("set Type = ellipse\nset Centre = 0, 1\nset Semi-axes = 1, -1"),
                  "'Semi-axes' must be greater than zero");
  expect_contains(
    message<2>("set Type = ring\nset Centre = 0, 1\nset Radius = 1\nset Inner radius = 1"),
    "'Inner radius' is not less");
  expect_contains(message<2>("set Type = polygon\nset Vertices = 0,0; 1,0"),
                  "the polygon has 2 vertices");
  expect_contains(message<2>("set Type = polygon\nset Vertices = 0,0; 1,1; 1,0; 0,1"),
                  "cross or touch");
  expect_contains(message<3>("set Type = polygon\nset Vertices = 0,0; 1,1; 1,0"), "2D only");
  expect_contains(
    message<2>(
      "set Type = superellipse\nset Centre = 0, 1\nset Semi-axes = 1, 1\nset Exponent = 0.5"),
    "at least 1");
  expect_contains(message<2>("set Type = expression\nset Expression = x +* y"), "not a formula");
  expect_contains(
    message<2>(
      "set Type = union\nset Parts = a\nsubsection a\nset Centre = 0, 0\nset Radius = 1\nend"),
    "at least 2 parts");
  expect_contains(
    message<2>(
      "set Type = union\nset Parts = a, b\nsubsection a\nset Centre = 0, 0\nset Radius = 1\nend"),
    "Shape/b");
  expect_contains(
    message<3>("set Type = ball\nset Centre = 0,0,0\nset Radius = 1\nset Rotation angle = 10"),
    "Rotation axis");
}

// Entries of other types are written back empty, which does not count as set.
TEST(ShapeParameters, WrittenBackTheyReadTheSame)
{
  ParameterFile file
    = ParameterFile::from_string("set Type = box\nset Lower corner = 0, 0\n"
                                 "set Upper corner = 2, 1\nset Rotation angle = 30");
  ShapeParameters<2> parameters;
  parameters.declare(file.root());
  file.check();
  std::ostringstream written;
  file.write(written);
  ParameterFile      again_file = ParameterFile::from_string(written.str());
  ShapeParameters<2> again;
  again.declare(again_file.root());
  EXPECT_NO_THROW(again_file.check());
  EXPECT_EQ(again.type, "box");
  EXPECT_EQ(again.coordinates("Upper corner"), parameters.coordinates("Upper corner"));
  EXPECT_EQ(again.rotation_angle, 30);
}

// Types are told apart, and a key holds the same kind of value and sign in all families.
TEST(ShapeFamilies, AgreeOnTypesAndSharedEntries)
{
  std::set<std::string>             types;
  std::map<std::string, ShapeEntry> entries;
  for (const auto &family : registered_shapes<2>())
    {
      for (const std::string &type : family.types)
        EXPECT_TRUE(types.insert(type).second) << type;
      for (const ShapeEntry &entry : family.entries)
        {
          const ShapeEntry &first = entries.emplace(entry.key, entry).first->second;
          EXPECT_EQ(first.unset.index(), entry.unset.index()) << entry.key;
          EXPECT_EQ(first.is_positive, entry.is_positive) << entry.key;
          EXPECT_EQ(first.unit, entry.unit) << entry.key;
        }
    }
}

// Families that share an entry are named together, in the order of the registry.
TEST(ShapeFamilies, DocumentSharedEntriesTogether)
{
  ParameterFile      file = ParameterFile::documentation();
  ShapeParameters<2> parameters;
  parameters.declare(file.root().subsection("Shape", "A shape."));
  std::ostringstream text;
  file.write_markdown(text);
  expect_contains(text.str(), "Centre of a disc, ellipse, ring or superellipse [L].");
  expect_contains(text.str(), "Radius of a disc or capsule, outer radius of a ring [L].");
}

TEST(ShapeParameters, DocumentationEnds)
{
  ParameterFile      file = ParameterFile::documentation();
  ShapeParameters<2> parameters;
  parameters.declare(file.root().subsection("Shape", "A shape."));
  std::ostringstream text;
  file.write_markdown(text);
  expect_contains(text.str(), "Semi-axes");
}
TEST(ShapeParameters, OfAWrongEntryNothingElseIsTold)
{
  const std::string radius = message<2>("set Type = disc\nset Centre = 0, 0\nset Radius = t");
  expect_contains(radius, "\"Radius\" = t is not allowed");
  EXPECT_EQ(radius.find("problems"), std::string::npos) << radius;
  const std::string type = message<2>("set Type = dsic\nset Centre = 0, 0\nset Radius = 1");
  expect_contains(type, "did you mean 'disc'");
  EXPECT_EQ(type.find("problems"), std::string::npos) << type;
  const std::string vertices = message<2>("set Type = polygon\nset Vertices = 0,0; 1,0; 1,t");
  EXPECT_EQ(vertices.find("problems"), std::string::npos) << vertices;
}
} // namespace
} // namespace scree
