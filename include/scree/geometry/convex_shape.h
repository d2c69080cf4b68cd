#pragma once

#include <scree/geometry/shape_parameters.h>

#include <memory>
#include <vector>

namespace scree
{
/**
 * A convex shape about the origin, which lies inside, by its support points. A new one is a
 * subclass here and a case in RandomShapes.
 */
template <int dim>
class ConvexShape
{
public:
  virtual ~ConvexShape() = default;

  /** The point x of the shape with the largest n.x, for a unit vector n. */
  virtual dealii::Tensor<1, dim> support(const dealii::Tensor<1, dim> &n) const = 0;

  /** The radius of the ball about the origin that contains it [L]. */
  virtual double outer_radius() const = 0;

  /** Whether it is that ball. */
  virtual bool is_round() const
  {
    return false;
  }

  /** Area or volume. */
  virtual double volume() const = 0;

  virtual std::shared_ptr<const ConvexShape> scaled(const double factor) const = 0;

  /** Section Shape of the shape when it is turned about its origin, which is then at `centre`. */
  virtual ShapeParameters<dim> placed(const dealii::Point<dim>     &centre,
                                      const dealii::Tensor<2, dim> &rotation) const = 0;
};

/** sum_i |x_i/a_i|^n <= 1, n >= 1: discs and balls, ellipses and ellipsoids, superellipses. */
template <int dim>
class ConvexSuperellipse : public ConvexShape<dim>
{
public:
  ConvexSuperellipse(const dealii::Tensor<1, dim> &semi_axes, const double exponent);

  /** x_i = a_i sign(n_i) (a_i |n_i|/h)^(q-1), h = (sum_i (a_i |n_i|)^q)^(1/q), 1/q + 1/n = 1. */
  dealii::Tensor<1, dim> support(const dealii::Tensor<1, dim> &n) const override;

  double outer_radius() const override;
  bool   is_round() const override;
  double volume() const override;

  std::shared_ptr<const ConvexShape<dim>> scaled(const double factor) const override;
  ShapeParameters<dim>                    placed(const dealii::Point<dim>     &centre,
                                                 const dealii::Tensor<2, dim> &rotation) const override;

private:
  dealii::Tensor<1, dim> semi_axes;
  double                 exponent;
};

/** All points within `radius` of a convex polygon: its sides moved outwards, rounded corners. */
class ConvexPolygon : public ConvexShape<2>
{
public:
  /** @param corners counter-clockwise about the origin */
  ConvexPolygon(const std::vector<dealii::Point<2>> &corners, const double radius);

  /** That of area `area` whose radius is `rounding` times that of the disc of this area, about the
   * centroid of the given corners. */
  static std::shared_ptr<const ConvexPolygon> of_area(std::vector<dealii::Point<2>> corners,
                                                      const double area, const double rounding);

  dealii::Tensor<1, 2> support(const dealii::Tensor<1, 2> &n) const override;

  double outer_radius() const override;
  double volume() const override;

  std::shared_ptr<const ConvexShape<2>> scaled(const double factor) const override;
  ShapeParameters<2>                    placed(const dealii::Point<2>     &centre,
                                               const dealii::Tensor<2, 2> &rotation) const override;

private:
  std::vector<dealii::Point<2>> corners;
  double                        radius;
};
} // namespace scree
