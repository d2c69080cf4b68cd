#pragma once

#include <scree/geometry/touching_scale.h>

#include <deal.II/base/bounding_box.h>

namespace scree
{
/** A box, or the cylinder along z in it, a disc in 2D: its walls across x and y are one round one.
 */
template <int dim>
class PackingContainer
{
public:
  PackingContainer(const dealii::BoundingBox<dim> &box, const bool is_cylinder);

  double volume() const;

  bool contains(const dealii::Point<dim> &x) const;

  /** The directions d with a flat wall at either end: from this one on. */
  unsigned int first_flat() const
  {
    return is_cylinder ? 2 : 0;
  }

  /**
   * The outward normal of the round wall at the point of the shape, grown by `scale`, that is
   * farthest from the axis; zero if no point can reach the wall.
   */
  dealii::Tensor<1, dim> towards_round_wall(const TurnedShape<dim>   &shape,
                                            const dealii::Point<dim> &centre,
                                            const double              scale) const;

  /** From the axis, or from the middle in 2D, to x. */
  dealii::Tensor<1, dim> from_axis(const dealii::Point<dim> &x) const;

  const dealii::BoundingBox<dim> box;

  const bool is_cylinder;

  /** Of the cylinder. */
  const double radius;
};
} // namespace scree
