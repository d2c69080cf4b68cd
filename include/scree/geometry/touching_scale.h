#pragma once

#include <scree/geometry/convex_shape.h>

#include <array>

namespace scree
{
/** A convex shape turned about its origin. */
template <int dim>
struct TurnedShape
{
  const ConvexShape<dim>       &shape;
  const dealii::Tensor<2, dim> &rotation;

  dealii::Tensor<1, dim> support(const dealii::Tensor<1, dim> &n) const
  {
    return rotation * shape.support(transpose(rotation) * n);
  }
};

/**
 * Where a search for the best plane may start: what the one before it found for the same two
 * shapes, which have moved a little since.
 */
template <int dim>
struct TouchGuess
{
  dealii::Tensor<1, dim>                  normal;  //!< of the best plane; zero: not known
  std::array<dealii::Tensor<1, dim>, dim> corners; //!< directions of the corners of the portal
  bool                                    has_corners = false;
};

/** How two shapes that grow about their centres touch. */
template <int dim>
struct Touch
{
  double                 scale;  //!< factor of both shapes at which they touch, or less
  dealii::Tensor<1, dim> normal; //!< unit vector, from a to b, of a plane between them then
  double                 reach;  //!< h_a + h_b: with factors s the gap along it is n.arm - s reach
  dealii::Tensor<1, dim> on_a, on_b; //!< where, of shapes that have not grown, from their centres
};

/**
 * The factor at which two convex shapes touch that grow about their centres: the largest n.arm /
 * (h_a(n) + h_b(-n)) over unit vectors n, h the support functions. For ellipses it is the root of
 * the contact function of Perram and Wertheim (J. Comput. Phys. 58, 409, 1985). The quotient of any
 * n is a lower bound: the plane across n lies between the shapes. The best n is the normal of the
 * boundary of the Minkowski sum of a and -b where the ray along `arm` leaves it, found by portal
 * refinement (Snethen, "XenoCollide", Game Programming Gems 7, 2008); for polygons in finitely many
 * steps.
 *
 * @param arm from the centre of a to that of b; not zero
 * @param tolerance relative error of the factor
 * @param enough a bound that ends the search
 * @param guess is taken and renewed
 */
template <int dim>
Touch<dim> touching_scale(const TurnedShape<dim> &a, const TurnedShape<dim> &b,
                          const dealii::Tensor<1, dim> &arm, const double tolerance,
                          const double enough, TouchGuess<dim> &guess);
} // namespace scree
