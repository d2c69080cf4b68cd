#include <scree/base/log.h>
#include <scree/bodies/packing_family.h>
#include <scree/geometry/random_packing.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
/** The types of shapes, the default first. */
template <int dim>
std::vector<std::pair<std::string, RandomShapeType>>
packed_types()
{
  if constexpr (dim == 2)
    return {{"disc", RandomShapeType::ball},
            {"ellipse", RandomShapeType::ellipsoid},
            {"superellipse", RandomShapeType::superellipsoid},
            {"regular polygon", RandomShapeType::regular_polygon},
            {"random polygon", RandomShapeType::random_polygon}};
  else
    return {{"ball", RandomShapeType::ball},
            {"ellipsoid", RandomShapeType::ellipsoid},
            {"superellipse", RandomShapeType::superellipsoid}};
}

/** Section Packing of a family. */
template <int dim>
class PackingEntries
{
public:
  explicit PackingEntries(const ParameterSection &section)
      : section(section)
  {
  }

  /** Whether there is no problem. */
  bool declare();

  PackingParameters<dim> packing;
  double                 growth = 1.;

private:
  void declare_container();
  void declare_shapes();
  void declare_density();

  void error(const std::string &key, const std::string &what, const std::string &remedy)
  {
    section.error(key, what, remedy);
    is_right = false;
  }

  /** Records an entry that is set although the type has no use for it. */
  void refuse_unless(const bool is_used, const std::string &key)
  {
    if (!is_used && section.is_set(key) && !section.is_wrong("Type"))
      error(key, "'" + key + "' is not used by Type = " + type,
            "remove it, or choose another type");
  }

  /** One number, or the ends of a range. */
  template <typename T>
  std::vector<T> range(const std::string &key, const T least, const T most,
                       const std::vector<T> &unset, const std::string &documentation);

  const ParameterSection &section;
  std::string             type;
  bool                    is_right = true;
};

template <int dim>
template <typename T>
std::vector<T>
PackingEntries<dim>::range(const std::string &key, const T least, const T most,
                           const std::vector<T> &unset, const std::string &documentation)
{
  std::vector<T> given;
  section.entry(key, given, documentation);
  if (given.empty())
    return unset;
  const bool is_range = given.size() <= 2 && given.front() <= given.back() && given.front() >= least
                        && given.back() <= most;
  if (!is_range)
    error(key,
          "'" + key + "' is no number or range within " + short_number(least) + " and "
            + short_number(most),
          "give one number, or the least and the largest, separated by a comma");
  return {given.front(), given.back()};
}

template <int dim>
void
PackingEntries<dim>::declare_container()
{
  const std::string container = section.choice(
    "Container", "box", {"box", "cylinder"},
    "What they fill: the box between the corners, or the cylinder along z in it, in 2D a disc.");
  packing.in_cylinder = container == "cylinder";
  Point<dim> lower, upper;
  section.entry("Lower corner", lower, "Lower corner of the box [L].");
  section.entry("Upper corner", upper, "Upper corner of the box [L].");
  bool has_volume = true;
  for (unsigned int d = 0; d < dim; ++d)
    has_volume = has_volume && lower[d] < upper[d];
  if (!has_volume)
    return error("Upper corner", "is not above Lower corner", "give the corners of a box");
  packing.box              = BoundingBox<dim>({lower, upper});
  const double     width   = packing.box.side_length(0);
  constexpr double digits  = 1e-10;
  const bool       is_even = std::abs(packing.box.side_length(1) - width) < digits * width;
  if (packing.in_cylinder && !is_even)
    error("Upper corner",
          "the box around the cylinder is " + short_number(width) + " wide along x, "
            + short_number(packing.box.side_length(1)) + " along y",
          "give corners of a square");
}

