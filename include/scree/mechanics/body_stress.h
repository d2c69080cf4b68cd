#pragma once

#include <scree/mechanics/bulk.h>

namespace scree
{
/**
 * The stress of a body as its field has it, and as the forces on it have it: in equilibrium, with
 * a force f at each place x, int sigma = sum f x^T. Both are integrals over the body as the
 * equations have it, on a moving geometry at the end of the step.
 */
template <int dim>
struct BodyStress
{
  StressIntegral<dim>    integral;
  dealii::Tensor<1, dim> force;  //!< sum f of all but contact: conditions, body forces, inertia
  dealii::Tensor<2, dim> virial; //!< sum f x^T of these, x from the origin [force L]
};
} // namespace scree
