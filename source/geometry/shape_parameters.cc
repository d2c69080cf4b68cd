#include <scree/base/expression.h>
#include <scree/geometry/composed_shapes.h>
#include <scree/geometry/simple_shapes.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
using Type = ShapeType;

// The entries that describe one type of shape; a type takes no others.
struct EntriesOfType
{
  Type                     type;
  std::vector<std::string> required;
  std::vector<std::string> optional;
};

const std::vector<EntriesOfType> &
entries_of_types()
{
  static const std::vector<EntriesOfType> table
    = {{Type::ball, {"Centre", "Radius"}, {}},
       {Type::box, {"Lower corner", "Upper corner"}, {}},
       {Type::half_space, {"Point", "Normal"}, {}},
       {Type::ellipse, {"Centre", "Semi-axes"}, {}},
       {Type::ring, {"Centre", "Inner radius", "Radius"}, {}},
       {Type::capsule, {"First point", "Second point", "Radius"}, {}},
       {Type::polygon, {"Vertices"}, {}},
       {Type::superellipse, {"Centre", "Semi-axes", "Exponent"}, {}},
       {Type::expression, {"Expression"}, {"Expression is distance"}},
       {Type::union_of, {"Parts"}, {}},
       {Type::intersection, {"Parts"}, {}},
       {Type::difference, {"Parts"}, {}}};
  return table;
}

const EntriesOfType &
entries_of(const Type type)
{
  return *std::find_if(entries_of_types().begin(), entries_of_types().end(),
                       [&](const EntriesOfType &entries) { return entries.type == type; });
}

bool
contains(const std::vector<std::string> &list, const std::string &word)
{
  return std::find(list.begin(), list.end(), word) != list.end();
}

// The entries with a value. (A file that was written back contains the others too, empty.)
template <int dim>
std::vector<std::string>
given_entries(const ShapeParameters<dim> &p)
{
  const std::vector<std::pair<std::string, bool>> table
    = {{"Centre", !p.centre.empty()},
       {"Radius", !std::isnan(p.radius)},
       {"Inner radius", !std::isnan(p.inner_radius)},
       {"Lower corner", !p.lower_corner.empty()},
       {"Upper corner", !p.upper_corner.empty()},
       {"Point", !p.point.empty()},
       {"Normal", !p.normal.empty()},
       {"Semi-axes", !p.semi_axes.empty()},
       {"Exponent", !std::isnan(p.exponent)},
       {"First point", !p.first_point.empty()},
       {"Second point", !p.second_point.empty()},
       {"Vertices", !p.vertices.empty()},
       {"Expression", !p.expression.empty()},
       {"Expression is distance", p.expression_is_distance},
       {"Parts", !p.parts.empty()}};
  std::vector<std::string> keys;
  for (const auto &[key, given] : table)
    if (given)
      keys.push_back(key);
  return keys;
}

// Records entries that are missing, and those of other types.
template <int dim>
void
check_entries(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const std::vector<std::string> given = given_entries(p);
  const EntriesOfType           &own   = entries_of(p.type);
  const std::string              name  = name_of(shape_type_names(), p.type);
  std::string                    list;
  for (const std::string &key : own.required)
    list += (list.empty() ? "" : ", ") + key;

  for (const std::string &key : own.required)
    if (!contains(given, key))
      section.error("Type", "Type = " + name + " needs the entry '" + key + "', which is not set",
                    "set " + list);
  for (const std::string &key : given)
    if (!contains(own.required, key) && !contains(own.optional, key))
      section.error(key, "'" + key + "' is not used by Type = " + name,
                    "remove it; the type takes " + list);
}

// Records a list that is given, but not with dim numbers.
template <int dim>
void
check_length(const ParameterSection &section, const std::string &key,
             const std::vector<double> &values)
{
  if (!values.empty() && values.size() != dim)
    section.error(key, "'" + key + "' has " + std::to_string(values.size()) + " number(s)",
                  "give " + std::to_string(dim) + " numbers, separated by commas");
}

// Records numbers that are zero or negative (NaN is unset).
void
check_positive(const ParameterSection &section, const std::string &key,
               const std::vector<double> &values)
{
  if (std::any_of(values.begin(), values.end(), [](const double value) { return value <= 0; }))
    section.error(key, "'" + key + "' must be greater than zero");
}

