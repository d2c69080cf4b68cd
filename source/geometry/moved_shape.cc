#include <scree/geometry/moved_shape.h>

#include <cmath>

namespace scree
{
using namespace dealii;

template <int dim>
MovedShape<dim>::MovedShape(std::shared_ptr<const Shape<dim>> shape, const Tensor<2, dim> &rotation,
                            const Point<dim> &centre, const Tensor<1, dim> &translation)
    : shape(std::move(shape))
    , rotation(rotation)
    , centre(centre)
    , translation(translation)
{
}

template <int dim>
Point<dim>
MovedShape<dim>::unmoved(const Point<dim> &x) const
{
  return centre + transpose(rotation) * (x - translation - centre);
}

template <int dim>
double
MovedShape<dim>::signed_distance(const Point<dim> &x) const
{
  return shape->signed_distance(unmoved(x));
}

template <int dim>
std::optional<Tensor<1, dim>>
MovedShape<dim>::exact_gradient(const Point<dim> &x, const double near) const
{
  const auto gradient = shape->exact_gradient(unmoved(x), near);
  if (!gradient)
    return {};
  return rotation * *gradient;
}

template <int dim>
bool
MovedShape<dim>::is_distance() const
{
  return shape->is_distance();
}

template <int dim>
bool
MovedShape<dim>::is_claimed_distance() const
{
  return shape->is_claimed_distance();
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
bool
MovedShape<dim>::has_curvature_jumps() const
{
  return shape->has_curvature_jumps();
}

template <int dim>
void
MovedShape<dim>::append_pieces(const BoundingBox<dim>        &box,
                               std::vector<SmoothPiece<dim>> &pieces) const
{
  std::vector<Point<dim>> corners;
  for (unsigned int v = 0; v < (1u << dim); ++v)
    corners.push_back(unmoved(box.vertex(v)));
  std::vector<SmoothPiece<dim>> before;
  shape->append_pieces(BoundingBox<dim>(corners), before);
  for (const auto &piece : before)
    pieces.push_back(piece.moved(rotation, centre, translation));
}

template <int dim>
Tensor<2, dim>
rotation_matrix(const double degrees, const std::vector<double> &axis)
{
  const double   angle = degrees * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
  Tensor<2, dim> result;
  if constexpr (dim == 2)
    {
      result[0][0] = result[1][1] = c;
      result[0][1]                = -s;
      result[1][0]                = s;
    }
  else
    {
      Tensor<1, 3> n({axis[0], axis[1], axis[2]});
      n /= n.norm();
      for (unsigned int i = 0; i < 3; ++i)
        {
          result[i][i] = c;
          for (unsigned int j = 0; j < 3; ++j)
            result[i][j] += (1 - c) * n[i] * n[j];
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          result[k][j] += s * n[i];
          result[j][k] -= s * n[i];
        }
    }
  return result;
}

template class MovedShape<2>;
template class MovedShape<3>;
template Tensor<2, 2> rotation_matrix(const double, const std::vector<double> &);
template Tensor<2, 3> rotation_matrix(const double, const std::vector<double> &);
} // namespace scree
