#include <scree/geometry/polygon.h>

#include <algorithm>

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

template <int dim>
void
check_polygon(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const auto &vertices = p.vertices("Vertices");
  if (dim == 3)
    section.error("Type", "polygons exist in 2D only",
                  "use a box or an intersection of half spaces");
  else if (!vertices.empty() && vertices.size() < 3)
    section.error("Vertices", "the polygon has " + std::to_string(vertices.size()) + " vertices",
                  "give at least 3, as in 0,0; 1,0; 1,1");
  else if (!vertices.empty() && Polygon::crosses_itself(vertices))
    section.error("Vertices", "the sides of the polygon cross or touch each other",
                  "list the corners in order along the boundary, each once");
}

template <int dim>
ShapePointer<dim>
make_polygon(const ShapeParameters<dim> &p)
{
  if constexpr (dim == 2)
    return std::make_unique<Polygon>(p.vertices("Vertices"));
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
          {{"Vertices", "Corners of % in order, as in 0,0; 1,0; 1,1", "[length]",
            std::vector<Point<2>>()}},
          make_polygon<dim>,
          check_polygon<dim>};
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
