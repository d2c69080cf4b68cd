#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <optional>

namespace scree
{
/**
 * A smooth part of a shape's boundary, such as a face of a box: a level set without kinks, negative
 * on the shape's side, whose zero contour contains the part and may go on beyond its edges. It
 * refers to its shape, which must outlive it.
 */
template <int dim>
class SmoothPiece
{
public:
  using LevelSet = std::function<double(const dealii::Point<dim> &)>;
  /** grad phi at a point, where points nearer than a length are on the contour; may be none. */
  using Gradient
    = std::function<std::optional<dealii::Tensor<1, dim>>(const dealii::Point<dim> &, double)>;

  /** The plane through `point` with the unit `normal` out of the shape. */
  SmoothPiece(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &normal);

  /** A curved piece, the level set in units of length. @param exact_gradient of it, if known */
  explicit SmoothPiece(const LevelSet &level_set, const Gradient &exact_gradient = {});

  /** The level set at `x` [L]; the distance to a plane. */
  double value(const dealii::Point<dim> &x) const;

  bool is_plane() const
  {
    return !level_set;
  }

  /** grad phi at `x`: a plane's normal, exact, or by central differences of width `step` [L]. */
  dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &x, const double step) const;

  /** The unit normal at `x`, out of the shape. */
  dealii::Tensor<1, dim> normal(const dealii::Point<dim> &x, const double step) const;

  /** A point of the contour next to `x`, along gradients: the nearest one of a distance. */
  dealii::Point<dim> foot(const dealii::Point<dim> &x, const double step) const;

  /** The same boundary of the outside. */
  SmoothPiece reversed() const;

  /** This piece after `x -> centre + R (x - centre) + translation`. */
  SmoothPiece moved(const dealii::Tensor<2, dim> &rotation, const dealii::Point<dim> &centre,
                    const dealii::Tensor<1, dim> &translation) const;

private:
  dealii::Point<dim>     point; // of a plane
  dealii::Tensor<1, dim> plane_normal;
  LevelSet               level_set; // empty: a plane
  Gradient               exact_gradient;
};
} // namespace scree
