#pragma once

#include <deal.II/base/tensor.h>

namespace scree
{
/** Resultant on the body of one condition: force, and moment about the origin. */
template <int dim>
struct Resultant
{
  dealii::Tensor<1, dim> force;
  dealii::Tensor<1, 3>   moment; //!< 2D: only the last component
};

/** Moment of a force at a position about the origin. */
template <int dim>
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, dim> &position,
                               const dealii::Tensor<1, dim> &force);
} // namespace scree
