#include <scree/application/model.h>
#include <scree/mechanics/motion_rates.h>

// Where bodies with inertia begin to move, and how their motion comes to the next grid.
namespace scree
{
template <int dim>
void
Model<dim>::start_motion(const double step_size)
{
  const Mass<dim>  &mass        = *problem().mass;
  Equilibrium<dim> &equilibrium = problem().equilibrium();
  Rates            &rates       = current.predictor.rates;
  const auto        velocities  = mass.initial_velocities();
  rates.velocity                = mass.fit(velocities);
  rates.acceleration            = rates.velocity;
  rates.acceleration            = 0.;
  mass.set_initial_motion(rates);
  set_prescribed_rates(equilibrium, current.time, step_size, nullptr, rates);
  if (!current.has_started)
    set_rigid_rows();
  // What is prescribed and the loads act from the beginning.
  Vector u = current.displacement, r = u;
  equilibrium.set_time(current.time, u);
  equilibrium.residual(u, current.contact, r);
  r = equilibrium.forces_without_inertia();
  mass.set_accelerations(
    u, r, [&](Vector &v) { equilibrium.strong_supports().set_zero(v); }, rates);
  rates.forces = r;
  if (is_moving())
    {
      current.points.velocity     = velocities;
      current.points.acceleration = mass.at_points(rates.acceleration);
      current.points.forcing      = mass.at_points(mass.solve(r));
      keep_rates_of_rigid();
    }
  const double kinetic = mass.kinetic_energy(u, rates);
  equilibrium.set_kinetic_energy(kinetic);
  if (!current.has_started)
    {
      equilibrium.start_motion(current.time, u, current.contact);
      current.energies = equilibrium.energies();
      return;
    }
  current.energies.kinetic = kinetic;
  current.energies.external_work += kinetic;
  is_moving() ? start_step() : resume_problem();
}

template <int dim>
void
Model<dim>::keep_rates_of_rigid()
{
  const auto &rates = current.predictor.rates;
  const auto  v     = problem().mass->with_ghosts(rates.velocity),
             a      = problem().mass->with_ghosts(rates.acceleration),
             f      = problem().mass->with_ghosts(rates.forces);
  current.predictor.rates_of_rigid.resize(current.bodies.size());
  for (unsigned int b = 0; b < current.bodies.size(); ++b)
    if (current.bodies[b].is_rigid())
      current.predictor.rates_of_rigid[b]
        = {{rigid_unknowns(problem().space, b, v), rigid_unknowns(problem().space, b, a),
            rigid_unknowns(problem().space, b, f)}};
}

template <int dim>
void
Model<dim>::fit_rates()
{
  const Mass<dim>              &mass  = *problem().mass;
  const DisplacementSpace<dim> &space = problem().space;
  Rates                        &rates = current.predictor.rates;
  rates.velocity                      = mass.fit(current.points.velocity);
  rates.acceleration                  = mass.fit(current.points.acceleration);
  rates.forces                        = mass.forces(current.points.forcing);
  for (unsigned int b = 0; b < current.bodies.size(); ++b)
    if (current.bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (const DofIndex row = space.rigid_unknown(b) + m; space.owned().is_element(row))
          {
            rates.velocity(row)     = current.predictor.rates_of_rigid[b][0][m];
            rates.acceleration(row) = current.predictor.rates_of_rigid[b][1][m];
            rates.forces(row)       = current.predictor.rates_of_rigid[b][2][m];
          }
  for (Vector *vector : {&rates.velocity, &rates.acceleration, &rates.forces})
    vector->compress(dealii::VectorOperation::insert);
}

#define SCREE_INSTANTIATE(dim)                          \
  template void Model<dim>::start_motion(const double); \
  template void Model<dim>::keep_rates_of_rigid();      \
  template void Model<dim>::fit_rates();

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
