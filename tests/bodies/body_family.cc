// Families: many bodies of one section.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/bodies/body_list.h>
#include <scree/level_set/binary_field.h>
#include <scree/parameters/file.h>

#include <random>

#include "../messages.h"
#include "../temporary_file.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Stones 3 and 12 of 8 x 8 pixels, beside one another, and a speck of one pixel. */
std::string
two_stones()
{
  std::string text = "P2 24 16 255\n";
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 24; ++i)
      {
        const bool in_rows = j >= 4 && j < 12;
        text += i == 0 && j == 0               ? "7 "
                : in_rows && i >= 3 && i < 11  ? "3 "
                : in_rows && i >= 11 && i < 19 ? "12 "
                                               : "0 ";
      }
  return text;
}

template <int dim>
std::vector<BodyParameters<dim>>
parameters(const std::string &text, std::vector<std::string> *warnings = nullptr)
{
  ParameterFile    file    = ParameterFile::from_string(text);
  ParameterSection section = file.root();
  const auto       bodies  = declare_bodies<dim>(section, {{"soft", {}}, {"hard", {}}});
  file.check();
  if (warnings != nullptr)
    *warnings = file.warnings();
  return bodies;
}

template <int dim>
std::string
message(const std::string &text)
{
  return complaint([&]() { parameters<dim>(text); });
}

template <int dim>
std::vector<std::string>
names(const std::vector<BodyParameters<dim>> &bodies)
{
  std::vector<std::string> result;
  for (const auto &body : bodies)
    result.push_back(body.name);
  return result;
}

/** A section of a family; `lines` of its own subsection. */
std::string
family(const std::string &kind, const std::string &section, const std::string &lines,
       const std::string &more = "")
{
  return "set Names = stone\nsubsection stone\n set Material = soft\n set Family = " + kind + "\n"
         + more + " subsection " + section + "\n" + lines + " end\nend\n";
}

std::string
image(const std::string &file, const std::string &lines)
{
  return family("image", "Image", "set File = " + file + "\n" + lines);
}

TEST(ImageFamily, MakesABodyOfEachLabel)
{
  const TemporaryFile      file("two_stones.pgm", two_stones());
  std::vector<std::string> warnings;
  const auto               found = parameters<2>(
    image(file.name, "set Pixel size = 0.1\nset Lower corner = -1, -1\nset Smallest area = 0.02\n"),
    &warnings);
  EXPECT_EQ(names(found), (std::vector<std::string>{"stone-0003", "stone-0012"}));
  ASSERT_EQ(warnings.size(), 1u);
  expect_contains(warnings[0], "label 7 at (-0.95, 0.55) (0.01); they are left out");
  EXPECT_EQ(names(parameters<2>(image(file.name, "set Pixel size = 0.1\nset Labels = 12\n"))),
            (std::vector<std::string>{"stone-0012"}));

  MaterialParameters material;
  material.young                                = 1.;
  material.poisson                              = 0.;
  const std::shared_ptr<const Material<2>> soft = make_material<2>(material);
  const Point<2>                           lower(-1., -1.), upper(2., 1.);
  const auto                               bodies
    = make_bodies<2>(found, {{"soft", soft}}, {lower, 0.03, BoundingBox<2>({lower, upper})}, 0.3);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[1].path, "stone (stone-0012)");
  for (const auto &body : bodies)
    EXPECT_NEAR(volume_below(body.level_set, 0.), 0.64, 3e-3) << body.name;
  EXPECT_NEAR(bodies[1].level_set.value({0.5, -0.21}, 1), -0.4, 0.05);
}

TEST(ImageFamily, TakesPartsAndMergesOrLeavesOut)
{
  const TemporaryFile      file("two_stones.pgm", two_stones());
  std::vector<std::string> warnings;
  const std::string        size = "set Pixel size = 0.1\n";
  EXPECT_EQ(
    names(parameters<2>(image(file.name, size
                                           + "set First pixel = 0, 2\nset Last pixel = 15, 13\n"
                                             "set Cut labels = drop\n"))),
    (std::vector<std::string>{"stone-0003"}));
  EXPECT_EQ(names(parameters<2>(image(file.name, size + "set Last pixel = 23, 14\n"))),
            (std::vector<std::string>{"stone-0003", "stone-0012"}));
  // A speck of label 2 in stone 1.
  const TemporaryFile speck("speck.pgm", "P2 5 3 9\n1 1 1 1 0\n1 1 2 1 0\n1 1 1 1 0\n");
  EXPECT_EQ(names(parameters<2>(image(speck.name, size
                                                    + "set Smallest area = 0.02\n"
                                                      "set Small pieces = merge\n"),
                                &warnings)),
            (std::vector<std::string>{"stone-0001"}));
  ASSERT_EQ(warnings.size(), 1u);
  expect_contains(warnings[0], "label 2 at (0.25, 0.15) (into 1); they join their neighbours");
}

