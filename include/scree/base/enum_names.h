#pragma once

#include <scree/base/exceptions.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** The names under which the values of an enum appear in parameter files and tables, in order. */
template <typename Enum>
using EnumNames = std::vector<std::pair<Enum, std::string>>;

/** The name of `value`; throws std::logic_error if the table lacks it. */
template <typename Enum>
const std::string &
name_of(const EnumNames<Enum> &names, const Enum value)
{
  for (const auto &[candidate, name] : names)
    if (candidate == value)
      return name;
  throw std::logic_error("an enum value without a name");
}

/** The value called `name`; throws std::logic_error if there is none (patterns were checked
 * before). */
template <typename Enum>
Enum
value_of(const EnumNames<Enum> &names, const std::string &name)
{
  for (const auto &[value, candidate] : names)
    if (candidate == name)
      return value;
  throw std::logic_error("no enum value is called '" + name + "'");
}

/** The names joined by `separator`: with "|" the argument of dealii::Patterns::Selection. */
template <typename Enum>
std::string
joined_names(const EnumNames<Enum> &names, const std::string &separator = "|")
{
  std::string joined;
  for (const auto &entry : names)
    joined += (joined.empty() ? "" : separator) + entry.second;
  return joined;
}
} // namespace scree
