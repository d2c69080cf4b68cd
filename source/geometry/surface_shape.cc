#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/base/text_file.h>
#include <scree/geometry/surface_shape.h>
#include <scree/parameters/data_file.h>

#include <cmath>
#include <cstdlib>

namespace scree
{
using namespace dealii;

SurfaceShape::SurfaceShape(std::shared_ptr<const ClosedSurface> surface)
    : surface(std::move(surface))
{
}

double
SurfaceShape::signed_distance(const Point<3> &x) const
{
  return surface->signed_distance(x);
}

std::optional<Tensor<1, 3>>
SurfaceShape::exact_gradient(const Point<3> &x, const double near) const
{
  return surface->gradient(x, near);
}

BoundingBox<3>
SurfaceShape::bounding_box() const
{
  return surface->bounding_box();
}

OutlineShape::OutlineShape(const std::vector<Point<2>> &vertices)
    : sides(vertices)
    , box(vertices)
{
}

double
OutlineShape::signed_distance(const Point<2> &x) const
{
  return sides.signed_distance(x);
}

BoundingBox<2>
OutlineShape::bounding_box() const
{
  return box;
}

namespace
{
constexpr std::size_t largest_surface_file = 256000000; // bytes

std::string
surface_bytes(const std::string &file)
{
  return read_bytes(file, largest_surface_file, file, "check the path", "triangles");
}

/** The surface of the bytes of a file, in units of length. */
template <int dim>
std::shared_ptr<const ClosedSurface>
surface_of(const ShapeParameters<dim> &p, const std::string &bytes)
{
  const std::string &file  = p.text("File");
  TriangleSoup       soup  = TriangleSoup::read(bytes, file);
  const double       scale = p.number("Scale");
  for (Point<3> &x : soup.points)
    if (!std::isnan(scale))
      x *= scale;
  return std::make_shared<const ClosedSurface>(soup, file);
}

/** The plane "y = 0.5": its axis and position; nothing if the text is no such. */
std::pair<unsigned int, double>
plane_of(const std::string &text)
{
  std::string short_text;
  for (const char c : text)
    if (c != ' ')
      short_text += c;
  char        *end      = nullptr;
  const double position = short_text.size() > 2 ? std::strtod(short_text.c_str() + 2, &end) : 0.;
  require(end != nullptr && end != short_text.c_str() + 2 && *end == '\0' && std::isfinite(position)
            && short_text[0] >= 'x' && short_text[0] <= 'z' && short_text[1] == '=',
          "Section plane", "'" + text + "' is no plane", "write it as z = 0.5");
  return {short_text[0] - 'x', position};
}

/** The only outline of a section. */
template <int dim>
std::vector<Point<2>>
outline(const ShapeParameters<dim> &p, const ClosedSurface &surface)
{
  const std::string &text     = p.text("Section plane");
  const auto [axis, position] = plane_of(text);
  const auto        outlines  = surface.section(axis, position);
  const auto       &box       = surface.bounding_box();
  const std::string remedy    = "the surface lies between " + short_number(box.lower_bound(axis))
                             + " and " + short_number(box.upper_bound(axis)) + " there";
  require(!outlines.empty(), "Section plane", text + " does not cut the surface", remedy);
  require(outlines.size() == 1, "Section plane",
          text + " cuts the surface in " + std::to_string(outlines.size()) + " outlines",
          "choose another plane: " + remedy);
  return outlines[0];
}

template <int dim>
ShapePointer<dim>
shape_of(const ShapeParameters<dim> &p, const std::string &bytes)
{
  const auto surface = surface_of(p, bytes);
  if constexpr (dim == 2)
    return std::make_unique<OutlineShape>(outline(p, *surface));
  else
    return std::make_unique<SurfaceShape>(surface);
}

template <int dim>
ShapePointer<dim>
make_surface(const ShapeParameters<dim> &p)
{
  return shape_of(p, surface_bytes(p.text("File")));
}

template <int dim>
void
check_surface(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const std::string &file = p.text("File");
  if (file.empty() || (dim == 2 && p.text("Section plane").empty()))
    return;
  try
    {
      const std::string bytes = surface_bytes(file);
      if (declare_checksum(section, file, bytes))
        shape_of(p, bytes);
    }
  catch (const UserError &error)
    {
      section.error("File", error.what());
    }
}
} // namespace

template <int dim>
ShapeFamily<dim>
surface_family()
{
  ShapeFamily<dim> family{{"surface"},
                          dim == 2 ? "surface (3D, or a plane section of it in 2D)" : "surface",
                          {{"File", "File of a closed surface of triangles: STL, OBJ or PLY", "",
                            std::string(), false, true, true},
                           checksum_entry(),
                           scale_of_file()},
                          make_surface<dim>,
                          check_surface<dim>};
  if (dim == 2)
    family.entries.push_back(
      {"Section plane",
       "Plane that cuts the surface, as z = 0.5, with x and y of the file as "
       "x and y, or x = 0.5 with y and z",
       "", std::string()});
  return family;
}

template ShapeFamily<2> surface_family();
template ShapeFamily<3> surface_family();
} // namespace scree