TEST(ImageFamily, MakesABodyOfEachLabelOfAVolume)
{
  // Cubes of 4 voxels' edge of labels 1 and 2; the header is beside its data.
  std::string data;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 16; ++i)
        {
          const bool is_in = j >= 2 && j < 6 && k >= 2 && k < 6;
          data += static_cast<char>(is_in && i >= 3 && i < 7    ? 1
                                    : is_in && i >= 9 && i < 13 ? 2
                                                                : 0);
        }
  const TemporaryFile raw("cubes.raw", data),
    header("cubes.mhd", "ObjectType = Image\nNDims = 3\nDimSize = 16 8 8\nElementSpacing = .5 .5 .5"
                        "\nElementType = MET_UCHAR\nElementDataFile = cubes.raw\n");
  const auto found = parameters<3>(image(header.name, ""));
  EXPECT_EQ(names(found), (std::vector<std::string>{"stone-0001", "stone-0002"}));
  MaterialParameters material;
  material.young                                = 1.;
  material.poisson                              = 0.;
  const std::shared_ptr<const Material<3>> soft = make_material<3>(material);
  const Point<3>                           lower(0., 0., 0.), upper(8., 4., 4.);
  const auto                               bodies
    = make_bodies<3>(found, {{"soft", soft}}, {lower, 0.2, BoundingBox<3>({lower, upper})}, 0.5);
  for (const auto &body : bodies)
    EXPECT_NEAR(volume_below(body.level_set, 0.), 8., 0.08) << body.name;
  expect_contains(message<2>(image(header.name, "")), "set Dimension = 3");
  const TemporaryFile other("cubes.raw", data.substr(1) + "\1");
  expect_contains(message<3>(image(header.name, "set Checksum = 12345678\n")),
                  "has changed, its checksum is ");
}

TEST(ImageFamily, WrongImagesAreExplained)
{
  const TemporaryFile file("two_stones.pgm", two_stones());
  const std::string   size = "set Pixel size = 0.1\n";
  expect_contains(message<2>(image("nowhere.png", size)), "cannot open the file");
  expect_contains(message<2>(image(file.name, "")), "give the edge of a pixel");
  expect_contains(message<2>(image(file.name, size + "set Labels = 3, 4\n")),
                  "label 4 is not in the image");
  expect_contains(message<2>(image(file.name, size
                                                + "set Smallest area = 0.1\n"
                                                  "set Small pieces = refuse\n")),
                  "label 7 at (0.05, 1.55) (0.01)");
  expect_contains(message<2>(image(file.name, size + "set Smallest area = 100\n")),
                  "no label of the image becomes a body");
  expect_contains(message<2>(image(file.name, size + "set Checksum = 12345678\n")),
                  "has changed, its checksum is ");
  expect_contains(message<3>(image(file.name, size)), "set Dimension = 2");
  expect_contains(message<2>(image(file.name, size + "set Last pixel = 24, 3\n")),
                  "Last pixel: 24 is not in the image");
  expect_contains(message<2>(image(file.name, size + "set First pixel = 1\n")),
                  "First pixel: 1 number(s)");
  expect_contains(
    message<2>(image(file.name, size + "set First pixel = 5, 5\nset Last pixel = 4, 9\n")),
    "lies before First pixel");
  const TemporaryFile text("stones.txt", "stones");
  expect_contains(message<2>(image(text.name, size)), "this is no PNG, PGM or TIFF image");
  const TemporaryFile pieces("pieces.pgm", "P2 5 1 9\n1 1 0 1 0\n");
  expect_contains(message<2>(image(pieces.name, size)),
                  "label 1 at (0.35, 0.05) is a piece of 1 pixels (area 0.01) that does not touch "
                  "the larger one of 2 pixels at (0.05, 0.05)");
}

/** What the shape of a body gives at a point. */
template <int dim>
double
distance(const BodyParameters<dim> &body, const Point<dim> &x)
{
  return body.shape_of_member()->signed_distance(x);
}

