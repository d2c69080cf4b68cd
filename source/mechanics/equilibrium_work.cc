#include <scree/mechanics/equilibrium.h>

#include <deal.II/base/mpi.h>

// Work and energies of the accepted states.
namespace scree
{
template <int dim>
double
Equilibrium<dim>::work_of_multipliers(const Vector &u)
{
  double work = 0.;
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    {
      const DofIndex index = fields.multiplier(i);
      if (!fields.owned().is_element(index))
        continue;
      // The row says B u = f, its multiplier acts on the body with -B^T lambda.
      work -= 0.5 * (accepted_u(index) + u(index)) * (loads(index) - accepted_prescribed(index));
      accepted_prescribed(index) = loads(index);
    }
  accepted_prescribed.compress(dealii::VectorOperation::insert);
  return work;
}

template <int dim>
bool
Equilibrium<dim>::works_by_traction(const BoundaryRegion<dim> &region) const
{
  const ConditionType type = region.condition->parameters.type;
  return type == ConditionType::displacement
         || (type == ConditionType::pressure && bulk.step_start() != nullptr);
}

template <int dim>
dealii::Tensor<1, dim>
Equilibrium<dim>::driven_displacement(const BoundaryRegion<dim> &region, const unsigned int q,
                                      const Vector &with_ghost_values) const
{
  return region.condition->parameters.type == ConditionType::displacement
           ? region.condition->vector(region.points[q].reference_position, time)
           : boundary_terms.displacement_at(region, q, with_ghost_values);
}

template <int dim>
double
Equilibrium<dim>::work_of_displacements(const Vector &u, const Vector &with_ghost_values)
{
  double work = work_of_multipliers(u);
  Vector forces(internal_forces);
  reactions(forces);
  for (const auto &unknown : supports.unknowns())
    {
      const double motion = u(unknown.index) - accepted_u(unknown.index);
      work += 0.5 * (accepted_reactions(unknown.index) + forces(unknown.index)) * motion;
    }
  // What drives the rigid bodies: applied forces, or the reactions of prescribed components.
  forces += applied_forces;
  work += rigid.work(u, accepted_u, forces, accepted_reactions);
  accepted_reactions = forces;
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region = boundary_terms.regions()[i];
      if (!works_by_traction(region))
        continue;
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto traction = boundary_terms.traction(region, q, with_ghost_values, time);
          const auto motion
            = driven_displacement(region, q, with_ghost_values) - accepted_displacements[i][q];
          work += 0.5 * region.points[q].weight * (accepted_tractions[i][q] + traction) * motion;
        }
    }
  remember_conditions(with_ghost_values);
  return dealii::Utilities::MPI::sum(work, fields.grid.communicator());
}

template <int dim>
void
Equilibrium<dim>::accept(const Vector &u, const ContactHistory<dim> &old_history)
{
  const Vector with_ghost_values = with_ghosts(u);
  Energies    &energies          = current_energies;
  // Unknown by unknown with condensed hanging nodes: loads have no entries there.
  Vector motion(u);
  motion -= accepted_u;
  accepted_dead_loads += dead_loads;
  energies.external_work
    += 0.5 * (accepted_dead_loads * motion) + work_of_displacements(u, with_ghost_values);
  accepted_dead_loads = dead_loads;
  accepted_u          = u;

  // The work of the tangential tractions by the trapezoidal rule that is not stored in them.
  double dissipated = 0.;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto &point    = contact.points()[i];
      const auto &response = contact.responses()[i];
      const auto &old_tau  = old_history.tau[i];
      auto        slip     = contact.jumps()[i] - old_history.jump[i];
      slip -= (slip * point.normal) * point.normal;
      dissipated -= 0.5 * point.weight
                    * ((old_tau + response.tau) * slip
                       + (response.tau.norm_square() - old_tau.norm_square()) / contact.eps_t(i));
    }
  energies.dissipation += dealii::Utilities::MPI::sum(dissipated, fields.grid.communicator());
  store_energies(with_ghost_values);
  if (!is_linear_but_for_contact())
    energies.plastic += bulk.work(with_ghost_values).dissipation;
}

