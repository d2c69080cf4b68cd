#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/bodies/body.h>
#include <scree/geometry/distance_claim.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace scree
{
template <int dim>
std::optional<std::vector<FamilyMember<dim>>>
BodyParameters<dim>::declare(ParameterSection &section)
{
  path = section.path();
  section.entry("Material", material, "Name of the material, of section Materials.");
  const FamilyKind<dim> *family = declare_family_kind<dim>(section);
  section.formula("Body force", body_force,
                  "Force per volume, expressions of x, y, z, t separated by ';' [force/L^3].");
  section.entry("Initial velocity", initial_velocity,
                "At t = 0, of runs with inertia: expressions of x, y, z separated by ';' "
                "[L/time].");
  section.entry("Initial spin", initial_spin,
                "Adds a rotation about the centre of mass, counter-clockwise; three components in "
                "3D [rad/time].");
  if (!initial_spin.empty() && initial_spin.size() != (dim == 2 ? 1 : 3))
    section.error("Initial spin", dim == 2 ? "must be one number" : "needs three components");
  ParameterSection shape_section = section.subsection("Shape", "The body's shape.");
  shape.declare(shape_section,
                family == nullptr || family->takes_shape ? "" : "Family = " + family->name);
  ParameterSection condition_section
    = section.subsection("Boundary conditions", "What acts on the surface of the body.");
  for (auto &[condition_name, subsection] :
       condition_section.named("Names", "Names of the boundary conditions of this body."))
    {
      BoundaryConditionParameters<dim> condition;
      const auto                       places = condition.declare(subsection);
      for (const std::string &place : places)
        {
          condition.on = place;
          conditions.emplace_back(
            places.size() == 1 ? condition_name : condition_name + "." + place, condition);
        }
    }
  check_expression<dim>(section, "Body force", body_force, dim);
  check_expression<dim>(section, "Initial velocity", initial_velocity, dim);
  ParameterSection motion_section
    = section.subsection("Motion", "How a rigid body moves. Components without a line stay.");
  motion.declare(motion_section);
  return declare_members(section, family, shape);
}

namespace
{
/** The material of a body: its density, or what is wrong with its name. */
template <int dim>
void
set_material(const std::map<std::string, MaterialParameters> &materials,
             const ParameterSection &section, BodyParameters<dim> &body)
{
  std::vector<std::string> known;
  known.reserve(materials.size());
  for (const auto &candidate : materials)
    known.push_back(candidate.first);
  if (body.material.empty())
    section.error("Material", "no material is given", "one of: " + listed(known));
  else if (const auto found = materials.find(body.material); found != materials.end())
    body.density = found->second.density;
  else
    section.error("Material", "there is no material '" + body.material + "'",
                  "one of: " + listed(known));
}

/** A body of the family that `family` describes. */
template <int dim>
BodyParameters<dim>
body_of(const BodyParameters<dim> &family, const FamilyMember<dim> &member)
{
  BodyParameters<dim> body = family;
  body.name += "-" + member.name;
  body.path += " (" + body.name + ")";
  body.shape_of_member = member.make_shape;
  body.family          = family.name;
  body.listed_shape    = member.listed_shape;
  if (!member.material.empty())
    body.material = member.material;
  return body;
}

/** Records bodies of the same name: a body may have that of a family's. */
template <int dim>
void
check_names(const std::vector<BodyParameters<dim>> &bodies, const ParameterSection &section)
{
  std::set<std::string> names;
  for (const auto &body : bodies)
    if (!names.insert(body.name).second)
      section.error("Names", "two bodies are called '" + body.name + "'",
                    "give the body, or the family, another name");
}
} // namespace

template <int dim>
std::vector<BodyParameters<dim>>
declare_bodies(ParameterSection                                &section,
               const std::map<std::string, MaterialParameters> &materials)
{
  std::vector<BodyParameters<dim>> bodies;
  std::string                      gravity = BodyParameters<dim>().gravity;
  section.formula("Gravity", gravity,
                  "Acceleration that acts on the mass of all bodies, expressions of t separated by "
                  "';' [L/time^2].");
  check_expression<dim>(section, "Gravity", gravity, dim);
  for (auto &[name, subsection] : section.named("Names", "Names of the bodies."))
    {
      BodyParameters<dim> body;
      body.name          = name;
      body.gravity       = gravity;
      const auto members = body.declare(subsection);
      set_material(materials, subsection, body);
      if (!members)
        bodies.push_back(body);
      else
        for (const auto &member : *members)
          {
            bodies.push_back(body_of(body, member));
            if (!member.material.empty())
              set_material(materials, subsection, bodies.back());
          }
    }
  check_names(bodies, section);
  return bodies;
}

namespace
{
/** The part of `shape` inside `box`. @throws UserError if there is none */
template <int dim>
dealii::BoundingBox<dim>
clipped(const dealii::BoundingBox<dim> &shape, const dealii::BoundingBox<dim> &box,
        const BodyParameters<dim> &body)
{
  dealii::Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::max(shape.lower_bound(d), box.lower_bound(d));
      upper[d] = std::min(shape.upper_bound(d), box.upper_bound(d));
      require(lower[d] < upper[d], body.path,
              "the body '" + body.name + "' lies outside the background box",
              "move the body or enlarge Grid/Lower corner, Upper corner");
    }
  return dealii::BoundingBox<dim>({lower, upper});
}

template <int dim>
void
check_use(const BodyParameters<dim> &body, const bool is_rigid)
{
  const auto &load = body.motion.load;
  require(body.density > 0. || body.gravity == BodyParameters<dim>().gravity
            || (is_rigid
                && std::all_of(load.begin(), load.end(),
                               [](const std::string &formula) { return formula.empty(); })),
          body.path, "gravity acts on the body '" + body.name + "', which has no mass",
          "set Density in the section of its material, or remove Bodies/Gravity");
  if (!is_rigid)
    {
      require(!body.motion.is_given, body.path + "/Motion", "the body is not rigid",
              "remove the section, or give the body a material with Law = rigid");
      return;
    }
  require(body.conditions.empty(), body.path + "/Boundary conditions",
          "a rigid body has no boundary conditions", "prescribe its motion in section Motion");
  require(body.body_force == BodyParameters<dim>().body_force, body.path + "/Body force",
          "a rigid body has no volume to act on",
          "set Bodies/Gravity and the Density of its material, or "
          "give its weight as a force in section Motion");
}

/** The motion of a rigid body, with a coarse lattice of its whole shape for pictures. */
template <int dim>
std::shared_ptr<const RigidBody<dim>>
make_rigid_body(const BodyParameters<dim> &body, const std::shared_ptr<const Shape<dim>> &shape,
                const dealii::BoundingBox<dim> &clipped_box)
{
  constexpr unsigned int         cells_of_picture = dim == 2 ? 80 : 32;
  const dealii::BoundingBox<dim> whole            = shape->bounding_box();
  // Unbounded directions end where the body is clipped.
  constexpr double   far = 0.01 * Shape<dim>::unbounded;
  dealii::Point<dim> lower, upper;
  double             size = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = whole.lower_bound(d) > -far ? whole.lower_bound(d) : clipped_box.lower_bound(d);
      upper[d] = whole.upper_bound(d) < far ? whole.upper_bound(d) : clipped_box.upper_bound(d);
      size     = std::max(size, upper[d] - lower[d]);
    }
  const dealii::BoundingBox<dim> box({lower, upper});
  const double                   spacing = size / cells_of_picture;
  typename Lattice<dim>::Index   first, n_nodes;
  for (unsigned int d = 0; d < dim; ++d)
    {
      first[d]   = -1;
      n_nodes[d] = static_cast<int>(std::ceil((upper[d] - lower[d]) / spacing)) + 3;
    }
  Lattice<dim> picture({lower, spacing, box}, first, n_nodes);
  for (std::size_t i = 0; i < picture.values().size(); ++i)
    picture.values()[i] = shape->signed_distance(picture.node(picture.index(i)));
  return std::make_shared<RigidBody<dim>>(body.motion, box, picture, shape, body.density);
}

