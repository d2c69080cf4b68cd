#pragma once

#include <scree/geometry/polygon_sides.h>
#include <scree/geometry/shape.h>

#include <string>
#include <vector>

namespace scree
{
/**
 * The inside of a polygon whose corners, convex and re-entrant ones, are arcs of one radius that
 * touch both sides. The distance is exact and takes a time like the number of corners.
 */
class RoundedPolygon : public Shape<2>
{
public:
  /** @param radius [L] fits: see what_does_not_fit() */
  RoundedPolygon(const std::vector<dealii::Point<2>> &vertices, const double radius);

  double signed_distance(const dealii::Point<2> &x) const override;

  dealii::BoundingBox<2> bounding_box() const override;

  bool has_curvature_jumps() const override
  {
    return true;
  }

  /** Which side is too short for the arcs at its ends, or that they meet other sides; empty if they
   * fit. */
  static std::string what_does_not_fit(const std::vector<dealii::Point<2>> &vertices,
                                       const double                         radius);

private:
  struct Arc
  {
    dealii::Point<2> begin, end, centre;
  };

  /** The arcs of all corners; where a side goes on straight, they are points. */
  static std::vector<Arc> arcs_of(const std::vector<dealii::Point<2>> &vertices,
                                  const double                         radius);

  double           radius;
  std::vector<Arc> arcs;
  PolygonSides     chords; //!< the polygon with a chord for each arc
};
} // namespace scree