TEST(ArrayFamily, CopiesTheShape)
{
  const std::string disc
    = "subsection Shape\nset Centre = 0, 0\nset Radius = 0.5\nset Translation = 1, 1\nend\n";
  const auto found = parameters<2>(
    family("array", "Array", "set Counts = 3, 2\nset Spacing = 1, 0.9\nset Shift = 0.5\n", disc));
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[5].name, "stone-0006");
  EXPECT_NEAR(distance(found[0], {1, 1}), -0.5, 1e-14);
  EXPECT_NEAR(distance(found[2], {3, 1}), -0.5, 1e-14);
  EXPECT_NEAR(distance(found[5], {3.5, 1.9}), -0.5, 1e-14);
  expect_contains(
    message<2>(family("array", "Array", "set Counts = 3\nset Spacing = 1, 1\n", disc)),
    "needs 2 numbers greater than zero");
  expect_contains(
    message<2>(family("array", "Array", "set Counts = 3, 3\nset Spacing = 1\n", disc)),
    "needs 2 lengths");
  expect_contains(
    message<2>(family("array", "Array", "set Counts = 60000, 60000\nset Spacing = 1, 1\n", disc)),
    "too many bodies");
  expect_contains(message<2>(family("array", "Array", "set Counts = 3, 3\nset Spacing = 1, 1\n")),
                  "needs the entry 'Radius'");
}

TEST(ListFamily, MakesABodyOfEachRow)
{
  const TemporaryFile file("stones.csv", "# a table\nName, Type, Centre x, Centre y, Radius, "
                                         "Semi-axes x, Semi-axes y, Material\n"
                                         "\nbig, disc, 1, 2, 3, , , \n"
                                         ", ellipse, 1, 1, , 2, 1, hard # the second\n");
  const auto found = parameters<2>(family("list", "List", "set File = " + file.name + "\n"));
  EXPECT_EQ(names(found), (std::vector<std::string>{"stone-big", "stone-0002"}));
  EXPECT_EQ(found[0].material, "soft");
  EXPECT_EQ(found[1].material, "hard");
  EXPECT_NEAR(distance(found[0], {1, 2}), -3., 1e-14);
  EXPECT_NEAR(distance(found[1], {1, 3}), 1., 1e-12);
}

TEST(ListFamily, WrongTablesAreExplained)
{
  const auto told = [](const std::string &table) {
    const TemporaryFile file("wrong.csv", table);
    return message<2>(family("list", "List", "set File = " + file.name + "\n"));
  };
  const std::string columns = "Centre x, Centre y, Radius\n";
  expect_contains(told(columns), "the table has no row");
  expect_contains(told(columns + "1, 2\n"), "wrong.csv:2: the row has 2 cells, the first line 3");
  expect_contains(told(columns + "1, 2, -3\n"), "wrong.csv, line 2, column:3");
  expect_contains(told(columns + "1, 2, -3\n"), "'Radius' must be greater than zero");
  expect_contains(told(columns + "1, b, 3\n"), "line 2, column:1");
  expect_contains(told(columns + "\"1, 2, 3\n"), "a quotation mark is not closed");
  expect_contains(told("Centre x, Centre y, Radious\n1, 2, 3\n"), "did you mean 'Radius'");
  expect_contains(told("Radius, Radius\n1, 2\n"), "two columns are called 'Radius'");
  expect_contains(told("Name, Centre x, Centre y, Radius\na/b, 1, 2, 3\n"), "cannot be a name");
  expect_contains(told("Name, Centre x, Centre y, Radius\na, 1, 2, 3\na, 1, 2, 3\n"),
                  "two bodies are called 'stone-a'");
  expect_contains(told("Material, Centre x, Centre y, Radius\nwood, 1, 2, 3\n"),
                  "there is no material 'wood'");
}

// Whatever the bytes of a table are, there are bodies or a message.
TEST(ListFamily, SurvivesDamage)
{
  const std::string original = "Name, Type, Centre x, Centre y, Radius, Semi-axes x, Semi-axes y\n"
                               "a, disc, 1, 2, 3, , \nb, ellipse, 1, 1, , 2, 1\n";
  std::mt19937_64   random(11);
  unsigned int      n_read = 0, n_refused = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      std::string table = original;
      for (unsigned int k = 0; k <= random() % 2; ++k)
        {
          const std::size_t place = random() % table.size();
          if (random() % 3 == 0)
            table[place] = static_cast<char>(random());
          else if (random() % 2 == 0)
            table[place] = "0123456789"[random() % 10];
          else
            table.insert(place, table.substr(random() % table.size(), random() % 30));
        }
      const TemporaryFile file("mutant.csv", table);
      const std::string told = message<2>(family("list", "List", "set File = " + file.name + "\n"));
      ++(told.empty() ? n_read : n_refused);
    }
  EXPECT_GT(n_read, 25u);
  EXPECT_GT(n_refused, 250u);
}