template <int dim>
dealii::Tensor<1, 3>
initial_spin(const BodyParameters<dim> &body)
{
  dealii::Tensor<1, 3> result;
  for (unsigned int i = 0; i < body.initial_spin.size(); ++i)
    result[dim == 2 ? 2 : i] = body.initial_spin[i];
  return result;
}
} // namespace

template <int dim>
dealii::Point<dim>
initial_position(const Body<dim> &body, const dealii::Point<dim> &x)
{
  if (body.is_rigid())
    return body.pose.initial_position(x);
  return body.displacement.is_empty() ? x : dealii::Point<dim>(x - body.displacement(x));
}

template <int dim>
dealii::Tensor<2, dim>
initial_gradient(const Body<dim> &body, const dealii::Point<dim> &x)
{
  if (body.is_rigid())
    return body.pose.initial_gradient();
  dealii::Tensor<2, dim> result = dealii::unit_symmetric_tensor<dim>();
  if (body.displacement.is_empty())
    return result;
  const double spacing = body.level_set.spacing();
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = x, after = x;
      before[d] -= 0.5 * spacing;
      after[d] += 0.5 * spacing;
      const dealii::Tensor<1, dim> slope
        = (body.displacement(after) - body.displacement(before)) / spacing;
      for (unsigned int i = 0; i < dim; ++i)
        result[i][d] -= slope[i];
    }
  return result;
}

