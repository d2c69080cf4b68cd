// Triangle surfaces: files, what is wrong with them, distances and sections.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/geometry/moved_shape.h>
#include <scree/geometry/surface_shape.h>
#include <scree/level_set/binary_field.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

using Triangle = TriangleSoup::Triangle;

/** The octahedron divided n times, on a sphere of radius 1 around `centre`. */
TriangleSoup
sphere(const unsigned int n_divisions, const Point<3> &centre = {})
{
  TriangleSoup soup;
  for (unsigned int d = 0; d < 3; ++d)
    for (const int side : {1, -1})
      soup.points.push_back(side * Point<3>::unit_vector(d));
  for (const std::size_t x : {0, 1})
    for (const std::size_t y : {2, 3})
      for (const std::size_t z : {4, 5})
        soup.triangles.push_back((x + y + z) % 2 == 0 ? Triangle{{x, y, z}} : Triangle{{y, x, z}});
  for (unsigned int i = 0; i < n_divisions; ++i)
    {
      const std::vector<Triangle>     coarse = soup.triangles;
      std::map<Triangle, std::size_t> middles;
      const auto                      middle = [&](const std::size_t a, const std::size_t b) {
        const auto [known, is_new]
          = middles.emplace(Triangle{{std::min(a, b), std::max(a, b), 0}}, soup.points.size());
        if (is_new)
          {
            const Point<3> x = soup.points[a] + Tensor<1, 3>(soup.points[b]);
            soup.points.push_back(x / x.norm());
          }
        return known->second;
      };
      soup.triangles.clear();
      for (const auto &[a, b, c] : coarse)
        {
          const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
          for (const Triangle &part : {Triangle{{a, ab, ca}}, Triangle{{ab, b, bc}},
                                       Triangle{{ca, bc, c}}, Triangle{{ab, bc, ca}}})
            soup.triangles.push_back(part);
        }
    }
  for (Point<3> &x : soup.points)
    x += centre;
  return soup;
}

std::string
text_stl(const TriangleSoup &soup)
{
  std::ostringstream out;
  out.precision(17);
  out << "solid test\n";
  for (const Triangle &triangle : soup.triangles)
    {
      out << " facet normal 0 0 0\n  outer loop\n";
      for (const std::size_t corner : triangle)
        out << "   vertex " << soup.points[corner] << "\n";
      out << "  endloop\n endfacet\n";
    }
  out << "endsolid test\n";
  return out.str();
}

std::string
binary_stl(const TriangleSoup &soup)
{
  std::string         bytes(80, ' ');
  const std::uint32_t n = soup.triangles.size();
  bytes.append(reinterpret_cast<const char *>(&n), sizeof n);
  for (const Triangle &triangle : soup.triangles)
    {
      float numbers[12] = {};
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          numbers[3 + 3 * c + d] = soup.points[triangle[c]][d];
      bytes.append(reinterpret_cast<const char *>(numbers), sizeof numbers);
      bytes.append(2, '\0');
    }
  return bytes;
}

std::string
obj(const TriangleSoup &soup)
{
  std::ostringstream out;
  out.precision(17);
  out << "# a sphere\n";
  for (const Point<3> &x : soup.points)
    out << "v " << x << "\n";
  for (const auto &[a, b, c] : soup.triangles)
    out << "f " << a + 1 << "/1 " << b + 1 << "//2 " << c + 1 << "\n";
  return out.str();
}

/** `kind`: ascii, binary_little_endian, or binary_big_endian. */
std::string
ply(const TriangleSoup &soup, const std::string &kind)
{
  std::ostringstream out;
  out.precision(17);
  out << "ply\nformat " << kind << " 1.0\ncomment a sphere\nelement vertex " << soup.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
      << "element face " << soup.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool is_text = kind == "ascii", swaps = kind == "binary_big_endian";
  const auto write = [&](const auto number) {
    std::string bytes(reinterpret_cast<const char *>(&number), sizeof number);
    if (swaps)
      std::reverse(bytes.begin(), bytes.end());
    if (is_text)
      out << +number << ' ';
    else
      out << bytes;
  };
  for (const Point<3> &x : soup.points)
    {
      for (unsigned int d = 0; d < 3; ++d)
        write(x[d]);
      write(std::uint8_t(200));
    }
  for (const Triangle &triangle : soup.triangles)
    {
      write(std::uint8_t(3));
      for (const std::size_t corner : triangle)
        write(static_cast<std::int32_t>(corner));
    }
  return out.str();
}

