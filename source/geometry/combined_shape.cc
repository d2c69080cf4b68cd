#include <scree/geometry/combined_shape.h>

#include <algorithm>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
void
check_combined(const ShapeParameters<dim> &p, const ParameterSection &section)
{
  if (p.parts.size() == 1)
    section.error("Parts", "a combination needs at least 2 parts", "as in set Parts = a, b");
}

template <int dim>
ShapePointer<dim>
make_combined(const ShapeParameters<dim> &p)
{
  std::vector<ShapePointer<dim>> parts;
  for (const auto &part : p.parts)
    parts.push_back(make_shape(part.second));
  return std::make_unique<CombinedShape<dim>>(p.type == "union"        ? Combination::union_of
                                              : p.type == "difference" ? Combination::difference
                                                                       : Combination::intersection,
                                              std::move(parts));
}
} // namespace

template <int dim>
ShapeFamily<dim>
CombinedShape<dim>::family()
{
  return {{"union", "intersection", "difference"},
          "union, intersection and difference (the first without the others) of Parts",
          {},
          make_combined<dim>,
          check_combined<dim>,
          true};
}

template <int dim>
CombinedShape<dim>::CombinedShape(const Combination type, std::vector<ShapePointer<dim>> parts)
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
      result            = type == Combination::union_of     ? std::min(result, part)
                          : type == Combination::difference ? std::max(result, -part)
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
  if (type == Combination::difference)
    return result;
  for (std::size_t i = 1; i < parts.size(); ++i)
    {
      const BoundingBox<dim> part = parts[i]->bounding_box();
      if (type == Combination::union_of)
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
      if (type == Combination::difference && i > 0)
        for (std::size_t j = first; j < pieces.size(); ++j)
          pieces[j] = pieces[j].reversed();
    }
}

template class CombinedShape<2>;
template class CombinedShape<3>;
} // namespace scree