template <int dim>
void
declare_entries(ShapeParameters<dim> &p, const ParameterSection &section)
{
  section.entry("Type", p.type, shape_type_names(),
                "Kind of shape. disc (or ball), box, half space, ellipse (or ellipsoid), ring, "
                "capsule, polygon (2D), superellipse, expression; union, intersection and "
                "difference (the first without the others) of Parts.");
  section.entry("Centre", p.centre, "Centre of a disc, ellipse, ring or superellipse [length].");
  section.entry("Radius", p.radius,
                "Radius of a disc or capsule, outer radius of a ring [length].");
  section.entry("Inner radius", p.inner_radius, "Inner radius of a ring [length].");
  section.entry("Lower corner", p.lower_corner, "Lower corner of a box [length].");
  section.entry("Upper corner", p.upper_corner, "Upper corner of a box [length].");
  section.entry("Point", p.point, "A point on the surface of a half space [length].");
  section.entry("Normal", p.normal, "Outward normal of a half space, of any length.");
  section.entry("Semi-axes", p.semi_axes,
                "Half the widths of an ellipse or superellipse along x, y (and z) [length].");
  section.entry("Exponent", p.exponent,
                "Exponent n >= 1 of the superellipse |x/a|^n + |y/b|^n (+ |z/c|^n) < 1.");
  section.entry("First point", p.first_point, "One end of the axis of a capsule [length].");
  section.entry("Second point", p.second_point, "The other end of the axis of a capsule [length].");
  section.entry("Vertices", p.vertices,
                "Corners of a polygon in order, as in 0,0; 1,0; 1,1 [length].");
  section.entry("Expression", p.expression,
                "Formula of x, y (and z) that is negative inside; max() intersects, min() unites.");
  section.entry("Expression is distance", p.expression_is_distance,
                "Whether the formula is the signed distance, so that it is used as it is.");
  section.entry("Rotation angle", p.rotation_angle,
                "Turns the shape by this angle [degrees], counter-clockwise.");
  section.entry("Rotation centre", p.rotation_centre,
                "A point that the rotation leaves in place [length]; unset: the origin.");
  if constexpr (dim == 3)
    section.entry("Rotation axis", p.rotation_axis, "Axis of the rotation, of any length.");
  section.entry("Translation", p.translation, "Moves the shape after the rotation [length].");
}

template <int dim>
void
check_lengths(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  check_length<dim>(section, "Centre", p.centre);
  check_length<dim>(section, "Lower corner", p.lower_corner);
  check_length<dim>(section, "Upper corner", p.upper_corner);
  check_length<dim>(section, "Point", p.point);
  check_length<dim>(section, "Normal", p.normal);
  check_length<dim>(section, "Semi-axes", p.semi_axes);
  check_length<dim>(section, "First point", p.first_point);
  check_length<dim>(section, "Second point", p.second_point);
  check_length<dim>(section, "Rotation centre", p.rotation_centre);
  if (dim == 3)
    check_length<dim>(section, "Rotation axis", p.rotation_axis);
  check_length<dim>(section, "Translation", p.translation);
}

bool
is_zero(const std::vector<double> &values)
{
  return std::all_of(values.begin(), values.end(), [](const double value) { return value == 0; });
}

template <int dim>
void
check_values(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  check_positive(section, "Radius", {p.radius});
  check_positive(section, "Inner radius", {p.inner_radius});
  check_positive(section, "Semi-axes", p.semi_axes);
  if (p.inner_radius >= p.radius)
    section.error("Inner radius", "'Inner radius' is not less than 'Radius'");
  if (p.exponent < 1)
    section.error("Exponent", "'Exponent' must be at least 1");
  for (std::size_t d = 0; d < std::min(p.lower_corner.size(), p.upper_corner.size()); ++d)
    if (p.lower_corner[d] >= p.upper_corner[d])
      {
        section.error("Lower corner", "'Lower corner' is not below 'Upper corner'",
                      "every coordinate of the lower corner must be less");
        break;
      }
  if (!p.normal.empty() && is_zero(p.normal))
    section.error("Normal", "'Normal' is zero", "give the outward direction");
  if (dim == 3 && p.rotation_angle != 0 && is_zero(p.rotation_axis))
    section.error("Rotation angle", "a rotation needs a 'Rotation axis' that is not zero");
}

template <int dim>
void
check_polygon(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (dim == 3)
    section.error("Type", "polygons exist in 2D only",
                  "use a box or an intersection of half spaces");
  else if (!p.vertices.empty() && p.vertices.size() < 3)
    section.error("Vertices", "the polygon has " + std::to_string(p.vertices.size()) + " vertices",
                  "give at least 3, as in 0,0; 1,0; 1,1");
  else if (!p.vertices.empty() && Polygon::crosses_itself(p.vertices))
    section.error("Vertices", "the sides of the polygon cross or touch each other",
                  "list the corners in order along the boundary, each once");
}

template <int dim>
void
check_expression(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (p.expression.empty())
    return;
  check_expression<dim>(section, "Expression", p.expression, 1);
}

template <int dim>
Point<dim>
to_point(const std::vector<double> &values)
{
  AssertDimension(values.size(), dim);
  Point<dim> result;
  std::copy(values.begin(), values.end(), result.begin_raw());
  return result;
}

template <int dim>
ShapePointer<dim>
make_polygon(const std::vector<Point<2>> &vertices)
{
  if constexpr (dim == 2)
    return std::make_unique<Polygon>(vertices);
  else
    AssertThrow(false, ExcMessage("Polygons exist in 2D only."));
}

