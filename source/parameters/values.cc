#include <scree/base/expression.h>
#include <scree/parameters/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <type_traits>

namespace scree
{
namespace
{
using namespace dealii;

/** How a type is written: the words for it, and the separators of its pieces (none: a scalar). */
struct TypeDescription
{
  std::string words;
  std::string separators;
};

TypeDescription
describe(const bool &)
{
  return {"true or false", ""};
}

TypeDescription
describe(const int &)
{
  return {"an integer", ""};
}

TypeDescription
describe(const unsigned int &)
{
  return {"an integer >= 0", ""};
}

TypeDescription
describe(const double &)
{
  return {"a number", ""};
}

TypeDescription
describe(const std::string &)
{
  return {"a text", ""};
}

TypeDescription
describe(const std::vector<std::string> &)
{
  return {"a list of texts separated by commas", ","};
}

TypeDescription
describe(const std::vector<unsigned int> &)
{
  return {"a list of integers >= 0 separated by commas", ","};
}

TypeDescription
describe(const std::vector<double> &)
{
  return {"a list of numbers separated by commas", ","};
}

template <int dim>
TypeDescription
describe(const Tensor<1, dim> &)
{
  return {std::to_string(dim) + " numbers separated by commas", ","};
}

template <int dim>
TypeDescription
describe(const std::vector<Point<dim>> &)
{
  return {"a list of points as in '" + std::string(dim == 2 ? "0, 0; 1, 0" : "0, 0, 0; 1, 0, 0")
            + "'",
          ",;"};
}

std::string
format(const bool &value)
{
  return value ? "true" : "false";
}

template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
std::string
format(const Number &value)
{
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value))
      return "";
  char       buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, result.ptr);
}

std::string
format(const std::string &value)
{
  return value;
}

template <int dim>
std::string
format(const Tensor<1, dim> &value)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    {
      if (!std::isfinite(value[d]))
        return "";
      text += (d == 0 ? "" : ", ") + format(value[d]);
    }
  return text;
}

template <typename T>
std::string
format(const std::vector<T> &values)
{
  const std::string separator
    = std::is_base_of_v<Tensor<1, 2>, T> || std::is_base_of_v<Tensor<1, 3>, T> ? "; " : ", ";
  std::string text;
  for (const auto &value : values)
    text += (text.empty() ? "" : separator) + format(value);
  return text;
}

Reading
parse(const std::string &text, bool &value)
{
  value = text == "true";
  return {value || text == "false", ""};
}

/** Takes the value of a formula, if it is a number of that type. */
template <typename Number>
bool
set_number(const double formula, Number &value)
{
  value = static_cast<Number>(0);
  if (!(std::abs(formula) < static_cast<double>(std::numeric_limits<Number>::max())))
    return false;
  if (std::is_integral_v<
        Number> && (formula != std::round(formula) || (std::is_unsigned_v<Number> && formula < 0.)))
    return false;
  value = static_cast<Number>(formula);
  return true;
}

/** A number, or a formula without variables. */
template <typename Number>
Reading
parse_number(const std::string &text, Number &value)
{
  const char *const first  = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
  const char *const last   = text.data() + text.size();
  const auto        result = std::from_chars(first, last, value);
  if (result.ec == std::errc::result_out_of_range)
    return {false, "the number is too large or too small to be represented"};
  if (text.empty())
    return {false, "write a value behind '='"};
  if (result.ec != std::errc() || (first != text.data() && *first == '-'))
    {
      const auto formula = constant_value(text);
      return {formula && set_number(*formula, value), ""};
    }
  if (result.ptr == last)
    return {true, ""};
  if (const auto formula = constant_value(text); formula && set_number(*formula, value))
    return {true, ""};
  const std::string rest = Utilities::trim(std::string(result.ptr, last));
  if (rest[0] == ',')
    return {false, "write one number; a decimal fraction has a point, not a comma"};
  if (text.find("0x") != std::string::npos)
    return {false, "write a decimal number"};
  if (std::isalpha(static_cast<unsigned char>(rest[0])) || rest[0] == '%')
    return {false, "write the number alone, without '" + rest
                     + "': units are not converted, use one consistent system"};
  return {false, ""};
}

Reading
parse(const std::string &text, int &value)
{
  return parse_number(text, value);
}

Reading
parse(const std::string &text, unsigned int &value)
{
  return parse_number(text, value);
}

Reading
parse(const std::string &text, double &value)
{
  const Reading reading = parse_number(text, value);
  if (reading.ok && !std::isfinite(value))
    return {false, "write a finite number"};
  return reading;
}

Reading
parse(const std::string &text, std::string &value)
{
  value = text;
  return {true, ""};
}

template <int dim>
Reading
parse(const std::string &text, Tensor<1, dim> &value)
{
  const auto pieces = split_list(text);
  if (pieces.size() != dim)
    return {false, "there are " + std::to_string(pieces.size()) + " instead of "
                     + std::to_string(dim) + " numbers"};
  for (unsigned int d = 0; d < dim; ++d)
    if (const Reading reading = parse(pieces[d], value[d]); !reading.ok)
      return reading;
  return {true, ""};
}

template <typename T>
Reading
parse_list(const std::string &text, const char separator, std::vector<T> &values)
{
  values.clear();
  for (const auto &piece : split_list(text, separator))
    {
      if (piece.empty())
        return {false, "an element between two separators is missing"};
      values.emplace_back();
      if (const Reading reading = parse(piece, values.back()); !reading.ok)
        return {false, "'" + piece + "' is not an element of such a list"
                         + (reading.hint.empty() ? "" : ": " + reading.hint)};
    }
  return {true, ""};
}

