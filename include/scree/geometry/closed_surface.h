#pragma once

#include <scree/geometry/triangle_soup.h>

#include <deal.II/base/bounding_box.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
/** A closed surface of triangles in a tree of boxes (CGAL), which knows distances and sections. */
class ClosedSurface
{
public:
  /**
   * Facets may be oriented in any way, they are turned outwards.
   *
   * @param name of the file, for messages
   * @throws UserError, with the number of a facet and its place, if the surface is open, has edges
   *   of more than two facets, facets without area, or parts apart, cannot be oriented, or crosses
   *   itself
   */
  ClosedSurface(const TriangleSoup &soup, const std::string &name);
  ~ClosedSurface();

  /** Negative inside. */
  double signed_distance(const dealii::Point<3> &x) const;

  /** The gradient of that: the direction from the nearest point, or within `near` [L] of the
   * surface the normal of a facet there. */
  dealii::Tensor<1, 3> gradient(const dealii::Point<3> &x, const double near) const;

  const dealii::BoundingBox<3> &bounding_box() const
  {
    return box;
  }

  /** The volume inside. */
  double volume() const;

  /**
   * The closed outlines in the plane where coordinate `axis` has the value `position`, by the other
   * two coordinates in their order.
   */
  std::vector<std::vector<dealii::Point<2>>> section(const unsigned int axis,
                                                     const double       position) const;

private:
  struct Tree;

  dealii::BoundingBox<3>      box;
  std::unique_ptr<const Tree> tree;
};
} // namespace scree