std::string
message(const TriangleSoup &soup)
{
  return complaint([&]() { ClosedSurface(soup, "sand.stl"); });
}

std::string
message(const std::string &bytes, const std::string &name)
{
  return complaint([&]() { TriangleSoup::read(bytes, name); });
}

TEST(TriangleSoup, ReadsEachKind)
{
  const TriangleSoup original = sphere(2);
  for (const auto &[bytes, name] : std::vector<std::pair<std::string, std::string>>{
         {text_stl(original), "a.stl"},
         {binary_stl(original), "a.stl"},
         {obj(original), "a.obj"},
         {ply(original, "ascii"), "a.ply"},
         {ply(original, "binary_little_endian"), "a.ply"},
         {ply(original, "binary_big_endian"), "a.ply"}})
    {
      const TriangleSoup soup = TriangleSoup::read(bytes, name);
      EXPECT_EQ(soup.points.size(), original.points.size());
      ASSERT_EQ(soup.triangles.size(), original.triangles.size());
      for (std::size_t t = 0; t < soup.triangles.size(); ++t)
        for (unsigned int c = 0; c < 3; ++c)
          EXPECT_LT(
            soup.points[soup.triangles[t][c]].distance(original.points[original.triangles[t][c]]),
            1e-6);
    }
  EXPECT_EQ(
    TriangleSoup::read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -1 -2 -3\n", "a.obj")
      .triangles.size(),
    3u);
}

TEST(TriangleSoup, RefusesWhatIsNoSurface)
{
  expect_contains(message("", "a.stl"), "neither begins with 'solid'");
  expect_contains(message("solid a\nendsolid a\n", "a.stl"), "the file has no facet");
  expect_contains(message("solid a\nfacet\nvertex 1 2\nvertex", "a.stl"),
                  "a.stl:4: 'vertex' is no number");
  expect_contains(message("solid a\nvertex 1 2 3\nendfacet", "a.stl"), "a facet has 1 vertices");
  expect_contains(message("solid a\nvertex 1 2 3\n", "a.stl"), "ends within a facet");
  expect_contains(message("solid a\nvertex 1 2 1e999\n", "a.stl"), "no finite number");
  expect_contains(message("solid a\nvertices\n", "a.stl"), "no word of an STL file");
  expect_contains(message("v 0 0 0\nf 1 2 3\n", "a.obj"),
                  "a.obj:2: '2' names none of the 1 vertices");
  expect_contains(message("v 0 0 0\nf 1 1\n", "a.obj"), "fewer than 3 corners");
  const std::string vertices = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                               "property float y\nproperty float z\n",
                    faces    = "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  expect_contains(message(vertices, "a.ply"), "the header of the PLY file does not end");
  expect_contains(message(vertices + faces + "0 0 0 1 0 0\n3 0 1 2\n", "a.ply"),
                  "a.ply:11: a face names none of the 2 vertices");
  expect_contains(message(vertices + faces + "0 0 0 1 0 0\n2 0 1\n", "a.ply"),
                  "fewer than 3 corners");
  expect_contains(message("ply\nformat ascii 1.0\nelement vertex 99\n", "a.ply"),
                  "cannot hold so many elements 'vertex'");
  expect_contains(message("ply\nformat middle_endian 1.0\n", "a.ply"), "is no format");
  expect_contains(message("ply\nelement vertex 1\nproperty real x\n", "a.ply"),
                  "'real' is no type");
}

