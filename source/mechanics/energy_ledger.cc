#include <scree/contact/contact_energy.h>
#include <scree/mechanics/energy_ledger.h>

#include <deal.II/base/mpi.h>

namespace scree
{
template <int dim>
EnergyLedger<dim>::EnergyLedger(const DisplacementSpace<dim> &space,
                                const std::vector<Body<dim>> &bodies,
                                const Kinematics<dim>        &kinematics,
                                const BoundaryTerms<dim>     &boundary_terms,
                                const ContactPoints<dim>     &contact,
                                const StrongSupports<dim> &supports, const RigidBodies<dim> &rigid)
    : space(space)
    , bodies(bodies)
    , kinematics(kinematics)
    , boundary_terms(boundary_terms)
    , contact(contact)
    , supports(supports)
    , rigid(rigid)
{
  for (Vector *vector :
       {&accepted_u, &accepted_dead_loads, &accepted_reactions, &accepted_prescribed})
    vector->reinit(space.owned(), space.grid.communicator());
  for (const auto &region : boundary_terms.regions())
    accepted_tractions.emplace_back(region.follows_surface ? region.points.size() : 0);
  accepted_displacements = accepted_tractions;
}

template <int dim>
double
EnergyLedger<dim>::work_of_multipliers(const EvaluatedState<dim> &state)
{
  double work = 0.;
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    {
      const DofIndex index = space.multiplier(i);
      if (!space.owned().is_element(index))
        continue;
      // The row says B u = f, its multiplier acts on the body with -B^T lambda.
      work -= 0.5 * (accepted_u(index) + state.u(index))
              * (state.loads(index) - accepted_prescribed(index));
      accepted_prescribed(index) = state.loads(index);
    }
  accepted_prescribed.compress(dealii::VectorOperation::insert);
  return work;
}

template <int dim>
double
EnergyLedger<dim>::work_of_pressures(const EvaluatedState<dim> &state) const
{
  double work = 0.;
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region = boundary_terms.regions()[i];
      if (!region.follows_surface)
        continue;
      const auto tractions = boundary_terms.tractions(i, state.field, state.time);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        {
          const auto motion
            = boundary_terms.displacement_at(region, q, state.field) - accepted_displacements[i][q];
          work
            += 0.5 * region.points[q].weight * (accepted_tractions[i][q] + tractions[q]) * motion;
        }
    }
  return work;
}

template <int dim>
double
EnergyLedger<dim>::work_on_prescribed(const std::vector<DrivenPoint<dim>> &driven,
                                      const double                         time) const
{
  double work = 0.;
  for (const auto &point : driven)
    {
      const auto            &condition = *boundary_terms.regions()[point.region].condition;
      dealii::Tensor<1, dim> motion    = condition.vector(point.reference_position, time);
      if (!is_unloaded)
        motion -= condition.vector(point.reference_position, accepted_time);
      work += point.force * motion;
    }
  return work;
}

template <int dim>
double
EnergyLedger<dim>::work_of_step(const EvaluatedState<dim> &state)
{
  double work = work_of_multipliers(state) + work_of_pressures(state);
  for (const auto &unknown : supports.unknowns())
    {
      const double motion = state.u(unknown.index) - accepted_u(unknown.index);
      work += 0.5 * (accepted_reactions(unknown.index) + state.driving(unknown.index)) * motion;
    }
  work += rigid.work(state.u, accepted_u, state.driving, accepted_reactions);
  accepted_reactions = state.driving;
  work += 0.5 * work_on_prescribed(accepted_driven, state.time);
  set_accepted_conditions(state);
  work += 0.5 * work_on_prescribed(accepted_driven, state.time);
  return dealii::Utilities::MPI::sum(work, space.grid.communicator());
}

template <int dim>
double
EnergyLedger<dim>::released_work(const EvaluatedState<dim> &state, const Vector &motion,
                                 const ContactHistory<dim> &old_history) const
{
  double work = work_on_prescribed(accepted_driven, state.time)
                - work_on_prescribed(unbalanced->driven, state.time);
  // The law has cut tractions at u = 0, dissipation goes on from the remembered ones.
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    work += contact.points()[i].weight * (old_history.tau[i] - unbalanced->tau[i])
            * (contact.jumps()[i] - old_history.jump[i]);
  return 0.5
         * (unbalanced->residual * motion - unbalanced->rigid * motion
            + dealii::Utilities::MPI::sum(work, space.grid.communicator()));
}

template <int dim>
void
EnergyLedger<dim>::accept(const EvaluatedState<dim> &state, const ContactHistory<dim> &old_history)
{
  Energies &energies = current_energies;
  // Unknown by unknown with condensed hanging nodes: loads have no entries there.
  Vector motion(state.u);
  motion -= accepted_u;
  if (unbalanced)
    energies.transfer -= released_work(state, motion, old_history);
  unbalanced.reset();
  accepted_dead_loads += state.dead_loads;
  energies.external_work += 0.5 * (accepted_dead_loads * motion) + work_of_step(state);
  accepted_dead_loads = state.dead_loads;
  set_accepted(state.time, state.u);
  energies.dissipation
    += dissipation(contact, old_history, state.share_of_old_contact, space.grid.communicator());
  energies.plastic += store_energies(state);
}

template <int dim>
void
EnergyLedger<dim>::accept_as_transfer(const EvaluatedState<dim> &state,
                                      const ContactHistory<dim> &old_history)
{
  const double before = current_energies.balance_error();
  accept(state, old_history);
  current_energies.transfer -= current_energies.balance_error() - before;
}

template <int dim>
void
EnergyLedger<dim>::count_overlap()
{
  current_energies.transfer = 0.;
  current_energies.external_work += -current_energies.balance_error();
}

