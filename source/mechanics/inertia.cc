#include <scree/mechanics/inertia.h>

#include <cmath>

namespace scree
{
namespace
{
/** a of the points of one of the rigid bodies. */
template <int dim>
typename RigidMasses<dim>::Vectors
accelerations_of(const Inertia<dim> &inertia, const unsigned int i, const RigidPose<dim> &pose)
{
  auto result = inertia.mass->rigid().bodies()[i].positions(pose);
  for (unsigned int p = 0; p < result.size(); ++p)
    result[p] = inertia.factor * result[p] - inertia.rigid[i][p];
  return result;
}
} // namespace

template <int dim>
void
Inertia<dim>::get_forces(const Vector &u, const Vector &ghosted, Vector &result) const
{
  mass->matrix()->vmult(result, u);
  result.sadd(-factor, 1., forces);
  for (unsigned int i = 0; i < rigid.size(); ++i)
    {
      const auto &body = mass->rigid().bodies()[i];
      const auto  pose = mass->pose(body, ghosted);
      auto        q    = pose.generalised_force(body.load(accelerations_of(*this, i, pose)));
      for (double &force : q)
        force *= -1.;
      mass->rigid().add(body, q, result);
    }
  result.compress(dealii::VectorOperation::add);
}

template <int dim>
void
Inertia<dim>::add_tangent(const Vector &ghosted, dealii::TrilinosWrappers::SparseMatrix &K) const
{
  for (unsigned int i = 0; i < rigid.size(); ++i)
    {
      const auto &body = mass->rigid().bodies()[i];
      const auto  pose = mass->pose(body, ghosted);
      mass->rigid().add_tangent(body, pose, factor, accelerations_of(*this, i, pose), K);
    }
}

template <int dim>
std::pair<unsigned int, typename RigidPose<dim>::Load>
Inertia<dim>::rigid_load(const unsigned int i, const Vector &ghosted) const
{
  const auto &body = mass->rigid().bodies()[i];
  return {body.body, body.load(accelerations_of(*this, i, mass->pose(body, ghosted)))};
}

template <int dim>
double
Inertia<dim>::size_of_terms() const
{
  double result = forces.norm_sqr();
  for (unsigned int i = 0; i < rigid.size(); ++i)
    for (const auto &term : rigid[i])
      result += std::pow(mass->rigid().bodies()[i].mass, 2) / rigid[i].size() * term.norm_square();
  return std::sqrt(result);
}

template <int dim>
Inertia<dim>
inertia_of(const std::shared_ptr<const Mass<dim>> &mass, const typename Inertia<dim>::Vector &u,
           const Rates &rates)
{
  Inertia<dim> result{mass, 0., 1., rates.acceleration};
  mass->matrix()->vmult(result.forces, rates.acceleration);
  result.forces *= -1.;
  const auto where = mass->with_ghosts(u), v = mass->with_ghosts(rates.velocity),
             a = mass->with_ghosts(rates.acceleration);
  for (const auto &body : mass->rigid().bodies())
    {
      auto accelerations
        = body.accelerations(mass->pose(body, where), mass->rigid().read(body, v, a));
      for (auto &of_point : accelerations)
        of_point *= -1.;
      result.rigid.push_back(accelerations);
    }
  return result;
}

template Inertia<2> inertia_of(const std::shared_ptr<const Mass<2>> &, const Inertia<2>::Vector &,
                               const Rates &);
template Inertia<3> inertia_of(const std::shared_ptr<const Mass<3>> &, const Inertia<3>::Vector &,
                               const Rates &);
template struct Inertia<2>;
template struct Inertia<3>;
} // namespace scree
