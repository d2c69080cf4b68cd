#include <scree/mechanics/motion_rates.h>

#include <utility>

namespace scree
{
template <int dim>
void
set_prescribed_rates(const Equilibrium<dim> &equilibrium, const double time, const double dt,
                     const Rates *before, Rates &rates)
{
  const StrongSupports<dim> &supports = equilibrium.strong_supports();
  const RigidBodies<dim>    &rigid    = equilibrium.rigid_bodies();
  const double               delta    = (before != nullptr ? -1e-4 : 1e-4) * dt;
  auto                       here = rates.velocity, there = rates.velocity;
  for (const auto &[vector, t] :
       {std::make_pair(&here, time), std::make_pair(&there, time + delta)})
    {
      supports.set(*vector, t);
      rigid.set(*vector, t);
    }
  const auto set = [&](const DofIndex index) {
    const double velocity     = (there(index) - here(index)) / delta;
    rates.acceleration(index) = before != nullptr ? (velocity - before->velocity(index)) / dt : 0.;
    rates.velocity(index)     = velocity;
  };
  for (const auto &unknown : supports.unknowns())
    set(unknown.index);
  for (const DofIndex index : rigid.prescribed())
    set(index);
  for (auto *vector : {&rates.velocity, &rates.acceleration})
    vector->compress(dealii::VectorOperation::insert);
}

template <int dim>
Rates
rates_at_end(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
             const State<dim> &state, const typename Equilibrium<dim>::Vector &u, const double time)
{
  const Equilibrium<dim> &equilibrium = problem.equilibrium();
  if (!problem.mass)
    return scheme.rates(nullptr, state, u, u, time);
  Rates result
    = scheme.rates(problem.mass.get(), state, u, equilibrium.accelerations_by_contact(u), time);
  set_prescribed_rates(equilibrium, time, time - state.time, &state.predictor.rates, result);
  result.forces = equilibrium.forces_without_inertia();
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                              \
  template void  set_prescribed_rates(const Equilibrium<dim> &, const double, const double, \
                                      const Rates *, Rates &);                              \
  template Rates rates_at_end(const DiscreteProblem<dim> &, const TimeScheme<dim> &,        \
                              const State<dim> &, const Equilibrium<dim>::Vector &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
