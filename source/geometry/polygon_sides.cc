#include <scree/geometry/polygon_sides.h>
#include <scree/geometry/segment.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
/** Parts of a length that are rounding. */
constexpr double rounding = 1e-12;

/** Twice the area of the triangle a, b, c; positive if it turns to the left. */
double
turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool
segments_meet(const Point<2> &a, const Point<2> &b, const Point<2> &c, const Point<2> &d)
{
  const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0)
    return true;
  const auto on_segment = [](const Point<2> &p, const Point<2> &q, const Point<2> &x) {
    return distance_to_segment(x, p, q) <= rounding * p.distance(q);
  };
  return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}
} // namespace

void
PolygonSides::Box::add(const Box &other)
{
  for (unsigned int d = 0; d < 2; ++d)
    {
      lower[d] = std::min(lower[d], other.lower[d]);
      upper[d] = std::max(upper[d], other.upper[d]);
    }
}

bool
PolygonSides::Box::meets(const Box &other) const
{
  return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1]
         && other.lower[1] <= upper[1];
}

double
PolygonSides::Box::squared_distance(const Point<2> &x) const
{
  double sum = 0.;
  for (unsigned int d = 0; d < 2; ++d)
    sum += std::pow(std::max({lower[d] - x[d], x[d] - upper[d], 0.}), 2);
  return sum;
}

PolygonSides::PolygonSides(const std::vector<Point<2>> &vertices)
    : vertices(vertices)
{
  build(0, 0, vertices.size());
}

PolygonSides::Box
PolygonSides::box_of(const std::size_t side) const
{
  const Point<2> &a = start(side), &b = end(side);
  Box             box;
  for (unsigned int d = 0; d < 2; ++d)
    {
      box.lower[d] = std::min(a[d], b[d]);
      box.upper[d] = std::max(a[d], b[d]);
    }
  return box;
}

void
PolygonSides::build(const std::size_t node, const std::size_t first, const std::size_t last)
{
  if (boxes.size() <= node)
    boxes.resize(2 * node + 1);
  Box box = box_of(first);
  if (last - first <= sides_of_leaf)
    for (std::size_t i = first + 1; i < last; ++i)
      box.add(box_of(i));
  else
    {
      const std::size_t middle = (first + last) / 2;
      build(2 * node + 1, first, middle);
      build(2 * node + 2, middle, last);
      box.add(boxes[2 * node + 1]);
      box.add(boxes[2 * node + 2]);
    }
  boxes[node] = box;
}

/** The nearest side so far, and whether a ray to the right crossed an odd number of sides. */
struct PolygonSides::Search
{
  double distance = std::numeric_limits<double>::max();
  bool   inside   = false;
};

void
PolygonSides::search(const Point<2> &x, const std::size_t node, const std::size_t first,
                     const std::size_t last, Search &found) const
{
  const Box &box       = boxes[node];
  const bool is_far    = box.squared_distance(x) >= found.distance * found.distance;
  const bool is_beside = box.upper[1] < x[1] || box.lower[1] > x[1] || box.upper[0] < x[0];
  if (is_far && (is_beside || box.lower[0] > x[0]))
    {
      // A chain to the right of x crosses the ray an odd number of times if its ends are on
      // either side of it.
      if (!is_beside && (start(first)[1] > x[1]) != (end(last - 1)[1] > x[1]))
        found.inside = !found.inside;
      return;
    }
  if (last - first <= sides_of_leaf)
    {
      for (std::size_t i = first; i < last; ++i)
        {
          const Point<2> &a = start(i), &b = end(i);
          found.distance = std::min(found.distance, distance_to_segment(x, a, b));
          if ((a[1] > x[1]) != (b[1] > x[1]) && (turn(a, b, x) > 0) == (b[1] > a[1]))
            found.inside = !found.inside;
        }
      return;
    }
  const std::size_t middle = (first + last) / 2;
  const bool        second_first
    = boxes[2 * node + 2].squared_distance(x) < boxes[2 * node + 1].squared_distance(x);
  for (const bool second : {second_first, !second_first})
    if (second)
      search(x, 2 * node + 2, middle, last, found);
    else
      search(x, 2 * node + 1, first, middle, found);
}

double
PolygonSides::signed_distance(const Point<2> &x) const
{
  Search found;
  search(x, 0, 0, vertices.size(), found);
  return found.inside ? -found.distance : found.distance;
}

bool
PolygonSides::conflict(const std::size_t i, const std::size_t j) const
{
  const Point<2> &a = start(i), &b = end(i), &c = start(j), &d = end(j);
  // Sides with a common vertex must not fold back onto each other.
  if (j != i + 1 && (j + 1) % vertices.size() != i)
    return segments_meet(a, b, c, d);
  const Point<2> &shared = j == i + 1 ? b : a, &p = j == i + 1 ? a : b, &q = j == i + 1 ? d : c;
  const double    scale = shared.distance(p) * shared.distance(q);
  return scale == 0
         || ((p - shared) * (q - shared) > 0 && std::abs(turn(shared, p, q)) <= rounding * scale);
}

bool
PolygonSides::any_conflict(const std::size_t i, const Box &box, const std::size_t node,
                           const std::size_t first, const std::size_t last) const
{
  if (last <= i + 1 || !boxes[node].meets(box))
    return false;
  if (last - first > sides_of_leaf)
    {
      const std::size_t middle = (first + last) / 2;
      return any_conflict(i, box, 2 * node + 1, first, middle)
             || any_conflict(i, box, 2 * node + 2, middle, last);
    }
  for (std::size_t j = std::max(first, i + 1); j < last; ++j)
    if (box_of(j).meets(box) && conflict(i, j))
      return true;
  return false;
}

bool
PolygonSides::cross() const
{
  const Box   &whole = boxes[0];
  const double margin
    = rounding * std::max(whole.upper[0] - whole.lower[0], whole.upper[1] - whole.lower[1]);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      Box box = box_of(i);
      for (unsigned int d = 0; d < 2; ++d)
        {
          box.lower[d] -= margin;
          box.upper[d] += margin;
        }
      if (any_conflict(i, box, 0, 0, vertices.size()))
        return true;
    }
  return false;
}
} // namespace scree
