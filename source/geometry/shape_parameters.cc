#include <scree/base/log.h>
#include <scree/geometry/moved_shape.h>
#include <scree/geometry/shape_family.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
const ShapeFamily<dim> &
family_of(const std::string &type)
{
  for (const auto &family : registered_shapes<dim>())
    if (std::find(family.types.begin(), family.types.end(), type) != family.types.end())
      return family;
  AssertThrow(false, ExcMessage("There is no type of shape called '" + type + "'."));
}

/** The entries of all families, each key once, in the order of the section. */
template <int dim>
std::vector<ShapeEntry>
all_entries()
{
  std::vector<ShapeEntry> result;
  for (const auto &family : registered_shapes<dim>())
    {
      auto place = result.end();
      for (const ShapeEntry &entry : family.entries)
        {
          const auto known
            = std::find_if(result.begin(), result.end(),
                           [&](const ShapeEntry &other) { return other.key == entry.key; });
          place = known != result.end() ? known : result.insert(place, entry);
          ++place;
        }
    }
  return result;
}

/** "a disc, ellipse or ring". */
std::string
alternatives(const std::vector<std::string> &names)
{
  const bool  vowel  = std::string("aeiou").find(names[0][0]) != std::string::npos;
  std::string result = vowel ? "an " : "a ";
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return result;
}

/** The texts of all families for a key, with the names of those that share one. */
template <int dim>
std::string
documentation_of(const std::string &key)
{
  std::vector<std::pair<ShapeEntry, std::vector<std::string>>> texts;
  for (const auto &family : registered_shapes<dim>())
    for (const ShapeEntry &entry : family.entries)
      if (entry.key == key)
        {
          auto same = std::find_if(texts.begin(), texts.end(),
                                   [&](const auto &text) { return text.first.text == entry.text; });
          if (same == texts.end())
            same = texts.insert(same, {entry, {}});
          same->second.push_back(family.types[0]);
        }
  std::string result;
  for (auto &[entry, names] : texts)
    {
      if (const std::size_t place = entry.text.find('%'); place != std::string::npos)
        entry.text.replace(place, 1, alternatives(names));
      result += (result.empty() ? "" : ", ") + entry.text;
    }
  const std::string &unit = texts[0].first.unit;
  return result + (unit.empty() ? "." : " " + unit + ".");
}

template <int dim>
void
declare_type(std::string &type, const ParameterSection &section)
{
  std::vector<std::string> types;
  std::string              summary;
  for (const auto &family : registered_shapes<dim>())
    {
      types.insert(types.end(), family.types.begin(), family.types.end());
      const bool has_comma = family.summary.find(',') != std::string::npos;
      summary += (summary.empty() ? "" : has_comma ? "; " : ", ") + family.summary;
    }
  type = section.choice("Type", type, types, "Kind of shape. " + summary + ".");
}

/** The numbers of a value; NaN is an unset one. */
std::vector<double>
numbers_of(const ShapeValue &value)
{
  if (const auto *number = std::get_if<double>(&value))
    return {*number};
  const auto *list = std::get_if<std::vector<double>>(&value);
  return list != nullptr ? *list : std::vector<double>();
}

/** Whether a value was given. (A file that was written back contains all entries.) */
bool
is_given(const ShapeValue &value)
{
  return std::visit(
    [](const auto &content) {
      using T = std::decay_t<decltype(content)>;
      if constexpr (std::is_same_v<T, double>)
        return !std::isnan(content);
      else if constexpr (std::is_same_v<T, bool>)
        return content;
      else
        return !content.empty();
    },
    value);
}

/** The keys of entries that were given. */
template <int dim>
std::vector<std::string>
given_entries(const ShapeParameters<dim> &p)
{
  std::vector<std::string> given;
  for (const ShapeEntry &entry : all_entries<dim>())
    if (is_given(p.values.at(entry.key)))
      given.push_back(entry.key);
  if (!p.parts.empty())
    given.push_back("Parts");
  return given;
}

/** Records all that was given. */
template <int dim>
void
check_no_use(const ShapeParameters<dim> &p, const ParameterSection &section,
             const std::string &instead)
{
  std::vector<std::string> given = given_entries(p);
  for (const std::string key :
       {"Type", "Rotation angle", "Rotation centre", "Rotation axis", "Translation"})
    if (section.is_set(key))
      given.push_back(key);
  for (const std::string &key : given)
    section.error(key, "'" + key + "' is not used: " + instead + " makes the shapes", "remove it");
}