template <int dim>
void
Equilibrium<dim>::store_energies(const Vector &with_ghost_values)
{
  double stored = 0.;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto &response = contact.responses()[i];
      stored += 0.5 * contact.points()[i].weight
                * (response.pressure * response.pressure / contact.eps_n(i)
                   + response.tau.norm_square() / contact.eps_t(i));
    }
  current_energies.contact  = dealii::Utilities::MPI::sum(stored, fields.grid.communicator());
  current_energies.strain   = bulk.work(with_ghost_values).energy;
  current_energies.boundary = boundary_terms.energy(with_ghost_values, time);
  if (is_linear_but_for_contact())
    current_energies.ghost_penalty = bulk.ghost_energy(with_ghost_values);
  else
    {
      Vector total(with_ghost_values);
      total = with_ghosts(bulk.step_start()->displacement());
      total += with_ghost_values;
      current_energies.ghost_penalty = bulk.ghost_energy(total);
    }
}

template <int dim>
void
Equilibrium<dim>::start_step(const double time, const Vector &u, const ContactHistory<dim> &history,
                             const Energies &energies, const std::vector<double> &driving_forces)
{
  start_time = time;
  take_as_accepted(time, u, history);
  for (unsigned int i = 0; i < driving_forces.size(); ++i)
    if (fields.owned().is_element(fields.n_dofs() - fields.n_trailing() + i))
      accepted_reactions(fields.n_dofs() - fields.n_trailing() + i) = driving_forces[i];
  accepted_reactions.compress(dealii::VectorOperation::insert);
  current_energies = energies;
  store_energies(with_ghosts(accepted_u));
  current_energies.transfer += current_energies.stored() - energies.stored();
}

template <int dim>
void
Equilibrium<dim>::resume(const double time, const Vector &u, const ContactHistory<dim> &history,
                         const Energies &energies)
{
  take_as_accepted(time, u, history);
  current_energies = energies;
}

template <int dim>
void
Equilibrium<dim>::take_as_accepted(const double time, const Vector &u,
                                   const ContactHistory<dim> &history)
{
  Vector r(u);
  accepted_u = u;
  set_time(time, accepted_u);
  residual(accepted_u, history, r);
  accepted_dead_loads = dead_loads;
  reactions(accepted_reactions);
  accepted_reactions += applied_forces;
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    if (fields.owned().is_element(fields.multiplier(i)))
      accepted_prescribed(fields.multiplier(i)) = loads(fields.multiplier(i));
  accepted_prescribed.compress(dealii::VectorOperation::insert);
  remember_conditions(with_ghosts(accepted_u));
}

template <int dim>
std::vector<double>
Equilibrium<dim>::driving_forces() const
{
  std::vector<double> result(fields.n_trailing() - BoundaryTerms<dim>::n_multipliers(bodies));
  for (unsigned int i = 0; i < result.size(); ++i)
    if (fields.owned().is_element(fields.n_dofs() - fields.n_trailing() + i))
      result[i] = accepted_reactions(fields.n_dofs() - fields.n_trailing() + i);
  dealii::Utilities::MPI::sum(result, fields.grid.communicator(), result);
  return result;
}

template <int dim>
void
Equilibrium<dim>::remember_conditions(const Vector &with_ghost_values)
{
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region = boundary_terms.regions()[i];
      if (works_by_traction(region))
        for (unsigned int q = 0; q < region.points.size(); ++q)
          {
            accepted_tractions[i][q] = boundary_terms.traction(region, q, with_ghost_values, time);
            accepted_displacements[i][q] = driven_displacement(region, q, with_ghost_values);
          }
    }
}

#define SCREE_INSTANTIATE(dim)                                                                          \
  template double Equilibrium<dim>::work_of_multipliers(const Vector &);                                \
  template bool   Equilibrium<dim>::works_by_traction(const BoundaryRegion<dim> &) const;               \
  template dealii::Tensor<1, dim> Equilibrium<dim>::driven_displacement(                                \
    const BoundaryRegion<dim> &, const unsigned int, const Vector &) const;                             \
  template double Equilibrium<dim>::work_of_displacements(const Vector &, const Vector &);              \
  template void   Equilibrium<dim>::accept(const Vector &, const ContactHistory<dim> &);                \
  template void   Equilibrium<dim>::store_energies(const Vector &);                                     \
  template void   Equilibrium<dim>::start_step(const double, const Vector &,                            \
                                               const ContactHistory<dim> &, const Energies &,           \
                                               const std::vector<double> &);                            \
  template std::vector<double> Equilibrium<dim>::driving_forces() const;                                \
  template void                Equilibrium<dim>::resume(const double, const Vector &,                   \
                                                        const ContactHistory<dim> &, const Energies &); \
  template void                Equilibrium<dim>::take_as_accepted(const double, const Vector &,         \
                                                                  const ContactHistory<dim> &);         \
  template void                Equilibrium<dim>::remember_conditions(const Vector &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
