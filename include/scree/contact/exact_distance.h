#pragma once

#include <scree/bodies/boundary_foot.h>

#include <utility>
#include <vector>

namespace scree
{
/**
 * The distances to the bodies where they are now from their shapes phi_0, where the lattices round
 * edges and corners by a part of a spacing: phi_0(X), X the initial position of x, of bodies that
 * stay and of rigid ones; of deformed ones the distance to the moved boundary phi_0(X(y)) = 0.
 * Nothing is known of bodies whose level sets are advected.
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

  /** value() and normal(), of one search. */
  std::pair<double, dealii::Tensor<1, dim>> value_and_normal(const unsigned int        body,
                                                             const dealii::Point<dim> &x) const;

  /** The unit normal out of the body. */
  dealii::Tensor<1, dim> normal(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The point of the boundary next to x. */
  dealii::Point<dim> foot(const unsigned int body, const dealii::Point<dim> &x) const;

  /** Whether edges or corners of the body may lie in a box. */
  bool is_kinked(const unsigned int body, const dealii::BoundingBox<dim> &box) const;

private:
  bool has_deformed(const unsigned int body) const
  {
    return !bodies[body].displacement.is_empty();
  }
  BoundaryFoot<dim> foot_and_normal(const unsigned int body, const dealii::Point<dim> &x) const;

  /** grad phi_0 by differences. */
  dealii::Tensor<1, dim> slope(const Shape<dim> &shape, const dealii::Point<dim> &X) const;

  const std::vector<Body<dim>> &bodies;
  double                        step;       //!< of differences [L]
  std::vector<bool>             is_slope_1; //!< everywhere, of the shapes
};
} // namespace scree
