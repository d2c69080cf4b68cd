#include <scree/contact/contact_energy.h>
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
Equilibrium<dim>::is_following_pressure(const BoundaryRegion<dim> &region) const
{
  return region.condition->kind().law.follows_surface && bulk.step_start() != nullptr;
}

template <int dim>
double
Equilibrium<dim>::work_of_pressures(const PointEvaluator<dim> &u) const
{
  double work = 0.;
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region = boundary_terms.regions()[i];
      if (!is_following_pressure(region))
        continue;
      const auto tractions = boundary_terms.tractions(i, u, time);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        {
          const auto motion
            = boundary_terms.displacement_at(region, q, u) - accepted_displacements[i][q];
          work
            += 0.5 * region.points[q].weight * (accepted_tractions[i][q] + tractions[q]) * motion;
        }
    }
  return work;
}

template <int dim>
double
Equilibrium<dim>::work_on_prescribed(const std::vector<DrivenPoint<dim>> &driven) const
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
Equilibrium<dim>::work_of_step(const Vector &u, const PointEvaluator<dim> &field)
{
  double work = work_of_multipliers(u) + work_of_pressures(field);
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
  work += 0.5 * work_on_prescribed(accepted_driven);
  remember_conditions(field);
  work += 0.5 * work_on_prescribed(accepted_driven);
  return dealii::Utilities::MPI::sum(work, fields.grid.communicator());
}

template <int dim>
double
Equilibrium<dim>::released_work(const Vector &motion, const ContactHistory<dim> &old_history) const
{
  double work = work_on_prescribed(accepted_driven) - work_on_prescribed(unbalanced->driven);
  // The law has cut tractions at u = 0, dissipation goes on from the remembered ones.
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    work += contact.points()[i].weight * (old_history.tau[i] - unbalanced->tau[i])
            * (contact.jumps()[i] - old_history.jump[i]);
  return 0.5
         * (unbalanced->residual * motion - unbalanced->rigid * motion
            + dealii::Utilities::MPI::sum(work, fields.grid.communicator()));
}

template <int dim>
void
Equilibrium<dim>::accept(const Vector &u, const ContactHistory<dim> &old_history)
{
  const PointEvaluator<dim> field    = at_points(u);
  Energies                 &energies = current_energies;
  // Unknown by unknown with condensed hanging nodes: loads have no entries there.
  Vector motion(u);
  motion -= accepted_u;
  if (unbalanced)
    energies.transfer -= released_work(motion, old_history);
  unbalanced.reset();
  accepted_dead_loads += dead_loads;
  energies.external_work += 0.5 * (accepted_dead_loads * motion) + work_of_step(u, field);
  accepted_dead_loads = dead_loads;
  accepted_u          = u;
  accepted_time       = time;
  is_unloaded         = false;

  energies.dissipation += dissipation(contact, old_history, fields.grid.communicator());
  energies.plastic += store_energies(field);
}

template <int dim>
void
Equilibrium<dim>::count_overlap()
{
  current_energies.transfer = 0.;
  current_energies.external_work += -current_energies.balance_error();
}

template <int dim>
double
Equilibrium<dim>::store_energies(const PointEvaluator<dim> &u)
{
  current_energies.contact  = stored_energy(contact, fields.grid.communicator());
  const auto of_bulk        = bulk.work(u);
  current_energies.strain   = of_bulk.energy;
  current_energies.boundary = boundary_terms.energy(u, time);
  if (is_linear_but_for_contact())
    current_energies.ghost_penalty = bulk.ghost_energy(u);
  else
    {
      PointEvaluator<dim> total = bulk.step_start()->displacement_field();
      total += u;
      current_energies.ghost_penalty = bulk.ghost_energy(total);
    }
  return of_bulk.dissipation;
}

template <int dim>
unsigned int
Equilibrium<dim>::n_rigid_unknowns() const
{
  return fields.n_trailing() - BoundaryTerms<dim>::n_multipliers(bodies);
}

