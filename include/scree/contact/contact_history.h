#pragma once

#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
/** What contact points remember from step to step. */
template <int dim>
struct ContactHistory
{
  std::vector<dealii::Tensor<1, dim>> tau;      //!< tangential traction on b
  std::vector<dealii::Tensor<1, dim>> jump;     //!< [[u]]
  std::vector<double>                 pressure; //!< of tied points, and of all with multipliers
};
} // namespace scree
