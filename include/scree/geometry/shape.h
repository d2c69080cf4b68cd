#pragma once

#include <scree/geometry/smooth_piece.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <memory>
#include <optional>
#include <vector>

namespace scree
{
/**
 * A body's geometry as a level set: negative inside. What a parameter file says about it, and how a
 * new one is added: ShapeFamily.
 */
template <int dim>
class Shape
{
public:
  virtual ~Shape() = default;

  /** The signed distance of `x` to the boundary, or another level set if !is_distance(). */
  virtual double signed_distance(const dealii::Point<dim> &x) const = 0;

  /**
   * The gradient of signed_distance(), if it is known without differences; within `near` [L] of the
   * boundary, where the direction to it is round-off, the normal there. None by default.
   */
  virtual std::optional<dealii::Tensor<1, dim>> exact_gradient(const dealii::Point<dim> &x,
                                                               const double near) const;

  /** Whether signed_distance() is a distance everywhere. */
  virtual bool is_distance() const;

  /** Whether that is a claim of the user, to be checked by require_distance(). */
  virtual bool is_claimed_distance() const;

  /** A box that contains the shape, `unbounded` in directions without an end. */
  virtual dealii::BoundingBox<dim> bounding_box() const = 0;

  /** Whether the boundary is a single piece without kinks: that of signed_distance(). */
  virtual bool is_smooth() const;

  /** Whether flat parts of a smooth boundary go over into arcs, where interpolants of degree 2
   * overshoot. */
  virtual bool has_curvature_jumps() const;

  /**
   * Appends the smooth pieces of the boundary that may pass through the closed `box`: where none
   * does, the box is inside or outside as a whole. Parts of them may not belong to the boundary.
   */
  virtual void append_pieces(const dealii::BoundingBox<dim> &box,
                             std::vector<SmoothPiece<dim>>  &pieces) const;

  static constexpr double unbounded = 1e300;
};

/** The box without an end in any direction. */
template <int dim>
dealii::BoundingBox<dim> unbounded_box();

/**
 * The pieces that bound `shape` within `radius` of `x`: one at a point of a face, several at edges
 * and corners, none away from the boundary.
 */
template <int dim>
std::vector<SmoothPiece<dim>> active_pieces(const Shape<dim> &shape, const dealii::Point<dim> &x,
                                            const double radius);

template <int dim>
using ShapePointer = std::unique_ptr<const Shape<dim>>;
} // namespace scree
