#include <scree/geometry/composed_shapes.h>

#include <algorithm>

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
BoundingBox<dim>
ExpressionShape<dim>::bounding_box() const
{
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = -Shape<dim>::unbounded;
      upper[d] = Shape<dim>::unbounded;
    }
  return BoundingBox<dim>({lower, upper});
}

template <int dim>
MovedShape<dim>::MovedShape(ShapePointer<dim> shape, const Tensor<2, dim> &rotation,
                            const Point<dim> &centre, const Tensor<1, dim> &translation)
    : shape(std::move(shape))
    , rotation(rotation)
    , centre(centre)
    , translation(translation)
{
}

template <int dim>
double
MovedShape<dim>::signed_distance(const Point<dim> &x) const
{
  return shape->signed_distance(centre + transpose(rotation) * (x - translation - centre));
}

template <int dim>
bool
MovedShape<dim>::is_distance() const
{
  return shape->is_distance();
}

template <int dim>
BoundingBox<dim>
MovedShape<dim>::bounding_box() const
{
  const BoundingBox<dim>  box = shape->bounding_box();
  std::vector<Point<dim>> corners;
  for (unsigned int v = 0; v < (1u << dim); ++v)
    corners.push_back(centre + rotation * (box.vertex(v) - centre) + translation);
  return BoundingBox<dim>(corners);
}

template <int dim>
bool
MovedShape<dim>::is_smooth() const
{
  return shape->is_smooth();
}

template <int dim>
void
MovedShape<dim>::append_pieces(const BoundingBox<dim>        &box,
                               std::vector<SmoothPiece<dim>> &pieces) const
{
  std::vector<Point<dim>> corners;
  for (unsigned int v = 0; v < (1u << dim); ++v)
    corners.push_back(centre + transpose(rotation) * (box.vertex(v) - translation - centre));
  std::vector<SmoothPiece<dim>> unmoved;
  shape->append_pieces(BoundingBox<dim>(corners), unmoved);
  for (const auto &piece : unmoved)
    pieces.push_back(piece.moved(rotation, centre, translation));
}

template <int dim>
CombinedShape<dim>::CombinedShape(const ShapeType type, std::vector<ShapePointer<dim>> parts)
    : type(type)
    , parts(std::move(parts))
{
  Assert(!this->parts.empty(), ExcMessage("A combination needs parts."));
}

template <int dim>
double
CombinedShape<dim>::signed_distance(const Point<dim> &x) const
{
  double result = parts[0]->signed_distance(x);
  for (std::size_t i = 1; i < parts.size(); ++i)
    {
      const double part = parts[i]->signed_distance(x);
      result            = type == ShapeType::union_of     ? std::min(result, part)
                          : type == ShapeType::difference ? std::max(result, -part)
                                                          : std::max(result, part);
    }
  return result;
}

template <int dim>
bool
CombinedShape<dim>::is_distance() const
{
  return false;
}

template <int dim>
BoundingBox<dim>
CombinedShape<dim>::bounding_box() const
{
  BoundingBox<dim> result = parts[0]->bounding_box();
  if (type == ShapeType::difference)
    return result;
  for (std::size_t i = 1; i < parts.size(); ++i)
    {
      const BoundingBox<dim> part = parts[i]->bounding_box();
      if (type == ShapeType::union_of)
        {
          result.merge_with(part);
          continue;
        }
      auto &[lower, upper] = result.get_boundary_points();
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::max(lower[d], part.lower_bound(d));
          upper[d] = std::max(lower[d], std::min(upper[d], part.upper_bound(d)));
        }
    }
  return result;
}

template <int dim>
bool
CombinedShape<dim>::is_smooth() const
{
  return parts.size() == 1 && parts[0]->is_smooth();
}

template <int dim>
void
CombinedShape<dim>::append_pieces(const BoundingBox<dim>        &box,
                                  std::vector<SmoothPiece<dim>> &pieces) const
{
  for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const std::size_t first = pieces.size();
      parts[i]->append_pieces(box, pieces);
      if (type == ShapeType::difference && i > 0)
        for (std::size_t j = first; j < pieces.size(); ++j)
          pieces[j] = pieces[j].reversed();
    }
}

#define INSTANTIATE(dim)               \
  template class ExpressionShape<dim>; \
  template class MovedShape<dim>;      \
  template class CombinedShape<dim>;

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
