#pragma once

#include <scree/base/time_table.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/**
 * A formula of position and time, f(x, y[, z], t), parsed by muParser; `pi` is known. Several
 * components are separated by ';'. Comparisons give 1 or 0, so that a region is an expression too.
 * A TimeTable at t is table(FILE, CHECKSUM), as ParameterSection::formula() makes it of
 * table(FILE).
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
  using Parser = dealii::FunctionParser<dim>;

  std::shared_ptr<Parser> parser_with(const std::map<std::string, double> &constants) const;
  /** At a time, where tables have values. */
  const Parser &parser_at(const double time) const;

  /** A formula with tables is compiled for a time, with their values as constants. */
  struct Compiled
  {
    std::vector<TimeTable>                                  tables;
    std::vector<std::pair<double, std::shared_ptr<Parser>>> of_times; //!< the last ones
  };

  std::string               formula, compilable; //!< the latter with names of tables' values
  unsigned int              n_components;
  std::shared_ptr<Parser>   parser;   //!< without tables
  std::shared_ptr<Compiled> compiled; //!< with tables
};

/** The value of a formula without variables; nothing if the text is none. */
std::optional<double> constant_value(const std::string &text);
} // namespace scree
