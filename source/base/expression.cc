#include <scree/base/exceptions.h>
#include <scree/base/expression.h>

#include <algorithm>
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
    , parser(std::make_shared<dealii::FunctionParser<dim>>(n_components))
{
  const std::string variables = dim == 2 ? "x,y,t" : "x,y,z,t";
  const auto separators = static_cast<unsigned int>(std::count(text.begin(), text.end(), ';'));
  require(separators + 1 == n_components, where,
          "'" + text + "' has " + std::to_string(separators + 1) + " component(s)",
          "give " + std::to_string(n_components) + " expression(s) of " + variables
            + ", separated by ';'");
  require(!assigns(text), where, "'" + text + "' sets a variable", "compare with '=='");
  try
    {
      const SilentErrors silence;
      parser->initialize(variables, text, {{"pi", M_PI}}, true);
      // muParser compiles at the first evaluation: let its complaint come here.
      for (unsigned int c = 0; c < n_components; ++c)
        value(dealii::Point<dim>(), 0., c);
    }
  catch (const std::exception &error)
    {
      throw UserError(where, "'" + text + "' is not a formula: " + reason_of(error.what()),
                      "use " + variables + ", pi, numbers, + - * / ^ and muParser's functions");
    }
}

template <int dim>
double
Expression<dim>::value(const dealii::Point<dim> &point, const double time,
                       const unsigned int component) const
{
  parser->set_time(time);
  return parser->value(point, component);
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

template class Expression<2>;
template class Expression<3>;
} // namespace scree
