#include <scree/geometry/random_shapes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

double
uniform(std::mt19937_64 &random)
{
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

template <int dim>
double
root(const double x)
{
  double result = std::max(x, 1.);
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const double next
        = dim == 2 ? 0.5 * (result + x / result) : (2. * result + x / (result * result)) / 3.;
      if (!(next < result))
        break;
      result = next;
    }
  return result;
}

namespace
{
double
uniform_in(std::mt19937_64 &random, const std::vector<double> &range)
{
  return range[0] + uniform(random) * (range[1] - range[0]);
}

/** (cos, sin) of an angle in [-pi, pi] by their series: libraries differ in the last digit. */
Point<2>
on_unit_circle(const double angle)
{
  Point<2> result;
  double   term = 1.;
  for (unsigned int i = 0; i < 40; ++i)
    {
      result[i % 2] += i % 4 < 2 ? term : -term;
      term *= angle / (i + 1.);
    }
  return result;
}

/** Uniform on the unit sphere of n dimensions: points of the cube that lie in the ball. */
template <int n>
Tensor<1, n>
random_unit_vector(std::mt19937_64 &random)
{
  Tensor<1, n> x;
  double       square = 0.;
  do
    {
      for (unsigned int d = 0; d < n; ++d)
        x[d] = 2. * uniform(random) - 1.;
      square = x * x;
    }
  while (square > 1. || square < 1e-4);
  return x / std::sqrt(square);
}

/** Corners on the unit circle at equal angles, or at angles that differ from these by up to a
 * quarter of the step. */
std::vector<Point<2>>
corners_on_circle(const unsigned int n, const bool is_regular, std::mt19937_64 &random)
{
  std::vector<Point<2>> corners;
  const double          step = 2. * numbers::PI / n;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double place = i + (is_regular ? 0.5 : 0.25 + 0.5 * uniform(random));
      corners.push_back(on_unit_circle(step * place - numbers::PI));
    }
  return corners;
}
} // namespace

template <int dim>
std::shared_ptr<const ConvexShape<dim>>
RandomShapes<dim>::draw(std::mt19937_64 &random) const
{
  const double   radius = 1. + uniform(random) * (size_ratio - 1.);
  Tensor<1, dim> axes;
  for (unsigned int d = 0; d < dim; ++d)
    axes[d] = 1.;
  if (type != RandomShapeType::ball)
    {
      const double first = uniform_in(random, aspect);
      if constexpr (dim == 2)
        {
          axes[0] = std::sqrt(first);
          axes[1] = 1. / axes[0];
        }
      else
        {
          const double second = uniform_in(random, second_aspect);
          axes[2]             = 1. / root<3>(first * second * second);
          axes[1]             = second * axes[2];
          axes[0]             = first * axes[1];
        }
    }
  if constexpr (dim == 2)
    if (type == RandomShapeType::regular_polygon || type == RandomShapeType::random_polygon)
      {
        const unsigned int n
          = corners[0]
            + static_cast<unsigned int>(uniform(random) * (corners[1] + 1. - corners[0]));
        auto points = corners_on_circle(n, type == RandomShapeType::regular_polygon, random);
        for (Point<2> &x : points)
          x = Point<2>(axes[0] * x[0], axes[1] * x[1]);
        return ConvexPolygon::of_area(points, numbers::PI * radius * radius, rounding);
      }
  double n = 2., factor = radius;
  if (type == RandomShapeType::superellipsoid)
    {
      n                          = exponent;
      const Tensor<1, dim> unit  = axes;
      const double         ball  = dim == 2 ? numbers::PI : 4. / 3. * numbers::PI;
      const double         ratio = ball / ConvexSuperellipse<dim>(unit, n).volume();
      factor *= root<dim>(ratio);
    }
  return std::make_shared<ConvexSuperellipse<dim>>(factor * axes, n);
}

template <int dim>
Tensor<2, dim>
RandomShapes<dim>::draw_rotation(std::mt19937_64 &random) const
{
  Tensor<2, dim> r = unit_symmetric_tensor<dim>();
  if (type == RandomShapeType::ball)
    return r;
  if constexpr (dim == 2)
    {
      const Tensor<1, 2> x = random_unit_vector<2>(random);
      r[0][0] = r[1][1] = x[0];
      r[1][0]           = x[1];
      r[0][1]           = -x[1];
    }
  else
    {
      // The rotation of a unit quaternion: 1 + 2 q0 Q + 2 Q^2, Q the cross product by (q1, q2, q3).
      const Tensor<1, 4> q = random_unit_vector<4>(random);
      Tensor<2, 3>       cross;
      for (unsigned int i = 0; i < 3; ++i)
        {
          cross[(i + 2) % 3][(i + 1) % 3] = q[i + 1];
          cross[(i + 1) % 3][(i + 2) % 3] = -q[i + 1];
        }
      r += 2. * (q[0] * cross + cross * cross);
    }
  return r;
}

template double root<2>(const double);
template double root<3>(const double);
template struct RandomShapes<2>;
template struct RandomShapes<3>;
} // namespace scree
