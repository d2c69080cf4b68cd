#include <scree/application/stop_relation.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>
#include <scree/parameters/nearest_name.h>

#include <cctype>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

namespace scree
{
namespace
{
bool
is_of_name(const char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

bool
begins_name(const char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}

/** The longest known name that is at a place of a text; else what looks like one there. */
std::string
name_at(const std::string &text, const std::size_t place,
        const std::map<std::string, double> &quantities)
{
  std::size_t end = place;
  while (end < text.size() && (is_of_name(text[end]) || text[end] == '.'))
    ++end;
  std::string longest;
  for (const auto &[name, value] : quantities)
    if (name.size() > longest.size() && text.compare(place, name.size(), name) == 0
        && (place + name.size() == text.size() || !is_of_name(text[place + name.size()])))
      longest = name;
  return longest.empty() ? text.substr(place, end - place) : longest;
}

/** Whether muParser knows a name by itself. */
bool
is_function(const std::string &name)
{
  static const std::set<std::string> known
    = {"pi",   "sin", "cos", "tan", "asin", "acos",  "atan", "sinh", "cosh",
       "tanh", "exp", "log", "ln",  "log2", "log10", "sqrt", "abs",  "sign",
       "min",  "max", "sum", "avg", "rint", "pow",   "if",   "e"};
  return known.count(name) == 1;
}

/** The value of a side; nothing if it is no formula. @throws UserError of unknown names */
std::optional<double>
value_of(const std::string &side, const std::map<std::string, double> &quantities,
         const std::string &where)
{
  std::ostringstream formula;
  formula << std::setprecision(17);
  for (std::size_t i = 0; i < side.size();)
    {
      // Not the e of 1e-3.
      if (!begins_name(side[i])
          || (i > 0
              && (std::isdigit(static_cast<unsigned char>(side[i - 1])) || side[i - 1] == '.')))
        {
          formula << side[i++];
          continue;
        }
      const std::string name  = name_at(side, i, quantities);
      const auto        found = quantities.find(name);
      if (found != quantities.end())
        formula << "(" << found->second << ")";
      else if (is_function(name))
        formula << name;
      else
        {
          std::vector<std::string> names;
          std::string              list;
          for (const auto &[known, value] : quantities)
            {
              names.push_back(known);
              list += (list.empty() ? "" : ", ") + known;
            }
          throw UserError(where, "there is no quantity '" + name + "'" + did_you_mean(name, names),
                          "there are " + list);
        }
      i += name.size();
    }
  return constant_value(formula.str());
}
} // namespace

StopRelation::StopRelation(const std::string &text, const std::string &where)
    : relation(text)
    , where(where)
{
  const std::size_t place = text.find_first_of("<>");
  require(place != std::string::npos && text.find_first_of("<>", place + 1) == std::string::npos,
          where, "'" + text + "' is not one comparison", "write it as in p > 2");
  left  = text.substr(0, place);
  right = text.substr(place + (text.compare(place + 1, 1, "=") == 0 ? 2 : 1));
  for (const std::string &side : {left, right})
    require(side.find_first_not_of(" \t") != std::string::npos, where,
            "a side of '" + text + "' is empty", "write it as in p > 2");
  if (text[place] == '<')
    std::swap(left, right);
}

void
StopRelation::require_known(const std::vector<std::string> &names) const
{
  std::map<std::string, double> quantities;
  for (const std::string &name : names)
    quantities[name] = 1.;
  for (const std::string &side : {left, right})
    require(value_of(side, quantities, where).has_value(), where, "'" + side + "' is no formula",
            "write one on both sides of <, <=, > or >=, as in p > 2");
}

double
StopRelation::margin(const std::map<std::string, double> &quantities) const
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return value_of(left, quantities, where).value_or(unknown)
         - value_of(right, quantities, where).value_or(unknown);
}
} // namespace scree
