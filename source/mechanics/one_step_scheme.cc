#include <scree/mechanics/added_spin.h>
#include <scree/mechanics/one_step_scheme.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
/** The same combination of vectors. */
dealii::TrilinosWrappers::MPI::Vector
combined(const StepFormula::Combination              &combination,
         const dealii::TrilinosWrappers::MPI::Vector &d, const Rates &rates)
{
  dealii::TrilinosWrappers::MPI::Vector result(d);
  result *= combination.motion;
  result.add(combination.velocity, rates.velocity, combination.acceleration, rates.acceleration);
  return result;
}
} // namespace

StepFormula::Combination
StepFormula::start_velocity() const
{
  const double of_end = velocity.motion / acceleration.motion;
  return {0., velocity.velocity - of_end * acceleration.velocity,
          velocity.acceleration - of_end * acceleration.acceleration};
}

StepFormula
newmark(const double dt, const double beta, const double gamma)
{
  const StepFormula::Combination a{1. / (beta * dt * dt), -1. / (beta * dt), 1. - 0.5 / beta};
  const StepFormula::Combination v{gamma * dt * a.motion, 1. + gamma * dt * a.velocity,
                                   dt * (1. - gamma + gamma * a.acceleration)};
  const double                   weight = 0.5 / beta;
  const double                   wrong  = std::max(beta - 1. / 6., gamma - 0.5) * dt * dt;
  return {a, v, a, 0., weight, dt * (1. - gamma * weight), -weight, {wrong, -wrong, 2}};
}

StepFormula
backward_euler(const double dt)
{
  const StepFormula::Combination a{1. / (dt * dt), -1. / dt, 0.};
  return {a, {1. / dt, 0., 0.}, a, 0., 1., 0., -1., {0.5 * dt * dt, 0., 1}};
}

StepFormula
generalized_alpha(const double dt, const double rho)
{
  const double alpha_m = (2. * rho - 1.) / (rho + 1.), alpha_f = rho / (rho + 1.);
  const double beta   = 0.25 * std::pow(1. - alpha_m + alpha_f, 2);
  StepFormula  result = newmark(dt, beta, 0.5 - alpha_m + alpha_f);
  const double of_end = (1. - alpha_m) / (1. - alpha_f);
  const auto  &a      = result.acceleration;
  result.balance
    = {of_end * a.motion, of_end * a.velocity, of_end * a.acceleration + alpha_m / (1. - alpha_f)};
  result.initial_share = alpha_f / (1. - alpha_f);
  result.contact_weight *= of_end;
  const double wrong = (beta + 0.5 * (alpha_m - alpha_f) - 1. / 6.) * dt * dt;
  result.local_error = {wrong, -wrong, 2};
  return result;
}

template <int dim>
OneStepScheme<dim>::OneStepScheme(const std::function<StepFormula(double)> &formula)
    : formula(formula)
{
}

template <int dim>
std::optional<typename OneStepScheme<dim>::Vector>
OneStepScheme<dim>::predicted(const Kinematics<dim> &, const State<dim> &state,
                              const double time) const
{
  const double dt     = time - state.time;
  const auto  &rates  = state.predictor.rates;
  Vector       result = state.displacement;
  result.add(dt, rates.velocity, 0.5 * dt * dt, rates.acceleration);
  return result;
}

template <int dim>
Inertia<dim>
OneStepScheme<dim>::inertia(const std::shared_ptr<const Mass<dim>> &mass, const State<dim> &state,
                            const double time) const
{
  const StepFormula of_step = formula(time - state.time);
  const auto       &rates   = state.predictor.rates;
  Inertia<dim>      result{mass, of_step.balance.motion, of_step.contact_weight, rates.forces};
  // a* = c d + (combination of v_n and a_n), d = u - u_n.
  Vector known
    = combined({-of_step.balance.motion, of_step.balance.velocity, of_step.balance.acceleration},
               state.displacement, rates);
  mass->matrix()->vmult(result.forces, known);
  result.forces.sadd(-1., of_step.initial_share, rates.forces);
  const Vector where = mass->with_ghosts(state.displacement), v = mass->with_ghosts(rates.velocity),
               a = mass->with_ghosts(rates.acceleration);
  for (const auto &body : mass->rigid().bodies())
    {
      const auto pose          = mass->pose(body, where);
      const auto motion        = mass->rigid().read(body, v, a);
      auto       result_points = body.positions(pose);
      const auto velocities    = body.velocities(pose, motion),
                 accelerations = body.accelerations(pose, motion);
      for (unsigned int p = 0; p < result_points.size(); ++p)
        result_points[p] = of_step.balance.motion * result_points[p]
                           - of_step.balance.velocity * velocities[p]
                           - of_step.balance.acceleration * accelerations[p];
      result.rigid.push_back(result_points);
    }
  return result;
}

