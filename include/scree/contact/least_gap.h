#pragma once

#include <scree/contact/contact_surface.h>
#include <scree/contact/exact_distance.h>

#include <array>
#include <optional>
#include <vector>

namespace scree
{
/**
 * Gives the quadrature of a cell's contact surface a point where the gap is least. Points at a
 * distance s from there see a gap that is s^2 / (2R) larger, 1/R the relative curvature of the
 * bodies: all that a contact narrower than a cell ever sees. The new point takes a share omega of
 * the surface, the others keep
 *
 *     w_q - omega lambda_q,  sum lambda_q = 1,  sum lambda_q (x_q - x) = 0 along the surface,
 *
 * so that linear functions are integrated as before and contacts of many cells stay as they are.
 */
template <int dim>
class LeastGap
{
public:
  LeastGap(const ExactDistances<dim> &distances, const std::vector<Body<dim>> &bodies,
           const ContactPair &pair);

  /**
   * Adds the point to those of a cell that are all open, if the bodies are nearest within it, two
   * cells around, open half a cell from there, and curved by at least 0.02 of a cell's edge.
   */
  void add_point(const GridCell<dim> &cell, std::vector<ContactPoint<dim>> &points);

private:
  using Tensor = dealii::Tensor<1, dim>;

  /** phi and grad phi of one body: exact where they are known around the cell, else of the cubic
   * interpolant. */
  std::pair<double, Tensor> distance(const unsigned int body, const dealii::Point<dim> &x) const;

  /** Where phi_a - phi_b = 0 along its gradient from x, to first order. */
  dealii::Point<dim> on_surface(const dealii::Point<dim> &x) const;

  /** phi_a + phi_b. On the surface it has no slope along the normal. */
  double gap(const dealii::Point<dim> &x) const;

  struct Minimum
  {
    dealii::Point<dim> x;
    double             curvature; //!< trace of the second derivatives of the gap [1/L]
  };
  /** The least gap near x by Newton's method with differences on the surface, over steps of up to a
   * cell. */
  std::optional<Minimum> minimum(const dealii::Point<dim> &x, const double size) const;

  /**
   * Whether the gap at x is the least two cells around and open half a cell from there: deformed
   * surfaces have small hollows beside their contact, wide contact reaches other points.
   */
  bool is_least(const dealii::Point<dim> &x, const double least_gap, const Tensor &normal,
                const double size) const;

  /** A contact point of this weight and gap there, on the same faces as `beside`. */
  ContactPoint<dim> point_at(const dealii::Point<dim> &x, const double weight,
                             const double least_gap, const ContactPoint<dim> &beside) const;

  const ExactDistances<dim>    &distances;
  const std::vector<Body<dim>> &bodies;
  const ContactPair            &pair;
  std::array<bool, 2>           is_known = {}; //!< the distance to a, to b, around the cell at hand
};
} // namespace scree