template <int dim>
void
PackingEntries<dim>::declare_shapes()
{
  std::vector<std::string> names;
  for (const auto &known : packed_types<dim>())
    names.push_back(known.first);
  type                      = section.choice("Type", names[0], names,
                        dim == 2 ? "Kind of shapes. Random polygons have corners at random angles "
                                                        "on a circle, which Aspect ratio stretches."
                                                      : "Kind of shapes.");
  RandomShapes<dim> &shapes = packing.shapes;
  for (const auto &[name, value] : packed_types<dim>())
    if (name == type)
      shapes.type = value;
  const bool is_ball    = shapes.type == RandomShapeType::ball;
  const bool is_polygon = shapes.type == RandomShapeType::regular_polygon
                          || shapes.type == RandomShapeType::random_polygon;
  section.entry("Size ratio", shapes.size_ratio, dealii::Patterns::Double(1., 20.),
                "Largest radius over smallest one; those between are equally frequent. The radius "
                "of what is not round is that of a disc or ball of the same area or volume.");
  constexpr double most_aspect = 10.;
  shapes.aspect                = range<double>("Aspect ratio", 1., most_aspect, {1., 1.},
                                dim == 2 ? "Length over width, or a range of it, as 1.2, 1.8; "
                                                          "those between are equally frequent."
                                                        : "First semi-axis over second, or a range of it, as 1.2, "
                                                          "1.8; those between are equally frequent.");
  refuse_unless(!is_ball, "Aspect ratio");
  if (dim == 3)
    {
      shapes.second_aspect = range<double>("Second aspect ratio", 1., most_aspect, {1., 1.},
                                           "Second semi-axis over third, or a range of it.");
      refuse_unless(!is_ball, "Second aspect ratio");
    }
  if (shapes.type == RandomShapeType::ellipsoid && !section.is_set("Aspect ratio")
      && !section.is_wrong("Type") && !(dim == 3 && section.is_set("Second aspect ratio")))
    error("Aspect ratio", "is needed by Type = " + type,
          "give a number or a range, as 1.2, 1.8; or set Type = " + names[0]);
  section.entry("Exponent", shapes.exponent, dealii::Patterns::Double(1., 20.),
                "Exponent n of superellipses, see section Shape.");
  refuse_unless(shapes.type == RandomShapeType::superellipsoid, "Exponent");
  if (dim == 2)
    {
      shapes.corners = range<unsigned int>("Corners", 3, 100, {6, 6},
                                           "Number of corners of polygons, or a range of it, as "
                                           "4, 8; none: 6.");
      refuse_unless(is_polygon, "Corners");
      section.entry("Rounding", shapes.rounding, dealii::Patterns::Double(0., 0.9),
                    "Radius of the corners of polygons over the radius of the polygon.");
      refuse_unless(is_polygon, "Rounding");
    }
}

template <int dim>
void
PackingEntries<dim>::declare_density()
{
  double fraction = std::numeric_limits<double>::quiet_NaN();
  section.entry("Solid fraction", fraction, dealii::Patterns::Double(0.01, 0.99),
                "Part of the container that they fill, without overlap; none: they grow until "
                "they jam.");
  section.entry("Growth", growth, dealii::Patterns::Double(0.01, 1.1),
                "Factor of the sizes with which they touch: 1 is a dense packing, less a loose "
                "one, with more they overlap.");
  if (!std::isnan(fraction))
    packing.solid_fraction = fraction;
  if (packing.solid_fraction && section.is_set("Growth"))
    error("Growth", "changes the Solid fraction that is given", "remove one of them");
  unsigned int seed = 1;
  section.entry("Seed", seed, "Another number is another packing.");
  packing.seed = seed;
}

template <int dim>
bool
PackingEntries<dim>::declare()
{
  section.entry("Number", packing.n, dealii::Patterns::Integer(0, most_members),
                "Number of bodies.");
  if (packing.n == 0)
    error("Number", "is needed", "give a number of bodies");
  declare_shapes();
  declare_container();
  declare_density();
  return is_right;
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_packing(const ParameterSection &section, const ShapeParameters<dim> & /*shape*/)
{
  PackingEntries<dim> entries(section);
  if (!entries.declare())
    return {};
  const RandomPacking<dim> packing = pack_at_random(entries.packing);
  const auto              &wanted  = entries.packing.solid_fraction;
  if (wanted && packing.solid_fraction < *wanted * (1. - 1e-10))
    section.error(
      "Solid fraction", "is not reached: the bodies jam at " + short_number(packing.solid_fraction),
      "give less, choose other shapes or another seed, or more bodies, which leave less "
      "room at walls");
  std::vector<FamilyMember<dim>> members;
  for (const auto &[centre, rotation, shape] : packing.members)
    members.push_back(member_of_shape(member_name(members.size() + 1),
                                      shape->scaled(entries.growth)->placed(centre, rotation)));
  return members;
}
} // namespace

template <int dim>
FamilyKind<dim>
packing_family()
{
  return {"packing", "Packing", "A random packing of convex shapes in a box or cylinder.", false,
          declare_packing<dim>};
}

template FamilyKind<2> packing_family();
template FamilyKind<3> packing_family();
} // namespace scree
