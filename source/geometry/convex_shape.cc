#include <scree/geometry/convex_shape.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
/** The angle [degrees] of a rotation and, in 3D, its axis: of the quaternion with the largest
 * component, which keeps its digits at half turns. */
template <int dim>
void
set_rotation(ShapeParameters<dim> &shape, const Tensor<2, dim> &r, const Point<dim> &centre)
{
  double angle = 0.;
  if constexpr (dim == 2)
    angle = std::atan2(r[1][0], r[0][0]);
  else
    {
      const double trace   = r[0][0] + r[1][1] + r[2][2];
      unsigned int largest = 3; // of 4 q_i^2, the real part last
      double       most    = 1. + trace;
      for (unsigned int i = 0; i < 3; ++i)
        if (const double square = 1. + 2. * r[i][i] - trace; square > most)
          {
            most    = square;
            largest = i;
          }
      Tensor<1, 3> q; // times 2 sqrt(most), as is the real part
      double       real = most;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          if (largest == 3)
            q[i] = r[k][j] - r[j][k];
          else
            q[i] = i == largest ? most : r[i][largest] + r[largest][i];
          if (i == largest)
            real = r[k][j] - r[j][k];
        }
      angle = 2. * std::atan2(q.norm(), real);
      q     = q.norm() > 0. ? q / q.norm() : Tensor<1, 3>({0., 0., 1.});
      shape.rotation_axis.assign(q.begin_raw(), q.end_raw());
    }
  shape.rotation_angle = angle * 180. / M_PI;
  shape.rotation_centre.assign(centre.begin_raw(), centre.end_raw());
}

double
cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/** Area, centroid and circumference of a polygon. */
struct PolygonMeasures
{
  double       area = 0., circumference = 0.;
  Tensor<1, 2> centroid;

  explicit PolygonMeasures(const std::vector<Point<2>> &corners)
  {
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
      {
        const double twice = cross(corners[j], corners[i]);
        area += 0.5 * twice;
        centroid += twice / 6. * (Tensor<1, 2>(corners[j]) + Tensor<1, 2>(corners[i]));
        circumference += corners[i].distance(corners[j]);
      }
    centroid /= area;
  }
};
} // namespace

template <int dim>
ConvexSuperellipse<dim>::ConvexSuperellipse(const Tensor<1, dim> &semi_axes, const double exponent)
    : semi_axes(semi_axes)
    , exponent(exponent)
{
  Assert(exponent >= 1., ExcMessage("The shape is not convex."));
}

template <int dim>
Tensor<1, dim>
ConvexSuperellipse<dim>::support(const Tensor<1, dim> &n) const
{
  Tensor<1, dim> x;
  double         largest = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    {
      x[d]    = semi_axes[d] * n[d];
      largest = std::max(largest, std::abs(x[d]));
    }
  if (exponent == 2.)
    {
      const double h = std::sqrt(x * x);
      for (unsigned int d = 0; d < dim; ++d)
        x[d] *= semi_axes[d] / h;
      return x;
    }
  if (exponent == 1.) // a corner
    {
      bool is_found = false;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const bool is_here = !is_found && std::abs(x[d]) == largest;
          is_found           = is_found || is_here;
          x[d]               = is_here ? std::copysign(semi_axes[d], x[d]) : 0.;
        }
      return x;
    }
  // x_i = a_i (y_i^q/sum y^q)^(1/n), y_i = a_i |n_i| over the largest.
  const double   q = exponent / (exponent - 1.);
  Tensor<1, dim> power;
  double         sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += power[d] = std::pow(std::abs(x[d]) / largest, q);
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = std::copysign(semi_axes[d] * std::pow(power[d] / sum, 1. / exponent), x[d]);
  return x;
}

template <int dim>
double
ConvexSuperellipse<dim>::outer_radius() const
{
  const double longest = *std::max_element(semi_axes.begin_raw(), semi_axes.end_raw());
  if (exponent <= 2.)
    return longest;
  // The largest |x|: x_i^2 = a_i^2 t_i^(2/n) with sum t_i = 1, t_i like a_i^(2n/(n-2)).
  const double p   = 2. * exponent / (exponent - 2.);
  double       sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += std::pow(semi_axes[d] / longest, p);
  return longest * std::pow(sum, 1. / p);
}

template <int dim>
bool
ConvexSuperellipse<dim>::is_round() const
{
  return exponent == 2.
         && std::all_of(semi_axes.begin_raw(), semi_axes.end_raw(),
                        [&](const double a) { return a == semi_axes[0]; });
}

