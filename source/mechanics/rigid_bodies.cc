#include <scree/base/exceptions.h>
#include <scree/base/joint_sum.h>
#include <scree/mechanics/rigid_bodies.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
RigidBodies<dim>::RigidBodies(const DisplacementSpace<dim> &space,
                              const std::vector<Body<dim>> &bodies,
                              const ContactPoints<dim>     &contact)
    : space(space)
    , bodies(bodies)
    , contact(contact)
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      rigid_bodies.push_back(b);
  for_owned([&](const RigidBody<dim> &rigid, const unsigned int m, const DofIndex unknown) {
    if (!rigid.is_free(m))
      prescribed_unknowns.push_back(unknown);
  });
}

template <int dim>
std::vector<std::vector<DofIndex>>
RigidBodies<dim>::couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const unsigned int b : rigid_bodies)
    {
      result.emplace_back();
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        result.back().push_back(space.rigid_unknown(b) + m);
    }
  return result;
}

template <int dim>
void
RigidBodies<dim>::set(Vector &u, const double time) const
{
  for_owned([&](const RigidBody<dim> &rigid, const unsigned int m, const DofIndex unknown) {
    if (!rigid.is_free(m))
      u(unknown) = rigid.value(m, time) * (m < dim ? 1. : rigid.radius);
  });
  u.compress(dealii::VectorOperation::insert);
}

template <int dim>
dealii::Tensor<1, 3>
RigidBodies<dim>::applied_moment(const unsigned int body, const double time) const
{
  dealii::Tensor<1, 3> moment;
  for (unsigned int m = dim; m < n_rigid_components<dim>; ++m)
    if (bodies[body].rigid->is_free(m))
      moment[rotation_axis<dim>(m)] = bodies[body].rigid->value(m, time);
  return moment;
}

template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, 3>>
RigidBodies<dim>::applied_load(const unsigned int body, const double time) const
{
  dealii::Tensor<1, dim> force;
  for (unsigned int d = 0; d < dim; ++d)
    if (bodies[body].rigid->is_free(d))
      force[d] = bodies[body].rigid->value(d, time);
  return {force, applied_moment(body, time)};
}

template <int dim>
typename RigidPose<dim>::Load
RigidBodies<dim>::weight(const unsigned int body, const double time) const
{
  const RigidBody<dim>         &rigid = *bodies[body].rigid;
  typename RigidPose<dim>::Load result;
  if (rigid.density > 0.)
    result.add(rigid.moments.centre - rigid.reference_point,
               rigid.moments.volume * bodies[body].weight(time));
  return result;
}

template <int dim>
RigidPose<dim>
RigidBodies<dim>::pose(const unsigned int body, const Vector &u) const
{
  return RigidPose<dim>(*bodies[body].rigid, rigid_unknowns(space, body, u));
}

template <int dim>
void
RigidBodies<dim>::applied(const Vector &u, const double time, Vector &forces) const
{
  for (const unsigned int b : rigid_bodies)
    {
      const RigidBody<dim> &rigid     = *bodies[b].rigid;
      const auto            where     = pose(b, u);
      const auto            moment    = where.generalised_moment(applied_moment(b, time));
      const auto            of_weight = where.generalised_force(weight(b, time));
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        {
          const DofIndex unknown = space.rigid_unknown(b) + m;
          if (rigid.is_free(m) && space.owned().is_element(unknown))
            forces(unknown)
              = of_weight[m] + (m < dim ? rigid.value(m, time) : moment[rotation_axis<dim>(m)]);
        }
    }
  forces.compress(dealii::VectorOperation::insert);
}

template <int dim>
void
RigidBodies<dim>::add_to_matrix(const Vector &u, const double time,
                                dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  for (const unsigned int b : rigid_bodies)
    {
      const dealii::Tensor<1, 3> moment = applied_moment(b, time);
      const auto                 load   = weight(b, time);
      const DofIndex             first  = space.rigid_unknown(b);
      if ((moment.norm() == 0. && load.couple.norm() == 0.) || !space.owned().is_element(first))
        continue;
      const auto where      = pose(b, u);
      const auto derivative = where.generalised_moment_derivative(moment) + where.curvature(load);
      for (unsigned int m = dim; m < n_rigid_components<dim>; ++m)
        for (unsigned int n = dim; n < n_rigid_components<dim>; ++n)
          if (bodies[b].rigid->is_free(m) && bodies[b].rigid->is_free(n))
            matrix.add(first + m, first + n,
                       -derivative[rotation_axis<dim>(m)][rotation_axis<dim>(n)]);
    }
}

template <int dim>
bool
RigidBodies<dim>::is_symmetric(const double time) const
{
  return dim == 2 || std::all_of(rigid_bodies.begin(), rigid_bodies.end(), [&](const unsigned b) {
           return applied_moment(b, time).norm() == 0.;
         });
}

template <int dim>
std::vector<double>
RigidBodies<dim>::stiffness_scales(const std::vector<unsigned int> &free_bodies) const
{
  std::vector<double> moduli(bodies.size(), 0.);
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    for (const unsigned int b : {contact.pairs()[p].a, contact.pairs()[p].b})
      moduli[b] = std::max(moduli[b], contact.modulus(p));
  std::vector<double> result;
  for (const unsigned int b : free_bodies)
    {
      require(moduli[b] > 0., bodies[b].path,
              "the rigid body '" + bodies[b].name
                + "' moves freely, but no other body is near enough for contact",
              "place it nearer, raise Contact/Shift, or prescribe its motion");
      result.push_back(moduli[b] * (dim == 2 ? 1. : bodies[b].rigid->radius));
    }
  return result;
}

template <int dim>
double
RigidBodies<dim>::work(const Vector &u, const Vector &old_u, const Vector &forces,
                       const Vector &old_forces) const
{
  double work = 0.;
  for_owned([&](const RigidBody<dim> &, const unsigned int, const DofIndex unknown) {
    work += 0.5 * (forces(unknown) + old_forces(unknown)) * (u(unknown) - old_u(unknown));
  });
  return work;
}

template <int dim>
double
RigidBodies<dim>::largest_displacement(const unsigned int body, const Vector &u) const
{
  const RigidPose<dim> where  = pose(body, u);
  double               result = 0.;
  for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_cell; ++v)
    {
      const dealii::Point<dim> x = bodies[body].box.vertex(v),
                               X = initial_position(bodies[body], x);
      result                     = std::max(result, (X + where.displacement(X) - x).norm());
    }
  return result;
}

template <int dim>
std::vector<RigidBodyState<dim>>
RigidBodies<dim>::states(const Vector &u) const
{
  std::vector<typename RigidPose<dim>::Load> loads;
  for (const unsigned int b : rigid_bodies)
    loads.push_back(contact.rigid_load(b));
  JointSum sum;
  for (auto &load : loads)
    {
      sum.add(load.force);
      sum.add(load.couple);
    }
  sum.reduce(space.grid.communicator());
  std::vector<RigidBodyState<dim>> result;
  for (unsigned int i = 0; i < loads.size(); ++i)
    {
      const RigidPose<dim> where = pose(rigid_bodies[i], u);
      result.push_back({rigid_bodies[i], where.translation(), where.rotation(), -loads[i].force,
                        -where.moment(loads[i])});
    }
  return result;
}

template struct RigidBodyState<2>;
template struct RigidBodyState<3>;
template class RigidBodies<2>;
template class RigidBodies<3>;
} // namespace scree