TEST(TriangleSoup, SurvivesDamage)
{
  std::mt19937_64 random(3);
  unsigned int    n_read = 0, n_refused = 0, n_closed = 0;
  const auto      soup = sphere(1);
  for (const auto &[original, name] : std::vector<std::pair<std::string, std::string>>{
         {text_stl(soup), "a.stl"},
         {binary_stl(soup), "a.stl"},
         {obj(soup), "a.obj"},
         {ply(soup, "ascii"), "a.ply"},
         {ply(soup, "binary_little_endian"), "a.ply"}})
    for (unsigned int i = 0; i < 3000; ++i)
      {
        std::string bytes = original;
        for (unsigned int k = 0; k <= random() % 3; ++k)
          {
            const std::size_t place = random() % bytes.size();
            switch (random() % 5)
              {
              case 0:
                bytes[place] = static_cast<char>(random());
                break;
              case 1:
                bytes[place] ^= static_cast<char>(1u << random() % 8);
                break;
              case 2:
                bytes[place] = "0123456789-e."[random() % 13];
                break;
              case 3:
                bytes.erase(place, random() % 60);
                break;
              default:
                bytes.insert(place, bytes.substr(random() % bytes.size(), random() % 60));
              }
            if (bytes.empty())
              bytes = "s";
          }
        try
          {
            const TriangleSoup read = TriangleSoup::read(bytes, name);
            ++n_read;
            const ClosedSurface surface(read, name);
            ++n_closed;
            EXPECT_TRUE(std::isfinite(surface.signed_distance({0.1, 0.2, 0.3})));
          }
        catch (const UserError &error)
          {
            expect_contains(error.what(), name);
            ++n_refused;
          }
      }
  EXPECT_GT(n_read, 1000u);
  EXPECT_GT(n_closed, 300u);
  EXPECT_GT(n_refused, 1000u);
}

TEST(ClosedSurface, KnowsDistancesInAnyOrientation)
{
  TriangleSoup    soup = sphere(4, {1, 2, 3});
  std::mt19937_64 random(1);
  for (Triangle &triangle : soup.triangles)
    if (random() % 2 == 0)
      std::swap(triangle[0], triangle[1]);
  const ClosedSurface surface(soup, "sphere.stl");
  EXPECT_NEAR(surface.volume(), 4. / 3. * numbers::PI, 0.03);
  EXPECT_GT(surface.volume(), 0.);
  for (unsigned int i = 0; i < 200; ++i)
    {
      const Point<3> x(2 * std::sin(7. * i), 2 * std::sin(11. * i), 2 * std::sin(13. * i));
      EXPECT_NEAR(surface.signed_distance(Point<3>(1, 2, 3) + Tensor<1, 3>(x)), x.norm() - 1, 6e-3);
    }
  const LatticeFrame<3> frame{Point<3>(-1, -1, -1), 0.08,
                              BoundingBox<3>({Point<3>(-1, -1, -1), Point<3>(5, 5, 5)})};
  const auto shape = std::make_shared<SurfaceShape>(std::make_shared<ClosedSurface>(soup, "a.stl"));
  EXPECT_NEAR(volume_below(make_lattice<3>(shape, frame, 0.2), 0.), surface.volume(),
              5e-3 * surface.volume());
}

// Out of the surface, and turned with it.
TEST(ClosedSurface, GradientsAreThoseOfDistances)
{
  const auto          surface = std::make_shared<ClosedSurface>(sphere(3), "sphere.stl");
  const MovedShape<3> shape(std::make_shared<SurfaceShape>(surface),
                            rotation_matrix<3>(70., {1, 2, 3}), Point<3>(0.1, 0.2, 0.3),
                            Tensor<1, 3>({4, 5, 6}));
  const double        step   = 1e-6;
  const Point<3>      middle = shape.bounding_box().center();
  for (unsigned int i = 1; i < 200; ++i)
    {
      const Point<3> x
        = middle + Tensor<1, 3>({std::sin(7. * i), std::sin(11. * i), std::sin(13. * i)});
      const auto gradient = shape.exact_gradient(x, 1e-9);
      ASSERT_TRUE(gradient);
      for (unsigned int d = 0; d < 3; ++d)
        {
          Point<3> before = x, after = x;
          before[d] -= step;
          after[d] += step;
          EXPECT_NEAR((*gradient)[d],
                      (shape.signed_distance(after) - shape.signed_distance(before)) / (2. * step),
                      1e-4);
        }
    }
}

