#pragma once

#include <scree/bodies/body.h>

#include <optional>

namespace scree
{
/** The point of a body's boundary next to a place. */
template <int dim>
struct BoundaryFoot
{
  dealii::Point<dim>     point;
  dealii::Tensor<1, dim> normal;   //!< unit, out of the body
  double                 distance; //!< signed, negative inside [L]
};

/**
 * The point y of the boundary next to `x` where a deformed body is now. Of its shape, phi_0 with
 * the smooth pieces phi_i, every set S of up to dim pieces near x has the point
 *
 *     y_S = argmin |y - x|  with  phi_i(X(y)) = 0 for i in S,
 *
 * by Newton's method on the constraints; y is the nearest of those with phi_0(X(y_S)) = 0: on a
 * face, an edge or a corner, convex or not. The normal is that of the face, beyond edges and
 * corners it has the direction of x - y. Nothing if no set converges.
 */
template <int dim>
std::optional<BoundaryFoot<dim>> foot_on_boundary(const Body<dim>          &body,
                                                  const dealii::Point<dim> &x);

/**
 * Sets the level set of a deformed body to the distance to its moved boundary, phi_0(X) of a shape
 * that tells distances. Nodes farther than `reach` [L] keep phi_0(X), in which a stretch across the
 * boundary changes the slope.
 */
template <int dim>
void set_moved_distances(Body<dim> &body, const double reach);
} // namespace scree
