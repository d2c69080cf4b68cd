#pragma once

#include <scree/mechanics/prescribed_displacements.h>

namespace scree
{
/** Prescribed displacements with the stress vector of linear elasticity: all of it is linear. */
template <int dim>
class LinearNitsche : public PrescribedDisplacements<dim>
{
public:
  LinearNitsche(const BoundarySetting<dim> &setting, const std::vector<unsigned int> &own_regions);

private:
  std::vector<dealii::Tensor<1, dim>> fluxes(const unsigned int         region,
                                             const PointEvaluator<dim> &u) const override;
};
} // namespace scree
