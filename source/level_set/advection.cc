#include <scree/level_set/advection.h>
#include <scree/level_set/map_velocity.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
// max sum_i |v_i| over the nodes.
template <int dim>
double
largest_speed(const NodalVectors<dim> &v)
{
  double result = 0;
  for (std::size_t i = 0; i < v[0].size(); ++i)
    {
      double sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        sum += std::abs(v[d][i]);
      AssertThrow(std::isfinite(sum), ExcMessage("A level-set velocity is not finite."));
      result = std::max(result, sum);
    }
  return result;
}

// The arrays of a Runge-Kutta step and the velocities at its start, middle and end.
template <int dim>
class Stepper
{
public:
  using Velocity = std::function<void(double, NodalVectors<dim> &)>;

  // With `steady` the velocity is asked for once.
  Stepper(const Lattice<dim> &lattice, const Velocity &velocity, const AdvectionScheme &scheme,
          bool steady);

  // max sum_i |v_i| at the start of the step.
  double speed() const;

  void step(double time, double dt);

  std::vector<double> phi; // with halo
  HaloGrid<dim>       grid;

private:
  const NodalVectors<dim> &velocity_at(double time, NodalVectors<dim> &storage);

  void stage(const NodalVectors<dim> &v, const StageWeights &weights,
             const std::vector<double> &from, std::vector<double> &to) const;

  const Velocity        &velocity;
  const AdvectionScheme &scheme;
  const bool             steady;
  NodalVectors<dim>      at_start, at_end, at_middle;
  std::vector<double>    phi_1, phi_2;
};

template <int dim>
Stepper<dim>::Stepper(const Lattice<dim> &lattice, const Velocity &velocity,
                      const AdvectionScheme &scheme, const bool steady)
    : grid{lattice.n_nodes(), lattice.spacing()}
    , velocity(velocity)
    , scheme(scheme)
    , steady(steady)
{
  phi   = grid.with_halo(lattice.values());
  phi_1 = phi;
  phi_2 = phi;
  for (auto &component : at_start)
    component.assign(lattice.values().size(), 0.);
  velocity(0., at_start);
  at_end = at_middle = at_start;
}

template <int dim>
double
Stepper<dim>::speed() const
{
  return largest_speed<dim>(at_start);
}

template <int dim>
const NodalVectors<dim> &
Stepper<dim>::velocity_at(const double time, NodalVectors<dim> &storage)
{
  if (steady)
    return at_start;
  velocity(time, storage);
  return storage;
}

template <int dim>
void
Stepper<dim>::stage(const NodalVectors<dim> &v, const StageWeights &weights,
                    const std::vector<double> &from, std::vector<double> &to) const
{
  hj_stage<dim>(grid, scheme.upwinding, v, weights, {{&from, &phi}}, to);
}

template <int dim>
void
Stepper<dim>::step(const double time, const double dt)
{
  // phi_1 = phi_n + dt L(phi_n, t)
  stage(at_start, {0., dt}, phi, phi_1);
  const NodalVectors<dim> &v_end = velocity_at(time + dt, at_end);
  if (scheme.time_order == 1)
    phi.swap(phi_1);
  else if (scheme.time_order == 2)
    // phi_{n+1} = 1/2 phi_n + 1/2 (phi_1 + dt L(phi_1, t + dt))
    stage(v_end, {0.5, dt}, phi_1, phi);
  else
    {
      // phi_2 = 3/4 phi_n + 1/4 (phi_1 + dt L(phi_1, t + dt))
      stage(v_end, {0.75, dt}, phi_1, phi_2);
      // phi_{n+1} = 1/3 phi_n + 2/3 (phi_2 + dt L(phi_2, t + dt/2))
      stage(velocity_at(time + 0.5 * dt, at_middle), {1. / 3., dt}, phi_2, phi);
    }
  if (!steady)
    at_start.swap(at_end);
}

