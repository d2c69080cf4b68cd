#include <scree/geometry/expression_shape.h>
#include <scree/parameters/expression_entry.h>

namespace scree
{
using namespace dealii;

std::vector<std::string>
extremum_arguments(const std::string &formula)
{
  const std::size_t first = formula.find_first_not_of(" \t"),
                    last  = formula.find_last_not_of(" \t");
  if (first == std::string::npos)
    return {formula};
  const std::string text = formula.substr(first, last - first + 1), name = text.substr(0, 4);
  const std::size_t start = name == "max(" || name == "min(" ? 4 : text[0] == '(' ? 1 : 0;
  if (start == 0)
    return {text};
  // The commas of this call; its parenthesis must close at the end.
  std::vector<std::size_t> ends  = {start - 1};
  unsigned int             depth = 0;
  for (std::size_t i = start - 1; i < text.size(); ++i)
    {
      depth += text[i] == '(';
      if (depth == 1 && text[i] == ',')
        ends.push_back(i);
      if (text[i] == ')' && --depth == 0 && i + 1 < text.size())
        return {text};
    }
  ends.push_back(text.size() - 1);
  std::vector<std::string> result;
  for (std::size_t a = 0; a + 1 < ends.size(); ++a)
    for (const auto &argument :
         extremum_arguments(text.substr(ends[a] + 1, ends[a + 1] - ends[a] - 1)))
      result.push_back(argument);
  return result;
}

namespace
{
template <int dim>
void
check_expression(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (const std::string &formula = p.text("Expression"); !formula.empty())
    check_expression<dim>(section, "Expression", formula, 1);
}

template <int dim>
ShapePointer<dim>
make_expression(const ShapeParameters<dim> &p)
{
  const std::string             &formula   = p.text("Expression");
  const std::vector<std::string> arguments = extremum_arguments(formula);
  std::vector<Expression<dim>>   pieces;
  for (std::size_t i = 0; arguments.size() > 1 && i < arguments.size(); ++i)
    pieces.emplace_back(arguments[i], 1, "Expression");
  return std::make_unique<ExpressionShape<dim>>(Expression<dim>(formula, 1, "Expression"),
                                                p.flag("Expression is distance"), pieces);
}
} // namespace

template <int dim>
ShapeFamily<dim>
ExpressionShape<dim>::family()
{
  return {{"expression"},
          "expression",
          {{"Expression",
            "Formula of x, y (and z) that is negative inside; max() intersects, min() unites", "",
            std::string()},
           {"Expression is distance",
            "Whether the formula is the signed distance, so that it is used as it is", "", false,
            false, false}},
          make_expression<dim>,
          check_expression<dim>};
}

template <int dim>
ExpressionShape<dim>::ExpressionShape(const Expression<dim> &expression, const bool distance,
                                      std::vector<Expression<dim>> pieces)
    : expression(expression)
    , distance(distance)
    , pieces(std::move(pieces))
{
}

template <int dim>
bool
ExpressionShape<dim>::is_smooth() const
{
  return pieces.empty();
}

template <int dim>
void
ExpressionShape<dim>::append_pieces(const BoundingBox<dim>        &box,
                                    std::vector<SmoothPiece<dim>> &result) const
{
  if (is_smooth())
    return Shape<dim>::append_pieces(box, result);
  for (const auto &piece : pieces)
    result.emplace_back([&piece](const Point<dim> &x) { return piece.value(x); });
}

template <int dim>
double
ExpressionShape<dim>::signed_distance(const Point<dim> &x) const
{
  return expression.value(x);
}

template <int dim>
bool
ExpressionShape<dim>::is_distance() const
{
  return distance;
}

template <int dim>
bool
ExpressionShape<dim>::is_claimed_distance() const
{
  return distance;
}

template <int dim>
BoundingBox<dim>
ExpressionShape<dim>::bounding_box() const
{
  return unbounded_box<dim>();
}

template class ExpressionShape<2>;
template class ExpressionShape<3>;
} // namespace scree
