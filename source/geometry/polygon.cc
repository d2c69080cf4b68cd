#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/geometry/polygon.h>
#include <scree/geometry/rounded_polygon.h>
#include <scree/parameters/data_file.h>
#include <scree/parameters/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
// Whether a segment meets a closed box.
bool
segment_meets_box(const Point<2> &a, const Point<2> &b, const BoundingBox<2> &box)
{
  double first = 0, last = 1;
  for (unsigned int d = 0; d < 2; ++d)
    {
      const double length = b[d] - a[d];
      double       enter = box.lower_bound(d) - a[d], leave = box.upper_bound(d) - a[d];
      if (length == 0)
        {
          if (enter > 0 || leave < 0)
            return false;
          continue;
        }
      enter /= length;
      leave /= length;
      first = std::max(first, std::min(enter, leave));
      last  = std::min(last, std::max(enter, leave));
    }
  return first <= last;
}

constexpr std::size_t largest_vertices_file = 64000000; // bytes

/** A point per line; the first line may have names, what follows # is not read. */
std::vector<Point<2>>
vertices_in(const std::string &text, const std::string &file)
{
  std::vector<Point<2>> vertices;
  bool                  may_have_names = true;
  for (const auto &[line, where, number] : data_lines(text, file))
    {
      Point<2>   vertex;
      const bool is_vertex = parse_value(line, vertex).ok;
      require(is_vertex || (may_have_names && std::isalpha(static_cast<unsigned char>(line[0]))),
              where, "'" + line + "' is no point", "write x and y, a comma between them");
      may_have_names = false;
      if (is_vertex)
        vertices.push_back(vertex);
    }
  return vertices;
}

std::vector<Point<2>>
vertices_of_file(const std::string &file)
{
  return vertices_in(
    read_text_file(file, largest_vertices_file, file, "check the path", "vertices"), file);
}

/** Those of the entry or of the file, without a last one that is the first again. */
template <int dim>
std::vector<Point<2>>
vertices_of(const ShapeParameters<dim> &p)
{
  const std::string    &file     = p.text("Vertices file");
  std::vector<Point<2>> vertices = file.empty() ? p.vertices("Vertices") : vertices_of_file(file);
  if (const double scale = p.number("Scale"); !std::isnan(scale))
    for (Point<2> &vertex : vertices)
      vertex *= scale;
  if (vertices.size() > 1 && vertices.front() == vertices.back())
    vertices.pop_back();
  return vertices;
}

template <int dim>
void
check_polygon(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (dim == 3)
    return section.error("Type", "polygons exist in 2D only",
                         "use a box or an intersection of half spaces");
  const std::string &file = p.text("Vertices file");
  const std::string  key  = file.empty() ? "Vertices" : "Vertices file";
  if (section.is_wrong("Vertices"))
    return;
  if (file.empty() == p.vertices("Vertices").empty())
    return section.error(file.empty() ? "Type" : "Vertices file",
                         file.empty()
                           ? "Type = polygon needs the entry 'Vertices' or 'Vertices file'"
                           : "both Vertices and a file of them are given",
                         "set one of them");
  if (file.empty() && !std::isnan(p.number("Scale")))
    section.error("Scale", "is of a file, but there is no Vertices file", "scale the Vertices");
  if (!file.empty()
      && !declare_checksum(
        section, file, read_bytes(file, largest_vertices_file, file, "check the path", "vertices")))
    return;
  const auto   vertices = vertices_of(p);
  const double radius   = p.number("Corner radius");
  if (vertices.size() < 3)
    section.error(key, "the polygon has " + std::to_string(vertices.size()) + " vertices",
                  "give at least 3, as in 0,0; 1,0; 1,1");
  else if (Polygon::crosses_itself(vertices))
    section.error(key, "the sides of the polygon cross or touch each other",
                  "list the corners in order along the boundary, each once");
  else if (const std::string problem
           = std::isnan(radius) ? "" : RoundedPolygon::what_does_not_fit(vertices, radius);
           !problem.empty())
    section.error("Corner radius", problem, "give a smaller radius");
}

template <int dim>
void
check_polygon_or_tell(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  try
    {
      check_polygon(p, section);
    }
  catch (const UserError &error)
    {
      section.error("Vertices file", error.what());
    }
}

template <int dim>
ShapePointer<dim>
make_polygon(const ShapeParameters<dim> &p)
{
  if constexpr (dim == 2)
    {
      const double radius = p.number("Corner radius");
      if (!std::isnan(radius))
        return std::make_unique<RoundedPolygon>(vertices_of(p), radius);
      return std::make_unique<Polygon>(vertices_of(p));
    }
  else
    AssertThrow(false, ExcMessage("Polygons exist in 2D only."));
}
} // namespace

template <int dim>
ShapeFamily<dim>
Polygon::family()
{
  return {{"polygon"},
          "polygon (2D)",
          {{"Vertices", "Corners of % in order, either way round, as in 0,0; 1,0; 1,1", "[L]",
            std::vector<Point<2>>(), false, false},
           {"Vertices file", "File (CSV) with a corner per line in place of Vertices", "",
            std::string(), false, false, true},
           corner_radius(),
           checksum_entry(),
           scale_of_file()},
          make_polygon<dim>,
          check_polygon_or_tell<dim>};
}

Polygon::Polygon(const std::vector<Point<2>> &vertices)
    : vertices(vertices)
    , sides(vertices)
{
  Assert(vertices.size() >= 3, ExcMessage("A polygon needs 3 vertices."));
}

double
Polygon::signed_distance(const Point<2> &x) const
{
  return sides.signed_distance(x);
}

BoundingBox<2>
Polygon::bounding_box() const
{
  return BoundingBox<2>(vertices);
}

bool
Polygon::crosses_itself(const std::vector<Point<2>> &vertices)
{
  return PolygonSides(vertices).cross();
}

bool
Polygon::is_smooth() const
{
  return false;
}

void
Polygon::append_pieces(const BoundingBox<2> &box, std::vector<SmoothPiece<2>> &pieces) const
{
  double area = 0;
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    area += vertices[j][0] * vertices[i][1] - vertices[j][1] * vertices[i][0];
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    if (const Point<2> &a = vertices[j], &b = vertices[i]; segment_meets_box(a, b, box))
      {
        const Tensor<1, 2> side = b - a;
        pieces.emplace_back(a,
                            (area > 0 ? 1 : -1) / side.norm() * Tensor<1, 2>({side[1], -side[0]}));
      }
}

template ShapeFamily<2> Polygon::family();
template ShapeFamily<3> Polygon::family();
} // namespace scree
