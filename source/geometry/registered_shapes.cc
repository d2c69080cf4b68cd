#include <scree/geometry/ball.h>
#include <scree/geometry/box.h>
#include <scree/geometry/capsule.h>
#include <scree/geometry/combined_shape.h>
#include <scree/geometry/ellipse.h>
#include <scree/geometry/expression_shape.h>
#include <scree/geometry/half_space.h>
#include <scree/geometry/polygon.h>
#include <scree/geometry/ring.h>
#include <scree/geometry/superellipse.h>
#include <scree/geometry/surface_shape.h>

namespace scree
{
template <int dim>
const std::vector<ShapeFamily<dim>> &
registered_shapes()
{
  static const std::vector<ShapeFamily<dim>> families = {
    Ball<dim>::family(),    Box<dim>::family(),           HalfSpace<dim>::family(),
    Ellipse<dim>::family(), Ring<dim>::family(),          Capsule<dim>::family(),
    Polygon::family<dim>(), Superellipse<dim>::family(),  ExpressionShape<dim>::family(),
    surface_family<dim>(),  CombinedShape<dim>::family(),
  };
  return families;
}

template const std::vector<ShapeFamily<2>> &registered_shapes();
template const std::vector<ShapeFamily<3>> &registered_shapes();
} // namespace scree
