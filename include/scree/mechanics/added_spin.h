#pragma once

#include <scree/base/joint_sum.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace scree
{
/**
 * The spin that a one-step scheme gives masses by itself. It makes x = x_n + d and v = w + b of
 * impulses w - v_n at the start of the step and b at its end, whose moments change the angular
 * momentum about the centre of mass by
 *
 *     sum m (x_n x (w - v_n) + x x b) = sum m (x x v - x_n x v_n - d x w).
 *
 * What it has beyond that, sum m d x w, is of second order in the angle of a step, but of first
 * order under contact forces, which act where bodies touch at the end.
 */
template <int dim>
class AddedSpin
{
public:
  /** Of a mass that comes to x. */
  void add(const double m, const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &d,
           const dealii::Tensor<1, dim> &w);

  /** For the sum over all processes, before finish(). */
  void add_to(JointSum &sum);

  void finish();

  /** The velocity of the spin with the angular momentum sum m d x w at x; after finish(). */
  dealii::Tensor<1, dim> velocity(const dealii::Point<dim> &x) const;

private:
  double                 mass = 0.;
  dealii::Tensor<1, dim> centre, motion, momentum;
  dealii::Tensor<2, dim> second;        //!< sum m x x^T
  dealii::Tensor<1, 3>   angular, spin; //!< 2D: only the last component
};
} // namespace scree
