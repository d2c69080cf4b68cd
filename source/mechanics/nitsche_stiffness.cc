#include <scree/mechanics/bulk.h>
#include <scree/mechanics/nitsche_stiffness.h>

#include <algorithm>

namespace scree
{
template <int dim>
NitscheStiffness<dim>::NitscheStiffness(const BoundarySetting<dim> &setting)
    : space(setting.space)
    , bodies(setting.bodies)
    , bulk(setting.kinematics.bulk())
{
}

template <int dim>
double
NitscheStiffness<dim>::flow_ratio(const unsigned int active_cell) const
{
  // Enough for the flux of a body that is unloaded and elastic again.
  constexpr double smallest = 0.1;
  return std::max(smallest, bulk.secant_ratio(active_cell));
}

template <int dim>
double
NitscheStiffness<dim>::pointwise_share(const BoundaryRegion<dim> &region,
                                       const unsigned int         q) const
{
  if (!is_nitsche(region))
    return 1.;
  const auto  &material = *bodies[region.body].material;
  const double mu       = material.shear_modulus();
  return flow_ratio(region.points[q].active_cell)
         * (2. * mu + std::min(material.lame_lambda(), IsotropicModuli::largest_ratio * mu))
         / material.p_wave_modulus();
}

template <int dim>
double
NitscheStiffness<dim>::of_point(const BoundaryRegion<dim> &region, const unsigned int q) const
{
  return pointwise_share(region, q) * region.condition->parameters.penalty_factor
         * space.trace_factor() * bodies[region.body].material->p_wave_modulus()
         / space.cell_size(region.points[q].active_cell);
}

template <int dim>
double
NitscheStiffness<dim>::of_moments(const BoundaryRegion<dim> &region, const unsigned int q) const
{
  const double share = pointwise_share(region, q);
  return share >= 1. ? 0. : of_point(region, q) / share * (1. - share);
}

template class NitscheStiffness<2>;
template class NitscheStiffness<3>;
} // namespace scree