TEST(PackingFamily, MakesDiscs)
{
  const std::string lines = "set Number = 10\nset Upper corner = 2, 1\n";
  const auto        found = parameters<2>(family("packing", "Packing", lines));
  ASSERT_EQ(found.size(), 10u);
  const auto box = found[0].shape_of_member()->bounding_box();
  EXPECT_GT(box.lower_bound(0), -1e-12);
  const auto loose = parameters<2>(family("packing", "Packing", lines + "set Growth = 0.5\n"));
  EXPECT_NEAR(loose[0].shape_of_member()->bounding_box().side_length(0), 0.5 * box.side_length(0),
              1e-12);
}

TEST(PackingFamily, WrongEntriesAreExplained)
{
  const auto told = [](const std::string &lines) {
    return message<2>(
      family("packing", "Packing", "set Number = 10\nset Upper corner = 2, 1\n" + lines));
  };
  EXPECT_EQ(told("set Type = ellipse\nset Aspect ratio = 1.2, 1.8\n"), "");
  expect_contains(message<2>(family("packing", "Packing", "set Upper corner = 2, 1\n")),
                  "give a number of bodies");
  expect_contains(message<2>(family("packing", "Packing", "set Number = 10\n")),
                  "is not above Lower corner");
  expect_contains(told("set Type = heart\n"), "regular polygon, random polygon");
  expect_contains(told("set Type = ellipse\n"), "is needed by Type = ellipse");
  expect_contains(told("set Type = ellipse\nset Aspect ratio = 1.8, 1.2\n"),
                  "'Aspect ratio' is no number or range within 1 and 10");
  expect_contains(told("set Type = ellipse\nset Aspect ratio = 11\n"), "within 1 and 10");
  expect_contains(told("set Type = regular polygon\nset Corners = 2, 5\n"), "within 3 and 100");
  expect_contains(told("set Aspect ratio = 1.5\n"), "'Aspect ratio' is not used by Type = disc");
  expect_contains(told("set Exponent = 3\n"), "'Exponent' is not used by Type = disc");
  expect_contains(told("set Corners = 5\n"), "'Corners' is not used by Type = disc");
  expect_contains(told("set Rounding = 0.2\n"), "'Rounding' is not used by Type = disc");
  expect_contains(told("set Container = cylinder\n"), "2 wide along x, 1 along y");
  expect_contains(told("set Solid fraction = 0.95\n"), "is not reached: the bodies jam at 0.");
  expect_contains(told("set Solid fraction = 0.5\nset Growth = 0.9\n"), "remove one of them");
}

/** The bodies of a family, and those of the list that is made of it. */
template <int dim>
void
expect_same_list(const std::string &text)
{
  const auto          bodies = parameters<dim>(text);
  const TemporaryFile file("listed.csv", list_of_family(bodies, "stone"));
  const auto again = parameters<dim>(family("list", "List", "set File = " + file.name + "\n"));
  EXPECT_EQ(names(again), names(bodies)) << text;
  std::mt19937_64 random(5);
  for (std::size_t i = 0; i < std::min(bodies.size(), again.size()); ++i)
    {
      EXPECT_EQ(again[i].material, bodies[i].material);
      const auto shape = bodies[i].shape_of_member(), other = again[i].shape_of_member();
      for (unsigned int k = 0; k < 20; ++k)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = 10. * (static_cast<double>(random() >> 11) * 0x1p-53) - 2.;
          const double value = shape->signed_distance(x);
          EXPECT_NEAR(other->signed_distance(x), value, 1e-12 * (1. + std::abs(value))) << text;
        }
    }
  // The list of the list is the same table.
  EXPECT_EQ(list_of_family(again, "stone"), list_of_family(bodies, "stone"));
}

