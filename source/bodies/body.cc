#include <scree/base/exceptions.h>
#include <scree/bodies/body.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/parameters/expression_entry.h>

#include <deal.II/boost_adaptors/bounding_box.h>

#include <algorithm>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <sstream>

namespace scree
{
template <int dim>
void
BodyParameters<dim>::declare(ParameterSection &section)
{
  path = section.path();
  section.entry("Material", material, "Name of the material, of section Materials.");
  section.entry("Body force", body_force,
                "Force per volume, expressions of x, y, z, t separated by ';' [force/L^3].");
  ParameterSection shape_section = section.subsection("Shape", "The body's shape.");
  shape.declare(shape_section);
  ParameterSection condition_section
    = section.subsection("Boundary conditions", "What acts on the surface of the body.");
  for (auto &[condition_name, subsection] :
       condition_section.named("Names", "Names of the boundary conditions of this body."))
    {
      conditions.emplace_back(condition_name, BoundaryConditionParameters<dim>());
      conditions.back().second.declare(subsection);
    }
  check_expression<dim>(section, "Body force", body_force, dim);
}

template <int dim>
std::vector<BodyParameters<dim>>
declare_bodies(ParameterSection &section, const std::vector<std::string> &material_names)
{
  std::vector<BodyParameters<dim>> bodies;
  for (auto &[name, subsection] : section.named("Names", "Names of the bodies."))
    {
      bodies.emplace_back();
      bodies.back().name = name;
      bodies.back().declare(subsection);
      const std::string &material = bodies.back().material;
      std::string        known;
      for (const auto &candidate : material_names)
        known += (known.empty() ? "" : ", ") + candidate;
      if (material.empty())
        subsection.error("Material", "no material is given", "one of: " + known);
      else if (std::find(material_names.begin(), material_names.end(), material)
               == material_names.end())
        subsection.error("Material", "there is no material '" + material + "'", "one of: " + known);
    }
  return bodies;
}

template <int dim>
std::vector<Body<dim>>
make_bodies(const std::vector<BodyParameters<dim>>                            &parameters,
            const std::map<std::string, std::shared_ptr<const Material<dim>>> &materials,
            const LatticeFrame<dim> &frame, const double margin)
{
  std::vector<Body<dim>> bodies;
  for (const auto &body : parameters)
    {
      const ShapePointer<dim>        shape     = make_shape<dim>(body.shape);
      const dealii::BoundingBox<dim> shape_box = shape->bounding_box();
      dealii::Point<dim>             lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::max(shape_box.lower_bound(d), frame.box.lower_bound(d));
          upper[d] = std::min(shape_box.upper_bound(d), frame.box.upper_bound(d));
          require(lower[d] < upper[d], body.path,
                  "the body '" + body.name + "' lies outside the background box",
                  "move the body or enlarge Grid/Lower corner, Upper corner");
        }
      Lattice<dim> level_set = make_lattice(*shape, frame, margin, body.path + "/Shape");
      for (std::size_t i = 0; i < level_set.values().size(); ++i)
        if (!std::isfinite(level_set.values()[i]))
          {
            std::ostringstream where;
            where << level_set.node(level_set.index(i));
            throw UserError(body.path + "/Shape",
                            "the level set is no finite number at the point " + where.str(),
                            "check divisions, roots and logarithms of the expression");
          }
      std::vector<BoundaryCondition<dim>> conditions;
      for (const auto &[name, condition] : body.conditions)
        conditions.emplace_back(name, body.path + "/Boundary conditions/" + name, condition);
      bodies.push_back(
        Body<dim>{body.name, body.path, level_set, dealii::BoundingBox<dim>({lower, upper}),
                  materials.at(body.material),
                  Expression<dim>(body.body_force, dim, body.path + "/Body force"), conditions});
    }
  return bodies;
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
candidate_pairs(const std::vector<Body<dim>> &bodies, const double reach)
{
  namespace bgi = boost::geometry::index;
  using Entry   = std::pair<dealii::BoundingBox<dim>, unsigned int>;
  std::vector<Entry> entries;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    entries.emplace_back(bodies[b].box, b);
  const bgi::rtree<Entry, bgi::linear<16>>           tree(entries);
  std::vector<std::pair<unsigned int, unsigned int>> pairs;
  for (const auto &[box, a] : entries)
    {
      dealii::BoundingBox<dim> enlarged(box);
      enlarged.extend(reach);
      std::vector<Entry> found;
      tree.query(bgi::intersects(enlarged), std::back_inserter(found));
      for (const auto &entry : found)
        if (a < entry.second)
          pairs.emplace_back(a, entry.second);
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template struct BodyParameters<dim>;                                                        \
  template struct Body<dim>;                                                                  \
  template std::vector<BodyParameters<dim>> declare_bodies(ParameterSection &,                \
                                                           const std::vector<std::string> &); \
  template std::vector<Body<dim>>           make_bodies(                                      \
              const std::vector<BodyParameters<dim>> &,                                       \
              const std::map<std::string, std::shared_ptr<const Material<dim>>> &,            \
              const LatticeFrame<dim> &, const double);                                       \
  template std::vector<std::pair<unsigned int, unsigned int>> candidate_pairs(                \
    const std::vector<Body<dim>> &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
