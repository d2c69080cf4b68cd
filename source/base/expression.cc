#include <scree/base/exceptions.h>
#include <scree/base/expression.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>

namespace scree
{
namespace
{
/** deal.II prints what muParser complains of before it throws; while this lives, it is kept off the
 * screen. */
class SilentErrors
{
public:
  SilentErrors()
      : buffer(std::cerr.rdbuf(nullptr))
  {
  }
  ~SilentErrors()
  {
    std::cerr.rdbuf(buffer);
    std::cerr.clear();
  }
  SilentErrors(const SilentErrors &)            = delete;
  SilentErrors &operator=(const SilentErrors &) = delete;

private:
  std::streambuf *buffer;
};

/** muParser's sentence out of deal.II's message, which breaks it into lines and traces the stack.
 */
std::string
reason_of(const std::string &message)
{
  const auto begin = message.find("said:");
  if (begin == std::string::npos)
    return "";
  const auto  end    = std::min(message.find('<', begin), message.find("Stacktrace", begin));
  std::string reason = message.substr(begin + 5, end - begin - 5);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  std::string result;
  for (const char c : reason)
    if (c != ' ' || (!result.empty() && result.back() != ' '))
      result += c;
  return result;
}

/** The constant that stands for the value of a table in a formula. */
std::string
name_of_table(const std::size_t number)
{
  return "value_of_table_" + std::to_string(number);
}

/** Whether there is nothing between two semicolons or at an end. */
bool
has_empty_component(const std::string &formula)
{
  bool is_empty = true;
  for (const char c : formula + ';')
    {
      if (c == ';' && is_empty)
        return true;
      is_empty = c == ';' || (is_empty && std::isspace(static_cast<unsigned char>(c)));
    }
  return false;
}

/** Whether a formula sets a variable: muParser would change x, y or t for what follows. */
bool
assigns(const std::string &formula)
{
  for (std::size_t i = 0; i < formula.size(); ++i)
    if (formula[i] == '=')
      {
        if (i + 1 < formula.size() && formula[i + 1] == '=')
          ++i;
        else if (i == 0 || std::string("<>!").find(formula[i - 1]) == std::string::npos)
          return true;
      }
  return false;
}
} // namespace

template <int dim>
Expression<dim>::Expression(const std::string &text, const unsigned int n_components,
                            const std::string &where)
    : formula(text)
    , compilable(text)
    , n_components(n_components)
{
  const auto calls = table_calls(text, where);
  if (!calls.empty())
    compiled = std::make_shared<Compiled>();
  for (auto call = calls.rbegin(); call != calls.rend(); ++call)
    {
      require(!call->checksum.empty(), where, "'" + text + "' has a table, which has no place here",
              "tables are functions of t: in values, motions, loads and body forces");
      compiled->tables.insert(compiled->tables.begin(), read_time_table(call->file));
      compilable.replace(call->begin, call->length, name_of_table(calls.rend() - call - 1));
    }
  const std::string variables = dim == 2 ? "x,y,t" : "x,y,z,t";
  const auto        separators
    = static_cast<unsigned int>(std::count(compilable.begin(), compilable.end(), ';'));
  require(separators + 1 == n_components, where,
          "'" + text + "' has " + std::to_string(separators + 1) + " component(s)",
          "give " + std::to_string(n_components) + " expression(s) of " + variables
            + ", separated by ';'");
  require(!has_empty_component(compilable), where, "a component of '" + text + "' is empty",
          "give " + std::to_string(n_components) + " expression(s) of " + variables
            + ", separated by ';'");
  require(!assigns(compilable), where, "'" + text + "' sets a variable", "compare with '=='");
  try
    {
      const SilentErrors silence;
      if (calls.empty())
        parser = parser_with({});
      // muParser compiles at the first evaluation: let its complaint come here.
      for (unsigned int c = 0; c < n_components; ++c)
        value(dealii::Point<dim>(), 0., c);
    }
  catch (const UserError &)
    {
      throw; // of a table
    }
  catch (const std::exception &error)
    {
      throw UserError(where, "'" + text + "' is not a formula: " + reason_of(error.what()),
                      "use " + variables + ", pi, numbers, + - * / ^ and muParser's functions");
    }
}

template <int dim>
std::shared_ptr<dealii::FunctionParser<dim>>
Expression<dim>::parser_with(const std::map<std::string, double> &constants) const
{
  auto result = std::make_shared<Parser>(n_components);
  auto all    = constants;
  all["pi"]   = M_PI;
  result->initialize(dim == 2 ? "x,y,t" : "x,y,z,t", compilable, all, true);
  return result;
}

template <int dim>
const dealii::FunctionParser<dim> &
Expression<dim>::parser_at(const double time) const
{
  if (!compiled)
    return *parser;
  // Steps ask for the time of their end, rates and increments for one or two more.
  constexpr std::size_t most     = 4;
  auto                 &of_times = compiled->of_times;
  const auto            found    = std::find_if(of_times.begin(), of_times.end(),
                                                [time](const auto &one) { return one.first == time; });
  if (found != of_times.end())
    return *found->second;
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < compiled->tables.size(); ++i)
    values[name_of_table(i)] = compiled->tables[i].value(time);
  if (of_times.size() == most)
    of_times.erase(of_times.begin());
  of_times.emplace_back(time, parser_with(values));
  of_times.back().second->set_time(time);
  return *of_times.back().second;
}

template <int dim>
double
Expression<dim>::value(const dealii::Point<dim> &point, const double time,
                       const unsigned int component) const
{
  if (parser)
    parser->set_time(time);
  return parser_at(time).value(point, component);
}

template <int dim>
dealii::Tensor<1, dim>
Expression<dim>::vector(const dealii::Point<dim> &point, const double time) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = value(point, time, c);
  return result;
}

std::optional<double>
constant_value(const std::string &text)
{
  // A comma outside of parentheses is one between numbers, or of a decimal fraction.
  int depth = 0;
  for (const char c : text)
    {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (c == ';' || (c == ',' && depth == 0))
        return {};
    }
  // 0x10 would be a hexadecimal number.
  if (assigns(text) || text.find("rand") != std::string::npos
      || text.find("0x") != std::string::npos)
    return {};
  try
    {
      const SilentErrors        silence;
      dealii::FunctionParser<1> parser(1);
      parser.initialize("no_variable", text, {{"pi", M_PI}});
      return parser.value(dealii::Point<1>());
    }
  catch (const std::exception &)
    {
      return {};
    }
}

template class Expression<2>;
template class Expression<3>;
} // namespace scree
