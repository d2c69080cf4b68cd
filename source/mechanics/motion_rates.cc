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
  if (!equilibrium.has_inertia())
    return scheme.rates(nullptr, state, u, u, {}, time);
  std::vector<bool> turns_freely = equilibrium.free_motions().unsupported();
  for (unsigned int b = 0; b < turns_freely.size() && !problem.is_moving(); ++b)
    turns_freely[b] = turns_freely[b] && problem.bodies[b].is_rigid();
  Rates result = scheme.rates(problem.mass.get(), state, u, equilibrium.accelerations_by_contact(u),
                              turns_freely, time);
  set_prescribed_rates(equilibrium, time, time - state.time, &state.predictor.rates, result);
  result.forces = equilibrium.forces_without_inertia();
  return result;
}

template <int dim>
void
remove_approach(const DiscreteProblem<dim> &problem, const ContactHistory<dim> &history,
                Rates &rates)
{
  using Vector                          = typename Equilibrium<dim>::Vector;
  const Equilibrium<dim>   &equilibrium = problem.equilibrium();
  const ContactPoints<dim> &contact     = problem.contact();
  const SparseRows          rows        = contact.jump_operator().rows();
  Vector                    masses(rates.velocity), change(rates.velocity);
  change = 1.;
  problem.mass->matrix()->vmult(masses, change);
  const double negligible = 1e-8 * masses.linfty_norm(); // where cells have no points
  change                  = 0.;
  const Vector v = equilibrium.with_ghosts(rates.velocity), m = equilibrium.with_ghosts(masses);
  for (unsigned int p = 0; p < contact.points().size(); ++p)
    {
      const ContactPoint<dim> &point = contact.points()[p];
      const std::size_t        first = rows.begin[dim * p];
      if (!point.is_node || rows.begin[dim * p + 1] != first + 2
          || (point.initial_gap > 0. && history.pressure[p] == 0.))
        continue;
      // The nodes of both sides, with the factors -1 and 1.
      double approach = 0.;
      for (unsigned int i = 0; i < 2 * dim; ++i)
        approach -= rows.values[first + i] * point.normal[i / 2] * v(rows.columns[first + i]);
      const double sum = m(rows.columns[first]) + m(rows.columns[first + 1]);
      if (approach <= 0. || sum <= negligible)
        continue;
      for (unsigned int i = 0; i < 2 * dim; ++i)
        {
          const double of_other = m(rows.columns[first + (i % 2 == 0 ? i + 1 : i - 1)]);
          change.add({static_cast<DofIndex>(rows.columns[first + i])},
                     std::vector<double>{rows.values[first + i] * approach * of_other / sum
                                         * point.normal[i / 2]});
        }
    }
  change.compress(dealii::VectorOperation::add);
  equilibrium.strong_supports().set_zero(change);
  rates.velocity += change;
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void  set_prescribed_rates(const Equilibrium<dim> &, const double, const double,        \
                                      const Rates *, Rates &);                                     \
  template Rates rates_at_end(const DiscreteProblem<dim> &, const TimeScheme<dim> &,               \
                              const State<dim> &, const Equilibrium<dim>::Vector &, const double); \
  template void remove_approach(const DiscreteProblem<dim> &, const ContactHistory<dim> &, Rates &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
