#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace scree
{
const EnumNames<ConditionType> condition_type_names = {
  {ConditionType::displacement, "displacement"},   {ConditionType::traction, "traction"},
  {ConditionType::pressure, "pressure"},           {ConditionType::springs, "springs"},
  {ConditionType::point_support, "point support"}, {ConditionType::mean_support, "mean support"}};

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
  if (parameters.type == ConditionType::pressure)
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

/** Records entries that have a value but no meaning for the type. */
template <int dim>
void
check_unused_entries(const BoundaryConditionParameters<dim> &parameters,
                     const ParameterSection                 &section)
{
  const auto  type      = parameters.type;
  const auto &name      = name_of(condition_type_names, type);
  const auto  is_unused = [&](const std::string &key, const bool is_used) {
    if (!is_used && section.is_set(key))
      section.error(key, "a " + name + " condition does not use it", "remove the line");
  };
  is_unused("Components", type != ConditionType::pressure);
  is_unused("Method", type == ConditionType::displacement);
  is_unused("Penalty factor", type == ConditionType::displacement);
  is_unused("Point", type == ConditionType::point_support);
  is_unused("On", type != ConditionType::point_support);
  is_unused("Where", type != ConditionType::point_support);
}
} // namespace

template <int dim>
void
BoundaryConditionParameters<dim>::declare(ParameterSection &section)
{
  const auto faces = region_names<dim>();
  section.entry("Type", type, condition_type_names, "What is prescribed.");
  section.entry("On", on, dealii::Patterns::Selection(joined(faces, "|")),
                "Where: a face of the background box that clips the body (fitted), or 'surface', "
                "the body's own surface inside the box.");
  section.entry("Where", where,
                "Expression of x, y, z in the initial configuration that selects the part (not "
                "zero: selected), for example x > 1.");
  section.entry("Components", components,
                "The components concerned, a list of x, y, z (mean support: also rotation); empty: "
                "all displacement components. Not used by pressure.");
  section.entry(
    "Value", value,
    "One expression of x, y, z, t per component, separated by ';': displacement [L], "
    "traction or pressure [force/area], spring stiffness, of t = 0 [force/area/L]; empty: "
    "zero.");
  section.entry("Method", method, displacement_method_names,
                "How a displacement is imposed; automatic: exactly on a box face, by Nitsche on "
                "the cut surface.");
  section.entry("Penalty factor", penalty_factor, dealii::Patterns::Double(0.),
                "c in beta = c k^2 (2 mu + lambda)/h of Nitsche and penalty; no dimension.");
  section.entry("Point", point, "Position of a point support [L].");

  std::vector<std::string> allowed(axes.begin(), axes.begin() + dim);
  if (type == ConditionType::mean_support)
    allowed.push_back("rotation");
  for (const auto &component : components)
    if (std::find(allowed.begin(), allowed.end(), component) == allowed.end())
      section.error("Components", "'" + component + "' is no component here",
                    "allowed: " + joined(allowed, ", "));
    else if (std::count(components.begin(), components.end(), component) > 1)
      {
        section.error("Components", "'" + component + "' is listed twice", "list each once");
        break;
      }
  check_unused_entries(*this, section);
  if (penalty_factor == 0. && method != DisplacementMethod::nonsymmetric_nitsche)
    section.error("Penalty factor", "only nonsymmetric nitsche works without a penalty",
                  "10 to 100 for the other methods");
  if (value.empty()
      && (type == ConditionType::traction || type == ConditionType::pressure
          || type == ConditionType::springs))
    section.error("Value", "a " + name_of(condition_type_names, type) + " condition needs a value",
                  "set Value = expression(s) of x, y, z, t");
  check_expression<dim>(section, "Where", where, 1);
  check_expression<dim>(section, "Value", value_text(*this), n_values(*this));
}

template <int dim>
BoundaryCondition<dim>::BoundaryCondition(const std::string &name, const std::string &path,
                                          const BoundaryConditionParameters<dim> &parameters)
    : name(name)
    , path(path)
    , parameters(parameters)
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