template <int dim>
unsigned int
advance(Lattice<dim> &lattice, const std::function<void(double, NodalVectors<dim> &)> &velocity,
        const double duration, const AdvectionScheme &scheme, const bool steady)
{
  Assert(scheme.time_order >= 1 && scheme.time_order <= 3, ExcMessage("Order 1, 2 or 3."));
  Assert(scheme.cfl > 0 && duration >= 0, ExcMessage("Positive CFL number and duration."));
  Stepper<dim> stepper(lattice, velocity, scheme, steady);
  double       time = 0, speed = stepper.speed();
  unsigned int n_steps = 0, n_left = 1;
  for (; n_left > 0; ++n_steps, --n_left)
    {
      if (n_steps > 0 && !steady)
        speed = stepper.speed();
      const double left  = duration - time;
      const double bound = std::ceil(left * speed / (scheme.cfl * lattice.spacing()) - 1e-10);
      AssertThrow(bound < 1e9, ExcMessage("A level-set velocity is too large for its lattice."));
      n_left          = std::max(1u, static_cast<unsigned int>(std::max(bound, 1.)));
      const double dt = left / n_left;
      stepper.step(time, dt);
      time += dt;
    }
  stepper.grid.copy_nodes(stepper.phi, lattice.values());
  return n_steps;
}
} // namespace

template <int dim>
AdvectionCount
advect(Lattice<dim> &lattice, const std::function<void(double, NodalVectors<dim> &)> &velocity,
       const double duration, const AdvectionScheme &scheme)
{
  return {advance<dim>(lattice, velocity, duration, scheme, false), 0};
}

template <int dim>
AdvectionCount
advect(Lattice<dim> &lattice, const NodalVectors<dim> &velocity, const double duration,
       const AdvectionScheme &scheme)
{
  return {
    advance<dim>(
      lattice, [&](const double, NodalVectors<dim> &v) { v = velocity; }, duration, scheme, true),
    0};
}

template <int dim>
AdvectionCount
advect_increment(Lattice<dim> &lattice, const NodalVectors<dim> &du, const IncrementMotion motion,
                 const AdvectionScheme &scheme)
{
  for (unsigned int d = 0; d < dim; ++d)
    AssertDimension(du[d].size(), lattice.values().size());
  if (motion == IncrementMotion::frozen_velocity)
    return {advance<dim>(
              lattice, [&](const double, NodalVectors<dim> &v) { v = du; }, 1., scheme, true),
            0};

  largest_speed<dim>(du); // throws unless finite
  AdvectionCount count{1, 0};
  if (motion == IncrementMotion::map_velocity)
    {
      const auto velocity = [&](const double tau, NodalVectors<dim> &v) {
        if (tau == 0)
          v = du;
        else
          count.n_unconverged
            += map_velocity<dim>(lattice.n_nodes(), lattice.spacing(), du, tau, v);
      };
      count.n_steps = advance<dim>(lattice, velocity, 1., scheme, false);
      return count;
    }

  NodalVectors<dim> v = du;
  count.n_unconverged = map_velocity<dim>(lattice.n_nodes(), lattice.spacing(), du, 1., v);
  std::vector<double> moved(lattice.values().size());
  for (std::size_t i = 0; i < moved.size(); ++i)
    {
      Point<dim> X = lattice.node(lattice.index(i));
      for (unsigned int d = 0; d < dim; ++d)
        X[d] -= v[d][i];
      moved[i] = lattice.value(X, 3);
    }
  lattice.values().swap(moved);
  return count;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template AdvectionCount advect<dim>(Lattice<dim> &,                                           \
                                      const std::function<void(double, NodalVectors<dim> &)> &, \
                                      double, const AdvectionScheme &);                         \
  template AdvectionCount advect<dim>(Lattice<dim> &, const NodalVectors<dim> &, double,        \
                                      const AdvectionScheme &);                                 \
  template AdvectionCount advect_increment<dim>(Lattice<dim> &, const NodalVectors<dim> &,      \
                                                IncrementMotion, const AdvectionScheme &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