template <int dim>
Rates
OneStepScheme<dim>::rates(const Mass<dim> *mass, const State<dim> &state, const Vector &u,
                          const Vector &by_contact, const std::vector<bool> &turns_freely,
                          const double time) const
{
  const StepFormula of_step = formula(time - state.time);
  const auto       &before  = state.predictor.rates;
  Vector            d(u);
  d -= state.displacement;
  Rates result{combined(of_step.velocity, d, before), combined(of_step.acceleration, d, before),
               before.forces};
  result.velocity.add(of_step.velocity_by_contact, by_contact);
  result.acceleration.add(of_step.acceleration_by_contact, by_contact);
  const std::vector<bool> loses_spin
    = of_step.balances_at_end() ? turns_freely : std::vector<bool>(turns_freely.size());
  mass->take_off_spins(loses_spin, d, combined(of_step.start_velocity(), d, before),
                       result.velocity);
  set_rates_of_rigid(of_step, *mass, state, u, by_contact, loses_spin, result);
  return result;
}

template <int dim>
LocalErrorFormula
OneStepScheme<dim>::local_error(const double step_size) const
{
  const StepFormula of_step = formula(step_size);
  LocalErrorFormula result  = of_step.local_error;
  result.mass_factor        = of_step.balance.motion;
  return result;
}

template <int dim>
void
OneStepScheme<dim>::set_rates_of_rigid(const StepFormula &of_step, const Mass<dim> &mass,
                                       const State<dim> &state, const Vector &u,
                                       const Vector            &by_contact,
                                       const std::vector<bool> &loses_spin, Rates &rates) const
{
  const auto  &before = state.predictor.rates;
  const Vector where = mass.with_ghosts(state.displacement), there = mass.with_ghosts(u),
               of_contact = mass.with_ghosts(by_contact), v = mass.with_ghosts(before.velocity),
               a = mass.with_ghosts(before.acceleration);
  for (const auto &body : mass.rigid().bodies())
    {
      const auto pose = mass.pose(body, where), next = mass.pose(body, there);
      const auto motion     = mass.rigid().read(body, v, a);
      auto       velocities = body.velocities(pose, motion),
           accelerations    = body.accelerations(pose, motion);
      const auto x_n = body.positions(pose), x = body.positions(next);
      auto       from_rest = mass.rigid().read(body, of_contact, of_contact);
      from_rest.velocity   = {};
      from_rest.spin       = {};
      const auto     a_c   = body.accelerations(next, from_rest);
      AddedSpin<dim> spin;
      for (unsigned int p = 0; p < x.size(); ++p)
        {
          const dealii::Tensor<1, dim> step = x[p] - x_n[p], v_n = velocities[p],
                                       a_n = accelerations[p];
          velocities[p] = of_step.velocity(step, v_n, a_n) + of_step.velocity_by_contact * a_c[p];
          accelerations[p]
            = of_step.acceleration(step, v_n, a_n) + of_step.acceleration_by_contact * a_c[p];
          spin.add(1., dealii::Point<dim>(x[p]), step, of_step.start_velocity()(step, v_n, a_n));
        }
      spin.finish();
      for (unsigned int p = 0; p < x.size() && loses_spin[body.body]; ++p)
        velocities[p] -= spin.velocity(dealii::Point<dim>(x[p]));
      mass.rigid().write(body, body.rates(next, velocities, accelerations), rates.velocity,
                         rates.acceleration);
    }
  for (Vector *vector : {&rates.velocity, &rates.acceleration})
    vector->compress(dealii::VectorOperation::insert);
}

template class OneStepScheme<2>;
template class OneStepScheme<3>;
} // namespace scree
