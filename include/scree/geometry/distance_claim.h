#pragma once

#include <scree/geometry/shape.h>

#include <string>

namespace scree
{
/**
 * Checks a shape that the user declared to be a signed distance: near its surface, phi grows by a
 * length per length. At points next to the surface (phi changes its sign on the way to the next
 * point), |grad phi| by central differences must lie in [0.9, 1.1] for four of five of them; edges
 * and corners have other values.
 *
 * @param spacing the distance of the points
 * @param box     where they are
 * @throws UserError, told as coming from the section `where`, if it is no distance
 */
template <int dim>
void require_distance(const Shape<dim> &shape, const double spacing,
                      const dealii::BoundingBox<dim> &box, const std::string &where);
} // namespace scree