template <typename T>
Reading
parse(const std::string &text, std::vector<T> &values)
{
  return parse_list(text, ',', values);
}

template <int dim>
Reading
parse(const std::string &text, std::vector<Point<dim>> &values)
{
  return parse_list(text, ';', values);
}

/** "[0, 0.5]", ">= 0", "> 0", "<= 3" or nothing, from the bounds as deal.II prints them. */
std::string
range_in_words(const std::string &lower, const std::string &upper)
{
  const bool is_bounded_below = lower != "-MAX_DOUBLE" && lower != "-2147483648";
  const bool is_bounded_above = upper != "MAX_DOUBLE" && upper != "2147483647";
  if (is_bounded_below && is_bounded_above)
    return "in [" + lower + ", " + upper + "]";
  if (is_bounded_below)
    return lower == "2.22507e-308" ? "> 0" : ">= " + lower;
  return is_bounded_above ? "<= " + upper : "";
}

struct PatternDescription
{
  /** "a number", "an integer", or all there is to say. */
  std::string kind;
  /** "in [0, 1]" or nothing. */
  std::string range;
};

PatternDescription
describe(const Patterns::PatternBase &pattern)
{
  const std::string text  = pattern.description(Patterns::PatternBase::Machine);
  const auto        dots  = text.find("...");
  const auto        close = text.find(" (inclusive)");
  for (const std::string name : {"[Double ", "[Integer range "})
    if (text.compare(0, name.size(), name) == 0 && close != std::string::npos)
      return {name == "[Double " ? "a number" : "an integer",
              range_in_words(text.substr(name.size(), dots - name.size()),
                             text.substr(dots + 3, close - dots - 3))};
  if (dynamic_cast<const Patterns::Anything *>(&pattern) != nullptr)
    return {"a text", ""};
  if (dynamic_cast<const Patterns::FileName *>(&pattern) != nullptr)
    return {"the path of a file", ""};
  if (dynamic_cast<const Patterns::Bool *>(&pattern) != nullptr)
    return {describe(true).words, ""};
  if (dynamic_cast<const Patterns::Selection *>(&pattern) != nullptr)
    {
      std::string joined;
      for (const auto &name : split_list(text.substr(11, text.rfind(']') - 11), '|'))
        joined += (joined.empty() ? "" : ", ") + name;
      return {joined, ""};
    }
  std::string words = pattern.description(Patterns::PatternBase::Text);
  if (!words.empty())
    words[0] = std::tolower(static_cast<unsigned char>(words[0]));
  return {words, ""};
}
} // namespace

std::vector<std::string>
split_list(const std::string &text, const char separator)
{
  std::vector<std::string> pieces;
  if (text.find_first_not_of(" \t") == std::string::npos)
    return pieces;
  std::size_t begin = 0;
  int         depth = 0; // of parentheses; those that do not belong together count for nothing
  const bool  nests
    = std::count(text.begin(), text.end(), '(') == std::count(text.begin(), text.end(), ')');
  for (std::size_t i = 0; i <= text.size(); ++i)
    {
      if (i == text.size() || (text[i] == separator && depth == 0))
        {
          pieces.push_back(dealii::Utilities::trim(text.substr(begin, i - begin)));
          begin = i + 1;
        }
      else if (nests)
        depth = std::max(0, depth + (text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0));
    }
  return pieces;
}

template <typename T>
std::string
format_value(const T &value)
{
  return format(value);
}

template <typename T>
Reading
parse_value(const std::string &text, T &value)
{
  return parse(text, value);
}

template <typename T>
std::string
allowed_values(const Patterns::PatternBase *pattern)
{
  const TypeDescription type = describe(T());
  if (pattern == nullptr)
    return type.words;
  const PatternDescription restriction = describe(*pattern);
  if (type.separators.empty() || dynamic_cast<const Patterns::List *>(pattern) != nullptr)
    return restriction.kind + (restriction.range.empty() ? "" : " " + restriction.range);
  return type.words + ", each "
         + (restriction.range.empty() ? restriction.kind : restriction.range);
}

template <typename T>
bool
matches(const Patterns::PatternBase &pattern, const std::string &text)
{
  if (pattern.match(text))
    return true;
  const TypeDescription type = describe(T());
  if (type.separators.empty() || dynamic_cast<const Patterns::List *>(&pattern) != nullptr)
    return false;
  for (const auto &group : split_list(text, type.separators.back()))
    for (const auto &piece : split_list(group, type.separators.front()))
      if (!pattern.match(piece))
        return false;
  return true;
}

#define INSTANTIATE(...)                                                           \
  template std::string format_value(const __VA_ARGS__ &);                          \
  template Reading     parse_value(const std::string &, __VA_ARGS__ &);            \
  template std::string allowed_values<__VA_ARGS__>(const Patterns::PatternBase *); \
  template bool        matches<__VA_ARGS__>(const Patterns::PatternBase &, const std::string &);

INSTANTIATE(bool)
INSTANTIATE(int)
INSTANTIATE(unsigned int)
INSTANTIATE(double)
INSTANTIATE(std::string)
INSTANTIATE(std::vector<std::string>)
INSTANTIATE(std::vector<unsigned int>)
INSTANTIATE(std::vector<double>)
INSTANTIATE(Point<2>)
INSTANTIATE(Point<3>)
INSTANTIATE(Tensor<1, 2>)
INSTANTIATE(Tensor<1, 3>)
INSTANTIATE(std::vector<Point<2>>)
INSTANTIATE(std::vector<Point<3>>)
#undef INSTANTIATE
} // namespace scree
