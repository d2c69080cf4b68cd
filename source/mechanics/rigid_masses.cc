#include <scree/mechanics/resultant.h>
#include <scree/mechanics/rigid_masses.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace scree
{
namespace
{
template <int dim>
dealii::Tensor<1, 3>
in_space(const dealii::Tensor<1, dim> &vector)
{
  dealii::Tensor<1, 3> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = vector[d];
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
in_plane(const dealii::Tensor<1, 3> &vector)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = vector[d];
  return result;
}

template <int dim, typename Values>
dealii::Tensor<1, dim>
mean(const Values &values)
{
  dealii::Tensor<1, dim> result;
  for (const auto &value : values)
    result += value / static_cast<double>(values.size());
  return result;
}

/** sum r r^T */
template <int dim, typename Vectors>
dealii::Tensor<2, dim>
second_moments(const Vectors &arms)
{
  dealii::Tensor<2, dim> result;
  for (const auto &arm : arms)
    result += dealii::outer_product(arm, arm);
  return result;
}
} // namespace

template <int dim>
dealii::Tensor<1, 3>
spin_of(const dealii::Tensor<2, dim> &second, const dealii::Tensor<1, 3> &L)
{
  if (dim == 2) // about z
    return dealii::Tensor<1, 3>({0., 0., L[2] / trace(second)});
  dealii::Tensor<2, 3> J;
  for (unsigned int i = 0; i < dim; ++i)
    {
      J[i][i] += trace(second);
      for (unsigned int j = 0; j < dim; ++j)
        J[i][j] -= second[i][j];
    }
  return dealii::invert(J) * L;
}

template <int dim>
dealii::Tensor<1, dim>
turned(const dealii::Tensor<1, 3> &w, const dealii::Tensor<1, dim> &r)
{
  return in_plane<dim>(dealii::cross_product_3d(w, in_space<dim>(r)));
}

template <int dim>
typename RigidMasses<dim>::Vectors
RigidMasses<dim>::OfBody::positions(const RigidPose<dim> &pose) const
{
  Vectors result;
  for (unsigned int i = 0; i < n_points; ++i)
    result[i] = initial_positions[i] + pose.displacement(initial_positions[i]);
  return result;
}

template <int dim>
typename RigidMasses<dim>::Vectors
RigidMasses<dim>::OfBody::velocities(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const
{
  const dealii::Tensor<1, dim> centre = rigid->reference_point + pose.translation();
  Vectors                      result = positions(pose);
  for (auto &value : result)
    value = rates.velocity + turned<dim>(rates.spin, value - centre);
  return result;
}

template <int dim>
typename RigidMasses<dim>::Vectors
RigidMasses<dim>::OfBody::accelerations(const RigidPose<dim>  &pose,
                                        const RigidRates<dim> &rates) const
{
  const dealii::Tensor<1, dim> centre = rigid->reference_point + pose.translation();
  Vectors                      result = positions(pose);
  for (auto &value : result)
    {
      const dealii::Tensor<1, dim> arm = value - centre;
      value = rates.acceleration + turned<dim>(rates.angular_acceleration, arm)
              + turned<dim>(rates.spin, turned<dim>(rates.spin, arm));
    }
  return result;
}

template <int dim>
RigidRates<dim>
RigidMasses<dim>::OfBody::rates(const RigidPose<dim> &pose, const Vectors &velocities,
                                const Vectors &accelerations) const
{
  Vectors                      arms      = positions(pose);
  const dealii::Tensor<1, dim> centre    = mean<dim>(arms);
  const dealii::Tensor<1, dim> reference = rigid->reference_point + pose.translation() - centre;
  dealii::Tensor<1, 3>         L, dL;
  for (unsigned int i = 0; i < n_points; ++i)
    {
      arms[i] -= centre;
      L += moment_of<dim>(arms[i], velocities[i]);
      dL += moment_of<dim>(arms[i], accelerations[i]);
    }
  const dealii::Tensor<2, dim> second = second_moments<dim>(arms);
  RigidRates<dim>              result;
  result.spin = spin_of<dim>(second, L);
  for (const auto &arm : arms) // r x (w x (w x r))
    dL -= dealii::cross_product_3d(
      in_space<dim>(arm), in_space<dim>(turned<dim>(result.spin, turned<dim>(result.spin, arm))));
  result.angular_acceleration = spin_of<dim>(second, dL);
  result.velocity             = mean<dim>(velocities) + turned<dim>(result.spin, reference);
  result.acceleration         = mean<dim>(accelerations)
                        + turned<dim>(result.angular_acceleration, reference)
                        + turned<dim>(result.spin, turned<dim>(result.spin, reference));
  return result;
}

template <int dim>
RigidRates<dim>
RigidMasses<dim>::OfBody::accelerated(const RigidPose<dim> &pose, const RigidRates<dim> &rates,
                                      const typename RigidPose<dim>::Unknowns &forces) const
{
  constexpr unsigned int n = n_rigid_components<dim>;
  // With generalised accelerations b, the points have a = dx/dq b + what the spin alone does.
  RigidRates<dim> spinning;
  spinning.velocity                                          = rates.velocity;
  spinning.spin                                              = rates.spin;
  auto                                               a       = accelerations(pose, spinning);
  const auto                                         of_spin = pose.generalised_force(load(a));
  dealii::FullMatrix<double>                         M(n, n);
  dealii::Vector<double>                             r(n), b(n);
  std::vector<std::array<dealii::Tensor<1, dim>, n>> derivatives;
  for (const auto &X : initial_positions)
    derivatives.push_back(pose.derivative(X));
  for (unsigned int k = 0; k < n; ++k)
    {
      r(k) = rigid->is_free(k) ? forces[k] - of_spin[k] : 0.;
      for (unsigned int l = 0; l < n; ++l)
        if (rigid->is_free(k) && rigid->is_free(l))
          for (const auto &derivative : derivatives)
            M(k, l) += mass / n_points * (derivative[k] * derivative[l]);
      if (!rigid->is_free(k))
        M(k, k) = 1.;
    }
  M.gauss_jordan();
  M.vmult(b, r);
  for (unsigned int p = 0; p < n_points; ++p)
    for (unsigned int k = 0; k < n; ++k)
      a[p] += b(k) * derivatives[p][k];
  return this->rates(pose, velocities(pose, rates), a);
}

template <int dim>
Momentum<dim>
RigidMasses<dim>::OfBody::momentum(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const
{
  Momentum<dim> result;
  const Vectors x = positions(pose), v = velocities(pose, rates);
  for (unsigned int i = 0; i < n_points; ++i)
    {
      result.linear += mass / n_points * v[i];
      result.angular += mass / n_points * moment_of<dim>(x[i], v[i]);
    }
  return result;
}

template <int dim>
double
RigidMasses<dim>::OfBody::kinetic_energy(const RigidPose<dim>  &pose,
                                         const RigidRates<dim> &rates) const
{
  double result = 0.;
  for (const auto &v : velocities(pose, rates))
    result += 0.5 * mass / n_points * v.norm_square();
  return result;
}

template <int dim>
typename RigidPose<dim>::Load
RigidMasses<dim>::OfBody::load(const Vectors &forces) const
{
  typename RigidPose<dim>::Load result;
  for (unsigned int i = 0; i < n_points; ++i)
    result.add(initial_positions[i] - rigid->reference_point, mass / n_points * forces[i]);
  return result;
}

template <int dim>
RigidMasses<dim>::RigidMasses(const DisplacementSpace<dim> &space,
                              const std::vector<Body<dim>> &bodies)
    : space(space)
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (!bodies[b].is_rigid() || bodies[b].rigid->density == 0.)
        continue;
      const RigidBody<dim> &rigid   = *bodies[b].rigid;
      const auto           &moments = rigid.moments;
      OfBody                body{b, &rigid, rigid.density * moments.volume, {}};
      const auto            axes = dealii::eigenvectors(moments.second);
      for (unsigned int k = 0; k < dim; ++k)
        {
          const auto &[value, axis]         = axes[k];
          const double distance             = std::sqrt(dim * value / moments.volume);
          body.initial_positions[2 * k]     = moments.centre + distance * axis;
          body.initial_positions[2 * k + 1] = moments.centre - distance * axis;
        }
      of_bodies.push_back(body);
    }
}

template <int dim>
void
RigidMasses<dim>::add(const OfBody &body, const typename RigidPose<dim>::Unknowns &forces,
                      Vector &r) const
{
  for (unsigned int m = 0; m < forces.size(); ++m)
    if (const DofIndex row = space.rigid_unknown(body.body) + m; space.owned().is_element(row))
      r(row) += forces[m];
}

template <int dim>
void
RigidMasses<dim>::add_tangent(const OfBody &body, const RigidPose<dim> &pose, const double factor,
                              const Vectors                          &accelerations,
                              dealii::TrilinosWrappers::SparseMatrix &K) const
{
  constexpr unsigned int n           = n_rigid_components<dim>;
  const auto             curvature   = pose.curvature(body.load(accelerations));
  double                 block[n][n] = {};
  for (unsigned int i = 0; i < n_points; ++i)
    {
      const auto derivative = pose.derivative(body.initial_positions[i]);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          block[k][l] += factor * body.mass / n_points * (derivative[k] * derivative[l]);
    }
  for (unsigned int k = dim; k < n; ++k)
    for (unsigned int l = dim; l < n; ++l)
      block[k][l] += curvature[rotation_axis<dim>(k)][rotation_axis<dim>(l)];
  const DofIndex first = space.rigid_unknown(body.body);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int l = 0; l < n && space.owned().is_element(first + k); ++l)
      K.add(first + k, first + l, block[k][l]);
}