template <int dim>
double
ConvexSuperellipse<dim>::volume() const
{
  if (exponent == 2.)
    return (dim == 2 ? 1. : 4. / 3. * semi_axes[dim - 1]) * semi_axes[0] * semi_axes[1]
           * numbers::PI;
  double product
    = std::pow(std::tgamma(1. + 1. / exponent), dim) / std::tgamma(1. + dim / exponent);
  for (unsigned int d = 0; d < dim; ++d)
    product *= 2. * semi_axes[d];
  return product;
}

template <int dim>
std::shared_ptr<const ConvexShape<dim>>
ConvexSuperellipse<dim>::scaled(const double factor) const
{
  Tensor<1, dim> axes;
  for (unsigned int d = 0; d < dim; ++d)
    axes[d] = factor * semi_axes[d];
  return std::make_shared<ConvexSuperellipse<dim>>(axes, exponent);
}

template <int dim>
ShapeParameters<dim>
ConvexSuperellipse<dim>::placed(const Point<dim> &centre, const Tensor<2, dim> &rotation) const
{
  const char *const type  = is_round()       ? (dim == 2 ? "disc" : "ball")
                            : exponent == 2. ? (dim == 2 ? "ellipse" : "ellipsoid")
                                             : "superellipse";
  auto              shape = ShapeParameters<dim>::of_type(type);
  const auto        list
    = [](const Tensor<1, dim> &x) { return std::vector<double>(x.begin_raw(), x.end_raw()); };
  shape.values["Centre"] = list(centre);
  if (is_round())
    {
      shape.values["Radius"] = semi_axes[0];
      return shape;
    }
  shape.values["Semi-axes"] = list(semi_axes);
  if (exponent != 2.)
    shape.values["Exponent"] = exponent;
  set_rotation(shape, rotation, centre);
  return shape;
}

ConvexPolygon::ConvexPolygon(const std::vector<Point<2>> &corners, const double radius)
    : corners(corners)
    , radius(radius)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
    Assert(cross(corners[i], corners[(i + 1) % corners.size()]) > 0.,
           ExcMessage("The corners are not counter-clockwise about the origin."));
}

std::shared_ptr<const ConvexPolygon>
ConvexPolygon::of_area(std::vector<Point<2>> corners, const double area, const double rounding)
{
  const PolygonMeasures m(corners);
  // A k^2 + r C k + pi r^2 = area, the corners scaled by k.
  const double r = rounding * std::sqrt(area / numbers::PI), half = 0.5 * r * m.circumference;
  const double rest = area - numbers::PI * r * r;
  const double k    = rest / (half + std::sqrt(half * half + m.area * rest));
  for (Point<2> &x : corners)
    x = Point<2>(k * (x - m.centroid));
  return std::make_shared<ConvexPolygon>(corners, r);
}

Tensor<1, 2>
ConvexPolygon::support(const Tensor<1, 2> &n) const
{
  const Point<2> *farthest = corners.data();
  for (const Point<2> &x : corners)
    if (n * x > n * *farthest)
      farthest = &x;
  return *farthest + radius * n;
}

double
ConvexPolygon::outer_radius() const
{
  double most = 0.;
  for (const Point<2> &x : corners)
    most = std::max(most, x.norm());
  return most + radius;
}

double
ConvexPolygon::volume() const
{
  const PolygonMeasures m(corners);
  return m.area + radius * m.circumference + numbers::PI * radius * radius;
}

std::shared_ptr<const ConvexShape<2>>
ConvexPolygon::scaled(const double factor) const
{
  std::vector<Point<2>> result = corners;
  for (Point<2> &x : result)
    x *= factor;
  return std::make_shared<ConvexPolygon>(result, factor * radius);
}

ShapeParameters<2>
ConvexPolygon::placed(const Point<2> &centre, const Tensor<2, 2> &rotation) const
{
  auto                  shape = ShapeParameters<2>::of_type("polygon");
  std::vector<Point<2>> vertices; // of the sides moved outwards
  const std::size_t     n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      Tensor<1, 2> in  = corners[i] - corners[(i + n - 1) % n],
                   out = corners[(i + 1) % n] - corners[i];
      in /= in.norm();
      out /= out.norm();
      // Where the moved sides cross: r (m + n)/(1 + m.n) from the corner, of their normals m and n.
      const Tensor<1, 2> normals({in[1] + out[1], -in[0] - out[0]});
      vertices.push_back(centre + rotation * (corners[i] + radius / (1. + in * out) * normals));
    }
  shape.values["Vertices"] = vertices;
  if (radius > 0.)
    shape.values["Corner radius"] = radius;
  return shape;
}

template class ConvexSuperellipse<2>;
template class ConvexSuperellipse<3>;
} // namespace scree