template <int dim>
std::pair<double, dealii::Tensor<1, dim>>
value_and_gradient(const Body<dim> &body, const SmoothPiece<dim> &piece,
                   const dealii::Point<dim> &x)
{
  const dealii::Point<dim> X = initial_position(body, x);
  return {piece.value(X),
          piece.gradient(X, 1e-4 * body.level_set.spacing()) * initial_gradient(body, x)};
}

template <int dim>
std::vector<Body<dim>>
make_bodies(const std::vector<BodyParameters<dim>>                            &parameters,
            const std::map<std::string, std::shared_ptr<const Material<dim>>> &materials,
            const LatticeFrame<dim> &frame, const double margin, const bool is_moving)
{
  LatticeFrame<dim> wide_frame = frame;
  wide_frame.box.extend(margin);
  std::vector<Body<dim>> bodies;
  for (const auto &body : parameters)
    {
      const auto &material = materials.at(body.material);
      const bool  is_rigid = material == nullptr;
      check_use(body, is_rigid);
      const std::shared_ptr<const Shape<dim>> shape
        = body.shape_of_member ? body.shape_of_member() : make_shape<dim>(body.shape);
      const LatticeFrame<dim>       &body_frame = is_rigid ? wide_frame : frame;
      const dealii::BoundingBox<dim> box = clipped(shape->bounding_box(), body_frame.box, body);
      if (shape->is_claimed_distance())
        require_distance(*shape, frame.spacing, box, body.path + "/Shape");
      std::vector<BoundaryCondition<dim>> conditions;
      for (const auto &[name, condition] : body.conditions)
        conditions.emplace_back(name, body.path + "/Boundary conditions/" + name, condition);
      const double most_nodes
        = is_moving && !is_rigid ? largest_dense_lattice : largest_cheap_lattice;
      const BodyDefinition<dim> definition{
        body.name,
        body.path,
        material,
        is_rigid ? make_rigid_body(body, shape, box) : nullptr,
        Expression<dim>(body.body_force, dim, body.path + "/Body force"),
        conditions,
        body.density,
        Expression<dim>(body.gravity, dim, "Bodies/Gravity"),
        Expression<dim>(body.initial_velocity, dim, body.path + "/Initial velocity"),
        initial_spin(body)};
      bodies.emplace_back(
        definition,
        BodyGeometry<dim>{make_lattice(shape, body_frame, margin, body.path + "/Shape", most_nodes),
                          box});
      bodies.back().shape = shape;
      if (is_rigid)
        bodies.back().pose = RigidPose<dim>(*bodies.back().rigid, {});
    }
  return bodies;
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template struct BodyParameters<dim>;                                                             \
  template struct Body<dim>;                                                                       \
  template dealii::Point<dim>     initial_position(const Body<dim> &, const dealii::Point<dim> &); \
  template dealii::Tensor<2, dim> initial_gradient(const Body<dim> &, const dealii::Point<dim> &); \
  template std::pair<double, dealii::Tensor<1, dim>> value_and_gradient(                           \
    const Body<dim> &, const SmoothPiece<dim> &, const dealii::Point<dim> &);                      \
  template std::vector<BodyParameters<dim>> declare_bodies(                                        \
    ParameterSection &, const std::map<std::string, MaterialParameters> &);                        \
  template std::vector<Body<dim>> make_bodies(                                                     \
    const std::vector<BodyParameters<dim>> &,                                                      \
    const std::map<std::string, std::shared_ptr<const Material<dim>>> &,                           \
    const LatticeFrame<dim> &, const double, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
