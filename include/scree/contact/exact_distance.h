#pragma once

#include <scree/bodies/body.h>

#include <optional>
#include <vector>

namespace scree
{
/**
 * The distances to the bodies from their shapes phi_0, where the lattices round edges and corners
 * by a part of a spacing: phi_0(X), X the initial position of x, of bodies that stay and of rigid
 * ones. Nothing is known of deformable bodies on a moving geometry.
 */
template <int dim>
class ExactDistances
{
public:
  /** @param size of the finest cells [L] */
  ExactDistances(const std::vector<Body<dim>> &bodies, const double size);

  /** Whether the distance to the body is known near x: its shape tells distances there. */
  bool is_known(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The signed distance where it is known [L]. */
  double value(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The unit normal out of the body. */
  dealii::Tensor<1, dim> normal(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The point of the boundary next to x. */
  dealii::Point<dim> foot(const unsigned int body, const dealii::Point<dim> &x) const;

  /** Whether edges or corners of the body may lie in a box. */
  bool is_kinked(const unsigned int body, const dealii::BoundingBox<dim> &box) const;

private:
  /** Where a point of the body was at the start. */
  dealii::Point<dim> initial_position(const unsigned int body, const dealii::Point<dim> &x) const
  {
    return poses[body] ? poses[body]->initial_position(x) : x;
  }
  dealii::Tensor<1, dim> gradient(const unsigned int body, const dealii::Point<dim> &x) const;

  const std::vector<Body<dim>>              &bodies;
  double                                     step; //!< of differences [L]
  std::vector<std::optional<RigidPose<dim>>> poses;
};
} // namespace scree
