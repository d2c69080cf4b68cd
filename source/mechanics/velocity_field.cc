#include <scree/mechanics/velocity_field.h>

namespace scree
{
template <int dim>
VelocityField<dim>::VelocityField(const Mass<dim>                             &mass,
                                  const dealii::TrilinosWrappers::MPI::Vector &u,
                                  const dealii::TrilinosWrappers::MPI::Vector &velocities)
    : field(mass.field(velocities))
{
  const auto where = mass.with_ghosts(u), v = mass.with_ghosts(velocities);
  for (const auto &body : mass.rigid().bodies())
    {
      const auto centre = body.rigid->reference_point + mass.pose(body, where).translation();
      rigid.emplace(body.body, RigidMotion{centre, mass.rigid().read(body, v, v)});
    }
}

template <int dim>
dealii::Tensor<1, dim>
VelocityField<dim>::value(const unsigned int body, const dealii::Point<dim> &x) const
{
  const auto found = rigid.find(body);
  if (found == rigid.end())
    return {};
  const auto &[centre, rates] = found->second;
  return rates.velocity + turned<dim>(rates.spin, x - centre);
}

template class VelocityField<2>;
template class VelocityField<3>;
} // namespace scree