TEST(BodyList, HasTheSameBodies)
{
  const std::string lines = "set Number = 7\nset Upper corner = 2, 2\nset Size ratio = 1.5\n";
  for (const std::string type : {"disc\n", "disc\nset Container = cylinder\n",
                                 "ellipse\nset Growth = 1.02\nset Aspect ratio = 1.2, 1.8\n",
                                 "superellipse\nset Exponent = 4\nset Aspect ratio = 2\n",
                                 "regular polygon\nset Corners = 5\n",
                                 "random polygon\nset Corners = 3, 7\nset Rounding = 0.3\n"})
    expect_same_list<2>(family("packing", "Packing", lines + "set Type = " + type));
  const std::string in_space = "set Number = 7\nset Upper corner = 2, 2, 2\n";
  for (const std::string type :
       {"ball\n", "ellipsoid\nset Aspect ratio = 1.2, 1.8\nset Second aspect ratio = 1.5\n",
        "superellipse\nset Exponent = 3\nset Container = cylinder\n"})
    expect_same_list<3>(family("packing", "Packing", in_space + "set Type = " + type));
  const std::string array = "set Counts = 3, 2\nset Spacing = 3, 2.7\nset Shift = 0.1\n";
  for (const std::string shape :
       {"set Centre = 0, 0.1\nset Radius = 0.5\nset Translation = 1, 1\n",
        "set Type = ellipse\nset Centre = 0.1, 0.2\nset Semi-axes = 1, 0.7\nset Rotation angle = "
        "30\n",
        "set Type = polygon\nset Vertices = 0, 0; 1, 0.2; 0.3, 1\nset Corner radius = 0.05\n",
        "set Type = expression\nset Expression = max(x^2 + y^2 - 1, y - 0.3)\n"
        "set Rotation angle = 20\nset Rotation centre = 0.1, 0.3\n"})
    expect_same_list<2>(family("array", "Array", array, "subsection Shape\n" + shape + "end\n"));
}

TEST(BodyList, HasMaterialsAndWhatIsMissing)
{
  const TemporaryFile file("stones.csv", "Name, Type, Centre x, Centre y, Radius, Semi-axes x, "
                                         "Semi-axes y, Material\nbig, disc, 1, 2, 3, , , \n"
                                         "\"a \"\"b\"\"\", ellipse, 1, 1, , 2, 1, hard\n");
  const std::string   text = family("list", "List", "set File = " + file.name + "\n");
  expect_same_list<2>(text);
  EXPECT_EQ(list_of_family(parameters<2>(text), "stone"),
            "Name, Material, Type, Centre x, Centre y, Radius, Semi-axes x, Semi-axes y\n"
            "big, soft, disc, 1, 2, 3, , \n\"a \"\"b\"\"\", hard, ellipse, 1, 1, , 2, 1\n");
}

TEST(BodyList, WhatNoTableCanTellIsExplained)
{
  const std::string part = "set Radius = 1\nset Centre = 0, 0\n";
  const auto        bodies
    = parameters<2>(family("array", "Array", "set Counts = 2, 1\nset Spacing = 3, 3\n",
                           "subsection Shape\nset Type = union\nset Parts = a, b\nsubsection a\n"
                             + part + "end\nsubsection b\n" + part + "end\nend\n"));
  expect_contains(complaint([&]() { list_of_family(bodies, "stone"); }),
                  "no table can tell its shapes");
  expect_contains(complaint([&]() { list_of_family(bodies, "stones"); }), "one of: stone");
}

TEST(BodyFamilies, EntriesThatDoNotGoTogetherAreExplained)
{
  const TemporaryFile file("two_stones.pgm", two_stones());
  const std::string   lines = "set File = " + file.name + "\nset Pixel size = 0.1\n";
  expect_contains(
    message<2>(family("image", "Image", lines, "subsection Shape\nset Radius = 1\nend\n")),
    "'Radius' is not used: Family = image makes the shapes");
  expect_contains(message<2>(family("none", "Image", lines,
                                    "subsection Shape\nset Centre = 0, 0\nset Radius = 1\nend\n")),
                  "set Family = image, or remove it");
  expect_contains(message<2>(family("imgae", "Image", lines)), "did you mean 'image'");
  std::string both = image(file.name, "set Pixel size = 0.1\n");
  both.replace(both.find("= stone"), 7, "= stone, stone-0012");
  both += "subsection stone-0012\nset Material = soft\nsubsection Shape\nset Centre = 0, 0\n"
          "set Radius = 1\nend\nend\n";
  expect_contains(message<2>(both), "two bodies are called 'stone-0012'");
}
} // namespace
} // namespace scree