template <int dim>
ShapePointer<dim>
make_expression(const ShapeParameters<dim> &p)
{
  const std::vector<std::string> arguments = extremum_arguments(p.expression);
  std::vector<Expression<dim>>   pieces;
  for (std::size_t i = 0; arguments.size() > 1 && i < arguments.size(); ++i)
    pieces.emplace_back(arguments[i], 1, "Expression");
  return std::make_unique<ExpressionShape<dim>>(Expression<dim>(p.expression, 1, "Expression"),
                                                p.expression_is_distance, pieces);
}

template <int dim>
ShapePointer<dim>
make_unmoved_shape(const ShapeParameters<dim> &p)
{
  switch (p.type)
    {
    case Type::ball:
      return std::make_unique<Ball<dim>>(to_point<dim>(p.centre), p.radius);
    case Type::box:
      return std::make_unique<Box<dim>>(to_point<dim>(p.lower_corner),
                                        to_point<dim>(p.upper_corner));
    case Type::half_space:
      return std::make_unique<HalfSpace<dim>>(to_point<dim>(p.point), to_point<dim>(p.normal));
    case Type::ellipse:
      return std::make_unique<Ellipse<dim>>(to_point<dim>(p.centre), to_point<dim>(p.semi_axes));
    case Type::ring:
      return std::make_unique<Ring<dim>>(to_point<dim>(p.centre), p.inner_radius, p.radius);
    case Type::capsule:
      return std::make_unique<Capsule<dim>>(to_point<dim>(p.first_point),
                                            to_point<dim>(p.second_point), p.radius);
    case Type::polygon:
      return make_polygon<dim>(p.vertices);
    case Type::superellipse:
      return std::make_unique<Superellipse<dim>>(to_point<dim>(p.centre),
                                                 to_point<dim>(p.semi_axes), p.exponent);
    case Type::expression:
      return make_expression<dim>(p);
    default:
      break;
    }
  std::vector<ShapePointer<dim>> parts;
  for (const auto &part : p.parts)
    parts.push_back(make_shape(part.second));
  return std::make_unique<CombinedShape<dim>>(p.type, std::move(parts));
}

// The rotation by an angle in degrees; `axis` counts in 3D (Rodrigues' formula).
template <int dim>
Tensor<2, dim>
rotation_matrix(const double degrees, const std::vector<double> &axis)
{
  const double   angle = degrees * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
  Tensor<2, dim> result;
  if constexpr (dim == 2)
    {
      result[0][0] = result[1][1] = c;
      result[0][1]                = -s;
      result[1][0]                = s;
    }
  else
    {
      Tensor<1, 3> n = to_point<3>(axis);
      n /= n.norm();
      for (unsigned int i = 0; i < 3; ++i)
        {
          result[i][i] = c;
          for (unsigned int j = 0; j < 3; ++j)
            result[i][j] += (1 - c) * n[i] * n[j];
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          result[k][j] += s * n[i];
          result[j][k] -= s * n[i];
        }
    }
  return result;
}
} // namespace

template <int dim>
void
ShapeParameters<dim>::declare(const ParameterSection &section)
{
  declare_entries(*this, section);
  parts.clear();
  const bool combines
    = type == Type::union_of || type == Type::intersection || type == Type::difference;
  // The documentation shows one level of parts.
  const std::string path = section.path(), placeholder = "<name>";
  if (!section.is_documentation() || path.size() < placeholder.size()
      || path.substr(path.size() - placeholder.size()) != placeholder)
    for (const auto &[name, part_section] :
         section.named("Parts", "Names of the parts of a union, intersection or difference; each "
                                "is a subsection like this one."))
      {
        parts.emplace_back(name, ShapeParameters<dim>());
        parts.back().second.declare(part_section);
      }

  check_entries(*this, section);
  check_lengths(*this, section);
  check_values(*this, section);
  if (type == Type::polygon)
    check_polygon(*this, section);
  if (type == Type::expression)
    check_expression(*this, section);
  if (combines && parts.size() == 1)
    section.error("Parts", "a combination needs at least 2 parts", "as in set Parts = a, b");
}

template <int dim>
ShapePointer<dim>
make_shape(const ShapeParameters<dim> &parameters)
{
  const Point<dim> centre
    = parameters.rotation_centre.empty() ? Point<dim>() : to_point<dim>(parameters.rotation_centre);
  const Point<dim> translation
    = parameters.translation.empty() ? Point<dim>() : to_point<dim>(parameters.translation);
  ShapePointer<dim> shape = make_unmoved_shape(parameters);
  if (parameters.rotation_angle == 0)
    {
      if (translation == Point<dim>())
        return shape;
      return std::make_unique<MovedShape<dim>>(std::move(shape), unit_symmetric_tensor<dim>(),
                                               centre, translation);
    }
  return std::make_unique<MovedShape<dim>>(
    std::move(shape), rotation_matrix<dim>(parameters.rotation_angle, parameters.rotation_axis),
    centre, translation);
}

template struct ShapeParameters<2>;
template struct ShapeParameters<3>;
template ShapePointer<2> make_shape(const ShapeParameters<2> &);
template ShapePointer<3> make_shape(const ShapeParameters<3> &);
} // namespace scree