template <int dim>
RigidRates<dim>
RigidMasses<dim>::read(const OfBody &body, const Vector &velocity, const Vector &acceleration) const
{
  const auto      v = rigid_unknowns(space, body.body, velocity);
  const auto      a = rigid_unknowns(space, body.body, acceleration);
  RigidRates<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result.velocity[d]     = v[d];
      result.acceleration[d] = a[d];
    }
  for (unsigned int m = dim; m < v.size(); ++m)
    {
      result.spin[rotation_axis<dim>(m)]                 = v[m] / body.rigid->radius;
      result.angular_acceleration[rotation_axis<dim>(m)] = a[m] / body.rigid->radius;
    }
  return result;
}

template <int dim>
void
RigidMasses<dim>::write(const OfBody &body, const RigidRates<dim> &rates, Vector &velocity,
                        Vector &acceleration) const
{
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    {
      const DofIndex row = space.rigid_unknown(body.body) + m;
      if (!space.owned().is_element(row))
        continue;
      const unsigned int axis = m < dim ? 0 : rotation_axis<dim>(m);
      const double       L    = body.rigid->radius;
      velocity(row)           = m < dim ? rates.velocity[m] : L * rates.spin[axis];
      acceleration(row) = m < dim ? rates.acceleration[m] : L * rates.angular_acceleration[axis];
    }
}

template dealii::Tensor<1, 3> spin_of(const dealii::Tensor<2, 2> &, const dealii::Tensor<1, 3> &);
template dealii::Tensor<1, 3> spin_of(const dealii::Tensor<2, 3> &, const dealii::Tensor<1, 3> &);
template dealii::Tensor<1, 2> turned(const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 2> &);
template dealii::Tensor<1, 3> turned(const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &);
template class RigidMasses<2>;
template class RigidMasses<3>;
} // namespace scree