/** Records entries that are missing, and those of other types. */
template <int dim>
void
check_use(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  const ShapeFamily<dim>  &family = family_of<dim>(p.type);
  std::vector<std::string> own, required;
  for (const ShapeEntry &entry : family.entries)
    {
      own.push_back(entry.key);
      if (entry.is_required)
        required.push_back(entry.key);
    }
  const std::vector<std::string> given = given_entries(p);
  if (family.takes_parts)
    own = required = {"Parts"};

  std::string list;
  for (const std::string &key : required)
    list += (list.empty() ? "" : ", ") + key;
  const auto contains = [](const std::vector<std::string> &keys, const std::string &key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  for (const std::string &key : required)
    if (!contains(given, key) && !section.is_wrong(key))
      section.error("Type", "Type = " + p.type + " needs the entry '" + key + "', which is not set",
                    "set " + list);
  for (const std::string &key : given)
    if (!contains(own, key))
      section.error(key, "'" + key + "' is not used by Type = " + p.type,
                    "remove it; the type takes " + list);
}

/** Records a list that is given, but not with dim numbers. */
template <int dim>
void
check_length(const ParameterSection &section, const std::string &key,
             const std::vector<double> &values)
{
  if (!values.empty() && values.size() != dim)
    section.error(key, "'" + key + "' has " + std::to_string(values.size()) + " number(s)",
                  "give " + std::to_string(dim) + " numbers, separated by commas");
}

template <int dim>
void
check_values(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  for (const ShapeEntry &entry : all_entries<dim>())
    {
      const ShapeValue         &value   = p.values.at(entry.key);
      const std::vector<double> numbers = numbers_of(value);
      if (std::holds_alternative<std::vector<double>>(value))
        check_length<dim>(section, entry.key, numbers);
      if (entry.is_positive
          && std::any_of(numbers.begin(), numbers.end(), [](const double x) { return x <= 0; }))
        section.error(entry.key, "'" + entry.key + "' must be greater than zero");
    }
  check_length<dim>(section, "Rotation centre", p.rotation_centre);
  if (dim == 3)
    check_length<dim>(section, "Rotation axis", p.rotation_axis);
  check_length<dim>(section, "Translation", p.translation);
  if (dim == 3 && p.rotation_angle != 0
      && std::all_of(p.rotation_axis.begin(), p.rotation_axis.end(),
                     [](const double x) { return x == 0; }))
    section.error("Rotation angle", "a rotation needs a 'Rotation axis' that is not zero");
}

template <int dim>
void
declare_motion(ShapeParameters<dim> &p, const ParameterSection &section)
{
  section.entry("Rotation angle", p.rotation_angle,
                "Turns the shape by this angle [degrees], counter-clockwise.");
  section.entry("Rotation centre", p.rotation_centre,
                "A point that the rotation leaves in place [L]; unset: the origin.");
  if constexpr (dim == 3)
    section.entry("Rotation axis", p.rotation_axis, "Axis of the rotation, of any length.");
  section.entry("Translation", p.translation, "Moves the shape after the rotation [L].");
}

template <int dim>
void
declare_parts(ShapeParameters<dim> &p, const ParameterSection &section)
{
  // The documentation shows one level of parts.
  const std::string path = section.path(), placeholder = "<name>";
  if (section.is_documentation() && path.size() >= placeholder.size()
      && path.substr(path.size() - placeholder.size()) == placeholder)
    return;
  p.parts.clear();
  for (const auto &[name, part_section] :
       section.named("Parts", "Names of the parts of a union, intersection or difference; each is "
                              "a subsection like this one."))
    {
      p.parts.emplace_back(name, ShapeParameters<dim>());
      p.parts.back().second.declare(part_section);
    }
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
} // namespace

template <int dim>
void
ShapeParameters<dim>::declare(const ParameterSection &section, const std::string &instead)
{
  declare_type<dim>(type, section);
  for (const ShapeEntry &entry : all_entries<dim>())
    {
      ShapeValue       &value = values[entry.key] = entry.unset;
      const std::string text                      = documentation_of<dim>(entry.key);
      if (entry.is_file)
        section.file(entry.key, std::get<std::string>(value), text);
      else
        std::visit([&](auto &content) { section.entry(entry.key, content, text); }, value);
    }
  declare_motion(*this, section);
  declare_parts(*this, section);
  if (!instead.empty())
    return check_no_use(*this, section, instead);
  if (section.is_wrong("Type"))
    return;
  check_use(*this, section);
  check_values(*this, section);
  if (const auto check = family_of<dim>(type).check; check != nullptr)
    check(*this, section);
}

template <int dim>
ShapeParameters<dim>
ShapeParameters<dim>::of_type(const std::string &type)
{
  ShapeParameters result;
  result.type = type;
  for (const ShapeEntry &entry : all_entries<dim>())
    result.values[entry.key] = entry.unset;
  return result;
}

template <int dim>
std::vector<std::pair<std::string, std::string>>
ShapeParameters<dim>::cells() const
{
  std::vector<std::pair<std::string, std::string>> cells = {{"Type", type}};
  const auto add = [&](const std::string &key, const auto &content) {
    using T = std::decay_t<decltype(content)>;
    if constexpr (std::is_same_v<T, double>)
      cells.emplace_back(key, exact_number(content));
    else if constexpr (std::is_same_v<T, std::vector<double>>)
      for (std::size_t d = 0; d < content.size(); ++d)
        cells.emplace_back(key + " " + "xyz"[d], exact_number(content[d]));
    else if constexpr (std::is_same_v<T, std::vector<Point<2>>>)
      {
        std::string text;
        for (const Point<2> &x : content)
          text += (text.empty() ? "" : "; ") + exact_number(x[0]) + ", " + exact_number(x[1]);
        cells.emplace_back(key, text);
      }
    else if constexpr (std::is_same_v<T, bool>)
      cells.emplace_back(key, "true");
    else
      cells.emplace_back(key, content);
  };
  for (const auto &[key, value] : values)
    if (is_given(value))
      std::visit([&, key = key](const auto &content) { add(key, content); }, value);
  if (rotation_angle != 0.)
    {
      add("Rotation angle", rotation_angle);
      add("Rotation centre", rotation_centre);
      add("Rotation axis", rotation_axis);
    }
  add("Translation", translation);
  return cells;
}

template <int dim>
double
ShapeParameters<dim>::number(const std::string &key) const
{
  return std::get<double>(values.at(key));
}

template <int dim>
const std::vector<double> &
ShapeParameters<dim>::coordinates(const std::string &key) const
{
  return std::get<std::vector<double>>(values.at(key));
}

template <int dim>
const std::vector<Point<2>> &
ShapeParameters<dim>::vertices(const std::string &key) const
{
  return std::get<std::vector<Point<2>>>(values.at(key));
}

template <int dim>
const std::string &
ShapeParameters<dim>::text(const std::string &key) const
{
  return std::get<std::string>(values.at(key));
}

template <int dim>
bool
ShapeParameters<dim>::flag(const std::string &key) const
{
  return std::get<bool>(values.at(key));
}

template <int dim>
Point<dim>
ShapeParameters<dim>::point(const std::string &key) const
{
  return to_point<dim>(coordinates(key));
}

template <int dim>
ShapePointer<dim>
make_shape(const ShapeParameters<dim> &p)
{
  const Point<dim> centre
    = p.rotation_centre.empty() ? Point<dim>() : to_point<dim>(p.rotation_centre);
  const Point<dim> translation
    = p.translation.empty() ? Point<dim>() : to_point<dim>(p.translation);
  ShapePointer<dim> shape = family_of<dim>(p.type).make(p);
  if (p.rotation_angle == 0)
    {
      if (translation == Point<dim>())
        return shape;
      return std::make_unique<MovedShape<dim>>(std::move(shape), unit_symmetric_tensor<dim>(),
                                               centre, translation);
    }
  return std::make_unique<MovedShape<dim>>(
    std::move(shape), rotation_matrix<dim>(p.rotation_angle, p.rotation_axis), centre, translation);
}

template struct ShapeParameters<2>;
template struct ShapeParameters<3>;
template ShapePointer<2> make_shape(const ShapeParameters<2> &);
template ShapePointer<3> make_shape(const ShapeParameters<3> &);
} // namespace scree
