#include <scree/geometry/shape.h>

namespace scree
{
template <int dim>
bool
Shape<dim>::is_distance() const
{
  return true;
}

const EnumNames<ShapeType> &
shape_type_names()
{
  static const EnumNames<ShapeType> names = {{ShapeType::ball, "disc"},
                                             {ShapeType::ball, "ball"},
                                             {ShapeType::box, "box"},
                                             {ShapeType::half_space, "half space"},
                                             {ShapeType::ellipse, "ellipse"},
                                             {ShapeType::ellipse, "ellipsoid"},
                                             {ShapeType::ring, "ring"},
                                             {ShapeType::capsule, "capsule"},
                                             {ShapeType::polygon, "polygon"},
                                             {ShapeType::superellipse, "superellipse"},
                                             {ShapeType::expression, "expression"},
                                             {ShapeType::union_of, "union"},
                                             {ShapeType::intersection, "intersection"},
                                             {ShapeType::difference, "difference"}};
  return names;
}

template class Shape<2>;
template class Shape<3>;
} // namespace scree
