#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace scree
{
const EnumNames<DisplacementMethod> displacement_method_names
  = {{DisplacementMethod::automatic, "automatic"},
     {DisplacementMethod::nitsche, "nitsche"},
     {DisplacementMethod::nonsymmetric_nitsche, "nonsymmetric nitsche"},
     {DisplacementMethod::penalty, "penalty"}};

namespace
{
const std::vector<std::string> axes = {"x", "y", "z"};

/** The faces of the box in deal.II's order, then the cut surface. */
template <int dim>
std::vector<std::string>
region_names()
{
  std::vector<std::string> names;
  for (unsigned int d = 0; d < dim; ++d)
    for (const char sign : {'-', '+'})
      names.push_back(axes[d] + sign);
  names.push_back("surface");
  return names;
}

std::string
joined(const std::vector<std::string> &names, const std::string &separator)
{
  std::string text;
  for (const auto &name : names)
    text += (text.empty() ? "" : separator) + name;
  return text;
}

/** How many expressions the value of a condition consists of. */
template <int dim>
unsigned int
n_values(const BoundaryConditionParameters<dim> &parameters)
{
  if (!condition_kind<dim>(parameters.type).uses("Components"))
    return 1;
  return parameters.components.empty() ? dim : parameters.components.size();
}

/** The value, zeros where the user gave none. */
template <int dim>
std::string
value_text(const BoundaryConditionParameters<dim> &parameters)
{
  if (!parameters.value.empty())
    return parameters.value;
  std::string zeros = "0";
  for (unsigned int i = 1; i < n_values(parameters); ++i)
    zeros += "; 0";
  return zeros;
}

/** How many values there are to give. */
template <int dim>
std::string
hint_for_value(const BoundaryConditionParameters<dim> &parameters)
{
  return parameters.components.empty()
           ? "Components is not set, so all are prescribed: "
               + joined({axes.begin(), axes.begin() + dim}, ", ")
               + "; for one alone set Components = " + axes[dim - 1]
           : "one for each of Components = " + joined(parameters.components, ", ");
}

/** The names of the kinds for which `answer` is true, as in "pressure, wind". */
template <int dim, typename Question>
std::string
names_of_kinds(const Question &answer)
{
  std::vector<std::string> names;
  for (const auto &kind : registered_conditions<dim>())
    if (answer(kind))
      names.push_back(kind.name);
  return joined(names, ", ");
}

/** Declares the entry Type and those that several kinds share. */
template <int dim>
void
declare_shared_entries(BoundaryConditionParameters<dim> &p, std::vector<std::string> &on,
                       const ParameterSection &section)
{
  std::vector<std::string> types;
  for (const auto &kind : registered_conditions<dim>())
    types.push_back(kind.name);
  p.type = section.choice("Type", p.type, types, "What is prescribed.");
  section.entry("On", on, dealii::Patterns::Selection(joined(region_names<dim>(), "|")),
                "Where: a face of the background box that clips the body (fitted), or 'surface', "
                "the body's own surface inside the box. Several, as x-, x+, are a condition each, "
                "called NAME.x- and NAME.x+.");
  std::set<std::string> different(on.begin(), on.end());
  if (on.empty() || different.size() < on.size())
    section.error("On", on.empty() ? "nothing is listed" : "a place is listed twice",
                  "list each once, as x-, x+");
  section.entry("Where", p.where,
                "Expression of x, y, z in the initial configuration that selects the part (not "
                "zero: selected), for example x > 1.");
  section.entry("Components", p.components,
                "The components concerned, a list of x, y, z ("
                  + names_of_kinds<dim>([](const auto &kind) { return kind.takes_a_rotation; })
                  + ": also rotation); empty: all displacement components. Not used by "
                  + names_of_kinds<dim>([](const auto &kind) { return !kind.uses("Components"); })
                  + ".");
  section.formula(
    "Value", p.value,
    "One expression of x, y, z, t per component, separated by ';': displacement [L], "
    "traction or pressure [force/L^2], spring stiffness, of t = 0 [force/L^3]; empty: "
    "zero. In it table(load.csv) is the value at t of a table (CSV) of times and values, linear in "
    "between.");
}

template <int dim>
void
check_components(const BoundaryConditionParameters<dim> &p, const ConditionKind<dim> &kind,
                 const ParameterSection &section)
{
  std::vector<std::string> allowed(axes.begin(), axes.begin() + dim);
  if (kind.takes_a_rotation)
    allowed.push_back("rotation");
  for (const auto &component : p.components)
    if (std::find(allowed.begin(), allowed.end(), component) == allowed.end())
      section.error("Components", "'" + component + "' is no component here",
                    "allowed: " + joined(allowed, ", "));
    else if (std::count(p.components.begin(), p.components.end(), component) > 1)
      {
        section.error("Components", "'" + component + "' is listed twice", "list each once");
        break;
      }
}

/** Records entries that have a value but no meaning for the kind. */
template <int dim>
void
check_unused_entries(const ConditionKind<dim> &kind, const ParameterSection &section)
{
  std::set<std::string> unused;
  for (const auto &other : registered_conditions<dim>())
    unused.insert(other.entries.begin(), other.entries.end());
  for (const std::string &entry : kind.entries)
    unused.erase(entry);
  for (const std::string &entry : unused)
    if (section.is_set(entry))
      section.error(entry, "a " + kind.name + " condition does not use it", "remove the line");
}
} // namespace

template <int dim>
std::vector<std::string>
BoundaryConditionParameters<dim>::declare(ParameterSection &section)
{
  std::vector<std::string> places = {on};
  declare_shared_entries(*this, places, section);
  if (!places.empty())
    on = places.front();
  for (const auto &kind : registered_conditions<dim>())
    if (kind.declare != nullptr)
      kind.declare(*this, section, kind.name == type);

  if (section.is_wrong("Type"))
    return places;
  const ConditionKind<dim> &kind = condition_kind<dim>(type);
  check_components(*this, kind, section);
  check_unused_entries(kind, section);
  if (value.empty() && kind.needs_value)
    section.error("Value", "a " + kind.name + " condition needs a value",
                  "set Value = expression(s) of x, y, z, t");
  check_expression<dim>(section, "Where", where, 1);
  if (!section.is_wrong("Components"))
    check_expression<dim>(section, "Value", value_text(*this), n_values(*this),
                          kind.uses("Components") ? hint_for_value(*this) : "");
  return places;
}

template <int dim>
BoundaryCondition<dim>::BoundaryCondition(const std::string &name, const std::string &path,
                                          const BoundaryConditionParameters<dim> &parameters)
    : name(name)
    , path(path)
    , parameters(parameters)
    , of_kind(&condition_kind<dim>(parameters.type))
    , region(parameters.where, 1, path + "/Where")
    , values(value_text(parameters), n_values(parameters), path + "/Value")
{
  for (const auto &component : parameters.components)
    components.push_back(component == "rotation"
                           ? rotation
                           : std::find(axes.begin(), axes.end(), component) - axes.begin());
  if (components.empty())
    for (unsigned int d = 0; d < dim; ++d)
      components.push_back(d);
  const auto faces = region_names<dim>();
  box_face         = std::find(faces.begin(), faces.end(), parameters.on) - faces.begin();
}

template <int dim>
double
BoundaryCondition<dim>::value(const unsigned int index, const dealii::Point<dim> &point,
                              const double time) const
{
  const double result = values.value(point, time, index);
  if (!std::isfinite(result))
    {
      std::ostringstream where;
      where << point << ", t = " << time;
      throw UserError(path + "/Value",
                      "'" + values.text() + "' is no finite number at the point " + where.str(),
                      "check divisions, roots and logarithms, or exclude the point by Where");
    }
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
BoundaryCondition<dim>::vector(const dealii::Point<dim> &point, const double time) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int i = 0; i < components.size(); ++i)
    if (components[i] < dim)
      result[components[i]] = value(i, point, time);
  return result;
}

template struct BoundaryConditionParameters<2>;
template struct BoundaryConditionParameters<3>;
template class BoundaryCondition<2>;
template class BoundaryCondition<3>;
} // namespace scree
