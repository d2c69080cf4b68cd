#include <scree/base/log.h>
#include <scree/bodies/packing_family.h>
#include <scree/geometry/ball.h>
#include <scree/geometry/ball_packing.h>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
FamilyMember<dim>
member_of(const std::string &name, const Point<dim> &centre, const double radius)
{
  ListRow row = {{"Name", name}, {"Type", dim == 2 ? "disc" : "ball"}};
  for (unsigned int d = 0; d < dim; ++d)
    row.emplace_back(std::string("Centre ") + "xyz"[d], exact_number(centre[d]));
  row.emplace_back("Radius", exact_number(radius));
  return {
    name,
    [centre, radius]() -> ShapePointer<dim> { return std::make_unique<Ball<dim>>(centre, radius); },
    "", row};
}

/** Section Packing of a family. */
template <int dim>
struct PackingEntries
{
  unsigned int n = 0, seed = 1;
  Point<dim>   lower, upper;
  double       size_ratio = 1., growth = 1.;

  /** Whether there is no problem. */
  bool declare(const ParameterSection &section);
};

template <int dim>
bool
PackingEntries<dim>::declare(const ParameterSection &section)
{
  section.entry("Number", n, dealii::Patterns::Integer(0, most_members),
                "Number of discs or balls.");
  section.entry("Lower corner", lower, "Lower corner of the box that they fill [L].");
  section.entry("Upper corner", upper, "Upper corner of the box [L].");
  section.entry("Size ratio", size_ratio, dealii::Patterns::Double(1., 20.),
                "Largest radius over smallest one; those between are equally frequent.");
  section.entry("Growth", growth, dealii::Patterns::Double(0.01, 1.),
                "Part of the radii with which they touch: 1 is a dense packing, less a loose one.");
  section.entry("Seed", seed, "Another number is another packing.");
  if (n == 0)
    section.error("Number", "is needed", "give a number of bodies");
  bool has_volume = true;
  for (unsigned int d = 0; d < dim; ++d)
    has_volume = has_volume && lower[d] < upper[d];
  if (!has_volume)
    section.error("Upper corner", "is not above Lower corner", "give the corners of a box");
  return n > 0 && has_volume;
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_packing(const ParameterSection &section, const ShapeParameters<dim> & /*shape*/)
{
  PackingEntries<dim> p;
  if (!p.declare(section))
    return {};
  std::vector<FamilyMember<dim>> members;
  for (const auto &ball : pack_balls<dim>({p.n, {{p.lower, p.upper}}, p.size_ratio, p.seed}))
    members.push_back(
      member_of<dim>(member_name(members.size() + 1), ball.centre, p.growth * ball.radius));
  return members;
}
} // namespace

template <int dim>
FamilyKind<dim>
packing_family()
{
  return {"packing", "Packing", "A random packing of discs (2D) or balls in a box.", false,
          declare_packing<dim>};
}

template FamilyKind<2> packing_family();
template FamilyKind<3> packing_family();
} // namespace scree