TEST(ClosedSurface, SectionsAreOutlines)
{
  const ClosedSurface surface(sphere(4, {1, 2, 3}), "sphere.stl");
  const auto          outlines = surface.section(1, 2.5);
  ASSERT_EQ(outlines.size(), 1u);
  const OutlineShape outline(outlines[0]);
  const double       radius = std::sqrt(0.75);
  EXPECT_NEAR(outline.signed_distance({1, 3}), -radius, 5e-3);
  EXPECT_NEAR(outline.signed_distance({3, 3}), 2 - radius, 5e-3);
  EXPECT_NEAR(outline.bounding_box().side_length(1), 2 * radius, 1e-2);
  EXPECT_TRUE(surface.section(2, 5.).empty());
}

TEST(ClosedSurface, WhatIsWrongIsToldWithItsFacet)
{
  TriangleSoup open = sphere(2);
  open.triangles.erase(open.triangles.begin() + 17);
  expect_contains(message(open), "sand.stl: the surface is open: facet ");
  expect_contains(message(open), " at (");
  TriangleSoup third = sphere(1);
  third.points.emplace_back(2, 2, 2);
  third.triangles.push_back(
    {{third.triangles[0][0], third.triangles[0][1], third.points.size() - 1}});
  expect_contains(message(third), "more than two facets meet in an edge of facet 33");
  TriangleSoup flat                 = sphere(1);
  flat.points[flat.triangles[4][0]] = flat.points[flat.triangles[4][1]];
  expect_contains(message(flat), " has no area");
  TriangleSoup       apart = sphere(1);
  const TriangleSoup other = sphere(1, {5, 0, 0});
  for (const Triangle &t : other.triangles)
    apart.triangles.push_back(
      {{t[0] + apart.points.size(), t[1] + apart.points.size(), t[2] + apart.points.size()}});
  apart.points.insert(apart.points.end(), other.points.begin(), other.points.end());
  expect_contains(message(apart), "2 parts that are apart");
  TriangleSoup crossed = sphere(2);
  crossed.points[0]    = Point<3>(-1.5, 0, 0);
  expect_contains(message(crossed), "the surface crosses itself in ");
}

TEST(SurfaceShape, IsReadFromParameters)
{
  const std::string name = ::testing::TempDir() + "sphere.stl";
  std::ofstream(name, std::ios::binary) << binary_stl(sphere(4));
  const auto shape_of = [&](const std::string &lines) {
    ParameterFile file
      = ParameterFile::from_string("set Type = surface\nset File = " + name + "\n" + lines);
    ShapeParameters<2> parameters;
    parameters.declare(file.root());
    file.check();
    return make_shape(parameters);
  };
  const auto told = [&](const std::string &lines) { return complaint([&]() { shape_of(lines); }); };
  const auto shape
    = shape_of("set Scale = 2\nset Section plane = x = 1\nset Translation = 10, 20\n");
  EXPECT_NEAR(shape->signed_distance({10, 20}), -std::sqrt(3.), 0.012);
  expect_contains(told(""), "needs the entry 'Section plane'");
  expect_contains(told("set Section plane = x = 3"), "does not cut the surface");
  expect_contains(told("set Section plane = 3"), "'3' is no plane");
  expect_contains(told("set Section plane = x = 0\nset Checksum = 0"), "has changed");
  std::remove(name.c_str());
  expect_contains(told("set Section plane = x = 0"), "cannot open the file");
}
} // namespace
} // namespace scree
