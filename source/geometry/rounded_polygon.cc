#include <scree/base/log.h>
#include <scree/geometry/rounded_polygon.h>
#include <scree/geometry/segment.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
double
cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/** Begins and ends of the arcs, each point once. */
template <typename Arcs>
std::vector<Point<2>>
corners_of_chords(const Arcs &arcs)
{
  std::vector<Point<2>> corners;
  for (const auto &arc : arcs)
    for (const Point<2> &x : {arc.begin, arc.end})
      if (corners.empty() || x.distance(corners.back()) > 1e-12 * x.distance(arcs[0].centre))
        corners.push_back(x);
  if (corners.back().distance(corners[0]) <= 1e-12 * corners[0].distance(arcs[0].centre))
    corners.pop_back();
  return corners;
}
} // namespace

std::vector<RoundedPolygon::Arc>
RoundedPolygon::arcs_of(const std::vector<Point<2>> &vertices, const double radius)
{
  std::vector<Arc>  arcs;
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      const Point<2>    &corner = vertices[i];
      const Tensor<1, 2> in     = corner - vertices[(i + n - 1) % n];
      const Tensor<1, 2> out    = vertices[(i + 1) % n] - corner;
      const Tensor<1, 2> along = in / in.norm(), next = out / out.norm();
      const double       turn    = std::atan2(cross(along, next), along * next);
      const double       trim    = radius * std::abs(std::tan(0.5 * turn));
      const Tensor<1, 2> to_left = Point<2>(-along[1], along[0]);
      const Point<2>     begin   = corner - trim * along;
      const Point<2>     centre  = begin + (turn < 0. ? -radius : radius) * to_left;
      arcs.push_back({begin, corner + trim * next, centre});
    }
  return arcs;
}

RoundedPolygon::RoundedPolygon(const std::vector<Point<2>> &vertices, const double radius)
    : radius(radius)
    , arcs(arcs_of(vertices, radius))
    , chords(corners_of_chords(arcs))
{
}

double
RoundedPolygon::signed_distance(const Point<2> &x) const
{
  double distance  = Shape<2>::unbounded;
  bool   is_inside = chords.signed_distance(x) < 0.;
  for (std::size_t i = 0; i < arcs.size(); ++i)
    {
      const Arc &arc = arcs[i];
      distance
        = std::min(distance, distance_to_segment(x, arc.end, arcs[(i + 1) % arcs.size()].begin));
      const Tensor<1, 2> from = arc.begin - arc.centre, to = arc.end - arc.centre;
      const Tensor<1, 2> ray = x - arc.centre;
      const double       way = cross(from, to) > 0. ? 1. : -1.; // counter-clockwise or not
      if (way * cross(from, ray) < 0. || way * cross(ray, to) < 0.)
        continue;
      distance = std::min(distance, std::abs(ray.norm() - radius));
      // Between chord and arc the corner is, or is not, part of the shape, other than its chord
      // says.
      if (ray.norm_square() < radius * radius
          && way * cross(arc.end - arc.begin, x - arc.begin) < 0.)
        is_inside = !is_inside;
    }
  return is_inside ? -distance : distance;
}

BoundingBox<2>
RoundedPolygon::bounding_box() const
{
  // Arcs that bulge towards an axis touch the box of their circle there.
  Point<2>   lower(Shape<2>::unbounded, Shape<2>::unbounded), upper = -1. * lower;
  const auto add = [&](const Point<2> &x) {
    for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] = std::min(lower[d], x[d]);
        upper[d] = std::max(upper[d], x[d]);
      }
  };
  for (const Arc &arc : arcs)
    {
      add(arc.begin);
      add(arc.end);
      const Tensor<1, 2> from = arc.begin - arc.centre, to = arc.end - arc.centre;
      const double       way = cross(from, to) > 0. ? 1. : -1.;
      for (unsigned int d = 0; d < 2; ++d)
        for (const double sign : {-1., 1.})
          {
            const Tensor<1, 2> ray = sign * radius * Point<2>::unit_vector(d);
            if (way * cross(from, ray) > 0. && way * cross(ray, to) > 0.)
              add(arc.centre + ray);
          }
    }
  return BoundingBox<2>({lower, upper});
}

std::string
RoundedPolygon::what_does_not_fit(const std::vector<Point<2>> &vertices, const double radius)
{
  const auto        arcs = arcs_of(vertices, radius);
  const std::size_t n    = vertices.size();
  for (std::size_t i = 0; i < n; ++i)
    {
      const Point<2> &a = vertices[i], &b = vertices[(i + 1) % n];
      const double    used = a.distance(arcs[i].end) + b.distance(arcs[(i + 1) % n].begin);
      if (used > a.distance(b) * (1. + 1e-12))
        return "the side from " + short_place(a) + " to " + short_place(b)
               + " is shorter than its rounded ends, which need " + short_number(used);
    }
  if (PolygonSides(corners_of_chords(arcs)).cross())
    return "rounded corners meet other sides";
  return "";
}
} // namespace scree
