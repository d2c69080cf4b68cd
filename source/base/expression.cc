#include <scree/base/exceptions.h>
#include <scree/base/expression.h>

#include <cmath>

namespace scree
{
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
  try
    {
      parser->initialize(variables, text, {{"pi", M_PI}}, true);
      // muParser compiles at the first evaluation: let its complaint come here.
      for (unsigned int c = 0; c < n_components; ++c)
        value(dealii::Point<dim>(), 0., c);
    }
  catch (const std::exception &error)
    {
      std::string reason = error.what();
      const auto  begin  = reason.find("said:");
      if (begin != std::string::npos)
        reason = reason.substr(begin + 5, reason.find('\n', begin) - begin - 5);
      else
        reason = "";
      throw UserError(where, "'" + text + "' is not a formula:" + reason,
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
