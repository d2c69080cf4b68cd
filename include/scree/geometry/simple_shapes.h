#pragma once

#include <scree/geometry/polygon_sides.h>
#include <scree/geometry/shape.h>

#include <deal.II/base/tensor.h>

namespace scree
{
/** A disc or ball: |x - centre| < radius. */
template <int dim>
class Ball : public Shape<dim>
{
public:
  Ball(const dealii::Point<dim> &centre, double radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

private:
  dealii::Point<dim> centre;
  double             radius;
};

/** An axis-aligned box between two corners. */
template <int dim>
class Box : public Shape<dim>
{
public:
  Box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> lower, upper;
};

/** The half-space behind the plane through `point` with the outward `normal` (of any length). */
template <int dim>
class HalfSpace : public Shape<dim>
{
public:
  HalfSpace(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &normal);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim>     point;
  dealii::Tensor<1, dim> normal;
};

/**
 * An axis-aligned ellipse or ellipsoid. The closest point `e_i^2 y_i / (t + e_i^2)` to y follows
 * from the largest root t of `sum_i (e_i y_i / (t + e_i^2))^2 = 1`, found by safeguarded Newton
 * steps (Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid",
 * Geometric Tools, 2013).
 */
template <int dim>
class Ellipse : public Shape<dim>
{
public:
  Ellipse(const dealii::Point<dim> &centre, const dealii::Point<dim> &semi_axes);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

private:
  dealii::Point<dim> centre, semi_axes;
};

/** The points between two concentric circles or spheres. */
template <int dim>
class Ring : public Shape<dim>
{
public:
  Ring(const dealii::Point<dim> &centre, double inner_radius, double outer_radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> centre;
  double             inner_radius, outer_radius;
};

/** The points within `radius` of the segment from `first` to `second`. */
template <int dim>
class Capsule : public Shape<dim>
{
public:
  Capsule(const dealii::Point<dim> &first, const dealii::Point<dim> &second, double radius);

  double signed_distance(const dealii::Point<dim> &x) const override;

  dealii::BoundingBox<dim> bounding_box() const override;

private:
  dealii::Point<dim> first, second;
  double             radius;
};

/** The inside of a closed polygon without crossing sides, its vertices in either orientation. */
class Polygon : public Shape<2>
{
public:
  explicit Polygon(const std::vector<dealii::Point<2>> &vertices);

  double signed_distance(const dealii::Point<2> &x) const override;

  dealii::BoundingBox<2> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<2> &box,
                     std::vector<SmoothPiece<2>>  &pieces) const override;

  /** Whether two sides of the polygon with these vertices cross or touch (beyond common vertices).
   */
  static bool crosses_itself(const std::vector<dealii::Point<2>> &vertices);

private:
  std::vector<dealii::Point<2>> vertices;
  PolygonSides                  sides;
};

/** |x/a|^n + |y/b|^n (+ |z/c|^n) < 1, n >= 1. The level set `(sum_i |x_i/a_i|^n)^{1/n} - 1` times
 * the least semi-axis. */
template <int dim>
class Superellipse : public Shape<dim>
{
public:
  Superellipse(const dealii::Point<dim> &centre, const dealii::Point<dim> &semi_axes,
               double exponent);

  double signed_distance(const dealii::Point<dim> &x) const override;

  bool is_distance() const override;

  dealii::BoundingBox<dim> bounding_box() const override;

  bool is_smooth() const override;

  void append_pieces(const dealii::BoundingBox<dim> &box,
                     std::vector<SmoothPiece<dim>>  &pieces) const override;

private:
  dealii::Point<dim> centre, semi_axes;
  double             exponent, least_axis;
};
} // namespace scree