template <int dim>
void
EnergyLedger<dim>::start_motion(const EvaluatedState<dim> &state)
{
  set_accepted_forces(state);
  store_energies(state);
  current_energies.external_work = current_energies.stored();
}

template <int dim>
double
EnergyLedger<dim>::store_energies(const EvaluatedState<dim> &state)
{
  current_energies.contact  = stored_energy(contact, space.grid.communicator());
  const auto of_bulk        = kinematics.bulk().work(state.field);
  current_energies.strain   = of_bulk.energy;
  current_energies.kinetic  = state.kinetic_energy;
  current_energies.boundary = boundary_terms.energy(state.field, state.time);
  current_energies.ghost_penalty
    = kinematics.bulk().energy_of_small_cuts(kinematics.start_displacement_field(), state.field);
  return of_bulk.dissipation;
}

template <int dim>
unsigned int
EnergyLedger<dim>::n_rigid_unknowns() const
{
  return space.n_trailing() - BoundaryTerms<dim>::n_multipliers(bodies);
}

template <int dim>
void
EnergyLedger<dim>::start_step(const EvaluatedState<dim> &state, const Vector &unbalanced_forces,
                              const ContactHistory<dim> &history, const Energies &energies,
                              const DrivingForces<dim> *driving)
{
  set_accepted_forces(state);
  DrivingForces<dim> none;
  if (driving == nullptr)
    {
      // Loads grow from zero in the first step.
      set_unloaded();
      accepted_reactions.equ(-1., state.contact_forces);
      none.of_rigid.assign(n_rigid_unknowns(), 0.);
      driving = &none;
    }
  Vector r(unbalanced_forces);
  unbalanced.emplace();
  unbalanced->rigid.reinit(r);
  for (unsigned int i = 0; i < n_rigid_unknowns(); ++i)
    {
      const DofIndex index = space.n_dofs() - n_rigid_unknowns() + i;
      if (!space.owned().is_element(index))
        continue;
      // These rows of the reactions hold what is unbalanced.
      r(index)                  = 0.;
      unbalanced->rigid(index)  = accepted_reactions(index) - driving->of_rigid[i];
      accepted_reactions(index) = driving->of_rigid[i];
    }
  for (Vector *vector : {&r, &unbalanced->rigid, &accepted_reactions})
    vector->compress(dealii::VectorOperation::insert);
  unbalanced->residual = r;
  for (const auto &response : contact.responses())
    unbalanced->tau.push_back(response.tau);
  unbalanced->driven = std::move(accepted_driven);
  accepted_driven    = driving->of_points;
  current_energies   = energies;
  // What laws dissipate at once is counted at the end of the step and was stored before.
  double cut = cut_energy(contact, history, space.grid.communicator());
  cut += store_energies(state);
  current_energies.transfer += current_energies.stored() + cut - energies.stored();
}

template <int dim>
void
EnergyLedger<dim>::start_without_transfer(const Energies &energies)
{
  current_energies = energies;
  unbalanced.reset();
}

template <int dim>
void
EnergyLedger<dim>::set_unloaded()
{
  is_unloaded = true;
  accepted_driven.clear();
  accepted_dead_loads = 0.;
  for (auto &tractions : accepted_tractions)
    tractions.assign(tractions.size(), dealii::Tensor<1, dim>());
}

template <int dim>
void
EnergyLedger<dim>::resume(const EvaluatedState<dim> &state, const Energies &energies)
{
  set_accepted_forces(state);
  current_energies = energies;
}

template <int dim>
void
EnergyLedger<dim>::set_accepted(const double time, const Vector &u)
{
  accepted_u    = u;
  accepted_time = time;
  is_unloaded   = false;
}

template <int dim>
void
EnergyLedger<dim>::set_accepted_forces(const EvaluatedState<dim> &state)
{
  accepted_dead_loads = state.dead_loads;
  accepted_reactions  = state.driving;
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    if (space.owned().is_element(space.multiplier(i)))
      accepted_prescribed(space.multiplier(i)) = state.loads(space.multiplier(i));
  accepted_prescribed.compress(dealii::VectorOperation::insert);
  set_accepted_conditions(state);
}

template <int dim>
DrivingForces<dim>
EnergyLedger<dim>::driving_forces() const
{
  DrivingForces<dim> result;
  result.of_points = accepted_driven;
  result.of_rigid.resize(n_rigid_unknowns());
  for (unsigned int i = 0; i < n_rigid_unknowns(); ++i)
    {
      const DofIndex index = space.n_dofs() - n_rigid_unknowns() + i;
      if (space.owned().is_element(index))
        result.of_rigid[i] = accepted_reactions(index);
    }
  dealii::Utilities::MPI::sum(result.of_rigid, space.grid.communicator(), result.of_rigid);
  return result;
}

template <int dim>
void
EnergyLedger<dim>::set_accepted_conditions(const EvaluatedState<dim> &state)
{
  accepted_driven.clear();
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region      = boundary_terms.regions()[i];
      const bool  is_pressure = region.follows_surface;
      if (!is_pressure && !region.condition->prescribes_displacement())
        continue;
      const auto tractions = boundary_terms.tractions(i, state.field, state.time);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto &point = region.points[q];
          if (!is_pressure)
            accepted_driven.push_back({i, point.reference_position, point.weight * tractions[q]});
          else
            {
              accepted_tractions[i][q]     = tractions[q];
              accepted_displacements[i][q] = boundary_terms.displacement_at(region, q, state.field);
            }
        }
    }
}

template class EnergyLedger<2>;
template class EnergyLedger<3>;
} // namespace scree
