#pragma once

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>

namespace scree
{
/**
 * A formula of position and time, f(x, y[, z], t), parsed by muParser; `pi` is known. Several
 * components are separated by ';'. Comparisons give 1 or 0, so that a region is an expression too.
 */
template <int dim>
class Expression
{
public:
  /**
   * @param text         the formula, e.g. "0; -0.04*t"
   * @param n_components how many components it must have
   * @param where        the parameter it comes from, for the error message
   * @throws UserError if it does not parse or has another number of components
   */
  Expression(const std::string &text, const unsigned int n_components, const std::string &where);

  /** Component `component` at position `point` and time `time`. */
  double value(const dealii::Point<dim> &point, const double time = 0.,
               const unsigned int component = 0) const;

  /** The first dim components as a vector. */
  dealii::Tensor<1, dim> vector(const dealii::Point<dim> &point, const double time = 0.) const;

  /** Whether the expression selects the point (first component not zero). */
  bool selects(const dealii::Point<dim> &point, const double time = 0.) const
  {
    return value(point, time) != 0.;
  }

  const std::string &text() const
  {
    return formula;
  }

private:
  std::string                                  formula;
  std::shared_ptr<dealii::FunctionParser<dim>> parser;
};
} // namespace scree