template <int dim>
void
Equilibrium<dim>::start_step(const double time, const Vector &u, const ContactHistory<dim> &history,
                             const Energies &energies, const DrivingForces<dim> *driving)
{
  start_time = time;
  Vector r(u);
  take_as_accepted(time, u, history, r);
  DrivingForces<dim> unloaded;
  if (driving == nullptr)
    {
      // Loads grow from zero in the first step. Bodies may overlap: only contact is unbalanced.
      unloaded.of_rigid.assign(n_rigid_unknowns(), 0.);
      driving     = &unloaded;
      is_unloaded = true;
      accepted_driven.clear();
      accepted_dead_loads = 0.;
      accepted_reactions.equ(-1., contact_forces);
      r = contact_forces;
      set_zero_on_prescribed(r);
      for (auto &tractions : accepted_tractions)
        tractions.assign(tractions.size(), dealii::Tensor<1, dim>());
    }
  unbalanced.emplace();
  unbalanced->rigid.reinit(r);
  for (unsigned int i = 0; i < n_rigid_unknowns(); ++i)
    {
      const DofIndex index = fields.n_dofs() - n_rigid_unknowns() + i;
      if (!fields.owned().is_element(index))
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
  double cut = cut_energy(contact, history, fields.grid.communicator());
  cut += store_energies(at_points(accepted_u));
  current_energies.transfer += current_energies.stored() + cut - energies.stored();
}

template <int dim>
void
Equilibrium<dim>::resume(const double time, const Vector &u, const ContactHistory<dim> &history,
                         const Energies &energies)
{
  Vector r(u);
  take_as_accepted(time, u, history, r);
  current_energies = energies;
}

template <int dim>
void
Equilibrium<dim>::take_as_accepted(const double time, const Vector &u,
                                   const ContactHistory<dim> &history, Vector &r)
{
  accepted_u    = u;
  accepted_time = time;
  is_unloaded   = false;
  set_time(time, accepted_u);
  residual(accepted_u, history, r);
  accepted_dead_loads = dead_loads;
  reactions(accepted_reactions);
  accepted_reactions += applied_forces;
  for (unsigned int i = 0; i < BoundaryTerms<dim>::n_multipliers(bodies); ++i)
    if (fields.owned().is_element(fields.multiplier(i)))
      accepted_prescribed(fields.multiplier(i)) = loads(fields.multiplier(i));
  accepted_prescribed.compress(dealii::VectorOperation::insert);
  remember_conditions(at_points(accepted_u));
}

template <int dim>
DrivingForces<dim>
Equilibrium<dim>::driving_forces() const
{
  DrivingForces<dim> result;
  result.of_points = accepted_driven;
  result.of_rigid.resize(n_rigid_unknowns());
  for (unsigned int i = 0; i < n_rigid_unknowns(); ++i)
    {
      const DofIndex index = fields.n_dofs() - n_rigid_unknowns() + i;
      if (fields.owned().is_element(index))
        result.of_rigid[i] = accepted_reactions(index);
    }
  dealii::Utilities::MPI::sum(result.of_rigid, fields.grid.communicator(), result.of_rigid);
  return result;
}

template <int dim>
void
Equilibrium<dim>::remember_conditions(const PointEvaluator<dim> &u)
{
  accepted_driven.clear();
  for (unsigned int i = 0; i < boundary_terms.regions().size(); ++i)
    {
      const auto &region      = boundary_terms.regions()[i];
      const bool  is_pressure = is_following_pressure(region);
      if (!is_pressure && !region.condition->prescribes_displacement())
        continue;
      const auto tractions = boundary_terms.tractions(i, u, time);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto &point = region.points[q];
          if (!is_pressure)
            accepted_driven.push_back({i, point.reference_position, point.weight * tractions[q]});
          else
            {
              accepted_tractions[i][q]     = tractions[q];
              accepted_displacements[i][q] = boundary_terms.displacement_at(region, q, u);
            }
        }
    }
}

#define SCREE_INSTANTIATE(dim)                                                                            \
  template double Equilibrium<dim>::work_of_multipliers(const Vector &);                                  \
  template bool   Equilibrium<dim>::is_following_pressure(const BoundaryRegion<dim> &) const;             \
  template double Equilibrium<dim>::work_of_pressures(const PointEvaluator<dim> &) const;                 \
  template double Equilibrium<dim>::work_on_prescribed(const std::vector<DrivenPoint<dim>> &)             \
    const;                                                                                                \
  template double Equilibrium<dim>::work_of_step(const Vector &, const PointEvaluator<dim> &);            \
  template double Equilibrium<dim>::released_work(const Vector &, const ContactHistory<dim> &)            \
    const;                                                                                                \
  template void               Equilibrium<dim>::accept(const Vector &, const ContactHistory<dim> &);      \
  template void               Equilibrium<dim>::count_overlap();                                          \
  template double             Equilibrium<dim>::store_energies(const PointEvaluator<dim> &);              \
  template unsigned int       Equilibrium<dim>::n_rigid_unknowns() const;                                 \
  template void               Equilibrium<dim>::start_step(const double, const Vector &,                  \
                                                           const ContactHistory<dim> &, const Energies &, \
                                                           const DrivingForces<dim> *);                   \
  template DrivingForces<dim> Equilibrium<dim>::driving_forces() const;                                   \
  template void               Equilibrium<dim>::resume(const double, const Vector &,                      \
                                                       const ContactHistory<dim> &, const Energies &);    \
  template void               Equilibrium<dim>::take_as_accepted(const double, const Vector &,            \
                                                                 const ContactHistory<dim> &, Vector &);  \
  template void               Equilibrium<dim>::remember_conditions(const PointEvaluator<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
