#include <scree/mechanics/equilibrium.h>

// What goes from step to step: inertia, accepted states, energies; and what others see of the
// parts.
namespace scree
{
template <int dim>
void
Equilibrium<dim>::set_inertia(Inertia<dim> of_step)
{
  inertia        = std::move(of_step);
  inertia_forces = 0.;
}

template <int dim>
bool
Equilibrium<dim>::has_inertia() const
{
  return inertia.mass != nullptr;
}

template <int dim>
void
Equilibrium<dim>::set_kinetic_energy(const double energy)
{
  kinetic_energy = energy;
}

template <int dim>
typename Equilibrium<dim>::Vector
Equilibrium<dim>::forces_without_inertia() const
{
  Vector r(loads);
  r -= internal_forces;
  r += applied_forces;
  set_zero_where_not_sought(r);
  return r;
}

template <int dim>
typename Equilibrium<dim>::Vector
Equilibrium<dim>::accelerations_by_contact(const Vector &u) const
{
  Vector r(contact_forces);
  set_zero_where_not_sought(r);
  Rates result{r, r, {}};
  result.velocity = 0.;
  mass->set_accelerations(
    u, r, [&](Vector &v) { supports.set_zero(v); }, result);
  return result.acceleration;
}

template <int dim>
std::vector<RigidBodyState<dim>>
Equilibrium<dim>::rigid_states(const Vector &ghosted_u) const
{
  auto result = rigid.states(ghosted_u);
  for (unsigned int i = 0; i < inertia.rigid.size(); ++i)
    {
      const auto [body, load] = inertia.rigid_load(i, ghosted_u);
      const auto moment       = rigid.pose(body, ghosted_u).moment(load);
      const auto applied      = rigid.applied_load(body, time);
      for (auto &state : result)
        if (state.body == body)
          {
            for (unsigned int d = 0; d < dim; ++d)
              state.force[d] = bodies[body].rigid->is_free(d) ? applied.first[d]
                                                              : state.force[d] + load.force[d];
            for (unsigned int m = dim; m < n_rigid_components<dim>; ++m)
              {
                const unsigned int axis = rotation_axis<dim>(m);
                state.moment[axis]      = bodies[body].rigid->is_free(m)
                                            ? applied.second[axis]
                                            : state.moment[axis] + moment[axis];
              }
          }
    }
  return result;
}

template <int dim>
EvaluatedState<dim>
Equilibrium<dim>::evaluated(const Vector &u) const
{
  Vector driving(internal_forces);
  reactions(driving);
  driving += applied_forces;
  return {time,
          u,
          at_points(u),
          loads,
          dead_loads,
          contact_forces,
          driving,
          kinetic_energy,
          is_static ? 0.5 : 0.};
}

template <int dim>
typename Equilibrium<dim>::Vector
Equilibrium<dim>::take_as_accepted(const double time, const ContactHistory<dim> &history, Vector &u)
{
  set_time(time, u);
  ledger.set_accepted(time, u);
  Vector r(u);
  residual(u, history, r);
  return r;
}

template <int dim>
void
Equilibrium<dim>::start_step(const double time, const Vector &u, const ContactHistory<dim> &history,
                             const Energies &energies, const DrivingForces<dim> *driving)
{
  Vector accepted   = u;
  Vector unbalanced = take_as_accepted(time, history, accepted);
  if (driving == nullptr)
    {
      // Bodies may overlap: only contact is unbalanced.
      unbalanced = contact_forces;
      set_zero_on_prescribed(unbalanced);
    }
  ledger.start_step(evaluated(accepted), unbalanced, history, energies, driving);
  if (!is_static)
    ledger.start_without_transfer(energies);
}

template <int dim>
void
Equilibrium<dim>::resume(const double time, const Vector &u, const ContactHistory<dim> &history,
                         const Energies &energies)
{
  Vector accepted = u;
  take_as_accepted(time, history, accepted);
  ledger.resume(evaluated(accepted), energies);
}

template <int dim>
void
Equilibrium<dim>::start_motion(const double time, const Vector &u,
                               const ContactHistory<dim> &history)
{
  Vector accepted = u;
  take_as_accepted(time, history, accepted);
  ledger.start_motion(evaluated(accepted));
}

template <int dim>
void
Equilibrium<dim>::accept(const Vector &u, const ContactHistory<dim> &old_history)
{
  ledger.accept(evaluated(u), old_history);
}

template <int dim>
void
Equilibrium<dim>::accept_as_transfer(const Vector &u, const ContactHistory<dim> &old_history)
{
  ledger.accept_as_transfer(evaluated(u), old_history);
}

template <int dim>
void
Equilibrium<dim>::count_overlap()
{
  ledger.count_overlap();
}

template <int dim>
DrivingForces<dim>
Equilibrium<dim>::driving_forces() const
{
  return ledger.driving_forces();
}

template <int dim>
const Energies &
Equilibrium<dim>::energies() const
{
  return ledger.energies();
}

template <int dim>
std::vector<double>
Equilibrium<dim>::tangent_changes() const
{
  return contact.tangent_changes();
}

template <int dim>
const RigidBodies<dim> &
Equilibrium<dim>::rigid_bodies() const
{
  return rigid;
}

template <int dim>
bool
Equilibrium<dim>::is_linear_elsewhere() const
{
  return bulk.is_linear() && boundary_terms.is_linear();
}

template <int dim>
const StrongSupports<dim> &
Equilibrium<dim>::strong_supports() const
{
  return supports;
}

template <int dim>
const FreeBodies<dim> &
Equilibrium<dim>::free_motions() const
{
  return free;
}

template <int dim>
const std::vector<FreeMotion> &
Equilibrium<dim>::free_bodies() const
{
  return free.motions();
}

using TrilinosVector = dealii::TrilinosWrappers::MPI::Vector;

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void           Equilibrium<dim>::set_inertia(Inertia<dim>);                             \
  template bool           Equilibrium<dim>::has_inertia() const;                                   \
  template void           Equilibrium<dim>::set_kinetic_energy(const double);                      \
  template TrilinosVector Equilibrium<dim>::forces_without_inertia() const;                        \
  template TrilinosVector Equilibrium<dim>::accelerations_by_contact(const Vector &) const;        \
  template std::vector<RigidBodyState<dim>> Equilibrium<dim>::rigid_states(const Vector &) const;  \
  template EvaluatedState<dim>              Equilibrium<dim>::evaluated(const Vector &) const;     \
  template TrilinosVector                   Equilibrium<dim>::take_as_accepted(                    \
                      const double, const ContactHistory<dim> &, Vector &);                        \
  template void Equilibrium<dim>::start_step(const double, const Vector &,                         \
                                             const ContactHistory<dim> &, const Energies &,        \
                                             const DrivingForces<dim> *);                          \
  template void Equilibrium<dim>::resume(const double, const Vector &,                             \
                                         const ContactHistory<dim> &, const Energies &);           \
  template void Equilibrium<dim>::start_motion(const double, const Vector &,                       \
                                               const ContactHistory<dim> &);                       \
  template void Equilibrium<dim>::accept(const Vector &, const ContactHistory<dim> &);             \
  template void Equilibrium<dim>::accept_as_transfer(const Vector &, const ContactHistory<dim> &); \
  template void Equilibrium<dim>::count_overlap();                                                 \
  template DrivingForces<dim>             Equilibrium<dim>::driving_forces() const;                \
  template const Energies                &Equilibrium<dim>::energies() const;                      \
  template std::vector<double>            Equilibrium<dim>::tangent_changes() const;               \
  template const RigidBodies<dim>        &Equilibrium<dim>::rigid_bodies() const;                  \
  template bool                           Equilibrium<dim>::is_linear_elsewhere() const;           \
  template const StrongSupports<dim>     &Equilibrium<dim>::strong_supports() const;               \
  template const FreeBodies<dim>         &Equilibrium<dim>::free_motions() const;                  \
  template const std::vector<FreeMotion> &Equilibrium<dim>::free_bodies() const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
