#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace scree
{
/**
 * What acts on a deformable body, added up: contact, tractions, springs, supports, body forces. In
 * equilibrium force and moment vanish, but for what the tolerance of the iteration and round-off
 * leave. With it, the rigid part of the body's displacement.
 */
template <int dim>
struct BodyBalance
{
  unsigned int           body = 0;
  dealii::Tensor<1, dim> force;
  dealii::Tensor<1, 3>   moment;           //!< about the mean of the nodes; 2D: last component only
  double                 force_scale = 0.; //!< sum of the |forces| at nodes and points
  double                 radius      = 0.; //!< of gyration of the nodes [L]
  double                 n_nodes     = 0.;
  double                 rotation    = 0.; //!< angle of the rotation that fits u best
  double                 strain      = 0.; //!< norm of that of the linear u that fits best
  double                 largest_u   = 0.; //!< largest |u|
};
} // namespace scree
