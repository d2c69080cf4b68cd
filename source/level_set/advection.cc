#include <scree/level_set/advection.h>
#include <scree/level_set/map_velocity.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace scree
{
using namespace dealii;

namespace
{
// max sum_i |v_i| over n nodes from `first` on.
template <int dim>
double
largest_speed(const NodalVectors<dim> &v, const std::size_t first, const std::size_t n)
{
  double result = 0;
  for (std::size_t i = first; i < first + n; ++i)
    {
      double sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        sum += std::abs(v[d][i]);
      AssertThrow(std::isfinite(sum), ExcMessage("A level-set velocity is not finite."));
      result = std::max(result, sum);
    }
  return result;
}

// The nodes that a motion by `duration` times `velocity` (of all nodes) concerns.
template <int dim>
NodeSet<dim>
moving_nodes(const Lattice<dim> &lattice, const NodalVectors<dim> &velocity, const double duration,
             const double band, const bool whole_blocks = true)
{
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const double        half_width = band * lattice.spacing();
  const NodeSet<dim>  near  = nodes_near_contour(grid, lattice.values(), half_width, whole_blocks);
  double              speed = 0;
  for (const NodeRun &run : near.runs)
    speed = std::max(speed, largest_speed<dim>(velocity, run.node, run.n));
  return nodes_near_contour(grid, lattice.values(), half_width + duration * speed, whole_blocks);
}

// The nodes' own vectors.
template <int dim>
NodalVectors<dim>
packed(const NodeSet<dim> &nodes, const NodalVectors<dim> &vectors)
{
  NodalVectors<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    nodes.pack(vectors[d], result[d]);
  return result;
}

// An array whose pages cost nothing until they are written.
using Scratch = std::unique_ptr<double[]>;

// The arrays of a Runge-Kutta step and the velocities at its start, middle and end.
template <int dim>
class Stepper
{
public:
  using Velocity = std::function<void(double, NodalVectors<dim> &)>;

  // `velocity` fills packed arrays; without it the velocity at the start stays.
  Stepper(const std::vector<double> &values, const NodeSet<dim> &nodes,
          const AdvectionScheme &scheme, const NodalVectors<dim> &at_start,
          const Velocity &velocity);

  // Steps for a time `duration`; returns their number.
  unsigned int run(double duration);

  void store(std::vector<double> &values) const;

private:
  void step(double time, double dt);

  const NodalVectors<dim> &velocity_at(double time, NodalVectors<dim> &storage);

  void stage(const NodalVectors<dim> &v, const StageWeights &weights, const Scratch &from,
             const Scratch &to) const;

  const NodeSet<dim>    &nodes;
  const AdvectionScheme &scheme;
  const Velocity        &velocity;
  NodalVectors<dim>      at_start, at_end, at_middle;
  Scratch                phi, phi_1, phi_2; // with halo
};

template <int dim>
Stepper<dim>::Stepper(const std::vector<double> &values, const NodeSet<dim> &nodes,
                      const AdvectionScheme &scheme, const NodalVectors<dim> &at_start,
                      const Velocity &velocity)
    : nodes(nodes)
    , scheme(scheme)
    , velocity(velocity)
    , at_start(at_start)
{
  Assert(scheme.time_order >= 1 && scheme.time_order <= 3, ExcMessage("Order 1, 2 or 3."));
  Assert(scheme.cfl > 0, ExcMessage("Positive CFL number."));
  for (Scratch *const array : {&phi, &phi_1, &phi_2})
    {
      array->reset(new double[nodes.grid.size()]);
      nodes.load(values, array->get());
    }
  if (velocity)
    at_end = at_middle = at_start;
}

template <int dim>
const NodalVectors<dim> &
Stepper<dim>::velocity_at(const double time, NodalVectors<dim> &storage)
{
  if (!velocity)
    return at_start;
  velocity(time, storage);
  return storage;
}

template <int dim>
void
Stepper<dim>::stage(const NodalVectors<dim> &v, const StageWeights &weights, const Scratch &from,
                    const Scratch &to) const
{
  hj_stage<dim>(nodes, scheme.upwinding, v, weights, {{from.get(), phi.get()}}, to.get());
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
  if (velocity)
    at_start.swap(at_end);
}

template <int dim>
unsigned int
Stepper<dim>::run(const double duration)
{
  Assert(duration >= 0, ExcMessage("The duration of an advection is negative."));
  double       time = 0, speed = largest_speed<dim>(at_start, 0, nodes.n_nodes);
  unsigned int n_steps = 0, n_left = 1;
  for (; n_left > 0; ++n_steps, --n_left)
    {
      if (n_steps > 0 && velocity)
        speed = largest_speed<dim>(at_start, 0, nodes.n_nodes);
      const double left  = duration - time;
      const double bound = std::ceil(left * speed / (scheme.cfl * nodes.grid.spacing) - 1e-10);
      AssertThrow(bound < 1e9, ExcMessage("A level-set velocity is too large for its lattice."));
      n_left          = std::max(1u, static_cast<unsigned int>(std::max(bound, 1.)));
      const double dt = left / n_left;
      step(time, dt);
      time += dt;
    }
  return n_steps;
}

template <int dim>
void
Stepper<dim>::store(std::vector<double> &values) const
{
  nodes.store(phi.get(), values);
}

template <int dim>
void
assert_sizes(const Lattice<dim> &lattice, const NodalVectors<dim> &vectors)
{
  for (unsigned int d = 0; d < dim; ++d)
    AssertDimension(vectors[d].size(), lattice.values().size());
}
template <int dim>
AdvectionCount
advanced(Stepper<dim> &stepper, Lattice<dim> &lattice, const NodeSet<dim> &nodes,
         const double duration)
{
  const unsigned int n_steps = stepper.run(duration);
  stepper.store(lattice.values());
  return {n_steps, 0, nodes.n_nodes};
}
} // namespace

template <int dim>
AdvectionCount
advect(Lattice<dim> &lattice, const std::function<void(double, NodalVectors<dim> &)> &velocity,
       const double duration, const AdvectionScheme &scheme)
{
  NodalVectors<dim> everywhere;
  for (auto &component : everywhere)
    component.assign(lattice.values().size(), 0.);
  velocity(0., everywhere);
  const NodeSet<dim>      nodes    = moving_nodes<dim>(lattice, everywhere, duration, scheme.band);
  const NodalVectors<dim> at_start = packed<dim>(nodes, everywhere);

  typename Stepper<dim>::Velocity at_nodes = velocity;
  if (nodes.n_nodes < lattice.values().size())
    at_nodes = [&](const double time, NodalVectors<dim> &v) {
      velocity(time, everywhere);
      for (unsigned int d = 0; d < dim; ++d)
        nodes.pack(everywhere[d], v[d]);
    };
  Stepper<dim> stepper(lattice.values(), nodes, scheme, at_start, at_nodes);
  return advanced(stepper, lattice, nodes, duration);
}

template <int dim>
AdvectionCount
advect(Lattice<dim> &lattice, const NodalVectors<dim> &velocity, const double duration,
       const AdvectionScheme &scheme)
{
  assert_sizes<dim>(lattice, velocity);
  const NodeSet<dim> nodes = moving_nodes<dim>(lattice, velocity, duration, scheme.band);
  const typename Stepper<dim>::Velocity steady;
  Stepper<dim> stepper(lattice.values(), nodes, scheme, packed<dim>(nodes, velocity), steady);
  return advanced(stepper, lattice, nodes, duration);
}

template <int dim>
AdvectionCount
advect_increment(Lattice<dim> &lattice, const NodalVectors<dim> &du, const IncrementMotion motion,
                 const AdvectionScheme &scheme)
{
  Assert(motion != IncrementMotion::reference_map, ExcMessage("See image_of_initial()."));
  if (motion == IncrementMotion::frozen_velocity)
    return advect<dim>(lattice, du, 1., scheme);

  assert_sizes<dim>(lattice, du);
  const NodeSet<dim> nodes
    = moving_nodes<dim>(lattice, du, 1., scheme.band, motion != IncrementMotion::semi_lagrangian);
  NodalVectors<dim> v = packed<dim>(nodes, du);
  largest_speed<dim>(v, 0, nodes.n_nodes); // throws unless finite
  AdvectionCount count{1, 0, nodes.n_nodes};
  if (motion == IncrementMotion::map_velocity)
    {
      const typename Stepper<dim>::Velocity velocity
        = [&](const double tau, NodalVectors<dim> &at_tau) {
            count.n_unconverged += map_velocity<dim>(nodes, du, tau, at_tau);
          };
      Stepper<dim> stepper(lattice.values(), nodes, scheme, v, velocity);
      count.n_steps = advanced(stepper, lattice, nodes, 1.).n_steps;
      return count;
    }

  count.n_unconverged = map_velocity<dim>(nodes, du, 1., v);
  std::vector<double> moved;
  values_at_departure<dim>(nodes, lattice.values(), v, moved);
  for (const NodeRun &run : nodes.runs)
    std::copy_n(moved.data() + run.packed, run.n, lattice.values().data() + run.node);
  return count;
}

namespace
{
/** Calls f(first, n) for the nodes between the runs of a set. */
template <int dim, typename F>
void
for_each_gap(const NodeSet<dim> &nodes, const std::size_t n_all, const F &f)
{
  std::size_t end = 0;
  for (const NodeRun &run : nodes.runs)
    {
      if (run.node > end)
        f(end, run.node - end);
      end = run.node + run.n;
    }
  if (n_all > end)
    f(end, n_all - end);
}
} // namespace

template <int dim>
AdvectionCount
image_of_initial(Lattice<dim> &lattice, const Lattice<dim> &initial, const NodalVectors<dim> &du,
                 const NodalVectors<dim> &displacement, NodalVectors<dim> &moved_by,
                 const double half_width)
{
  const std::size_t n_all = lattice.values().size();
  assert_sizes<dim>(lattice, du);
  assert_sizes<dim>(lattice, displacement);
  for (auto &component : moved_by)
    component.resize(n_all);
  const HaloGrid<dim> grid{lattice.n_nodes(), lattice.spacing()};
  const NodeSet<dim>  nodes     = nodes_near_contour(grid, lattice.values(), half_width);
  NodalVectors<dim>   increment = packed<dim>(nodes, du), u;
  largest_speed<dim>(increment, 0, nodes.n_nodes); // throws unless finite
  const std::size_t n_unconverged = map_velocity<dim>(nodes, du, 1., increment);
  for (unsigned int d = 0; d < dim; ++d)
    values_at_departure<dim>(nodes, displacement[d], increment, u[d]);
  const auto set
    = [&](const std::size_t node, const Tensor<1, dim> &way, const unsigned int degree) {
        for (unsigned int d = 0; d < dim; ++d)
          moved_by[d][node] = way[d];
        lattice.values()[node] = initial.value(lattice.node(lattice.index(node)) - way, degree);
      };
  for (const NodeRun &run : nodes.runs)
    for (int i = 0; i < run.n; ++i)
      {
        Tensor<1, dim> way;
        for (unsigned int d = 0; d < dim; ++d)
          way[d] = increment[d][run.packed + i] + u[d][run.packed + i];
        set(run.node + i, way, 3);
      }
  for_each_gap(nodes, n_all, [&](const std::size_t first, const std::size_t n) {
    for (std::size_t node = first; node < first + n; ++node)
      {
        Tensor<1, dim> way;
        for (unsigned int d = 0; d < dim; ++d)
          way[d] = du[d][node] + displacement[d][node];
        set(node, way, 1);
      }
  });
  return {1, n_unconverged, nodes.n_nodes};
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template AdvectionCount advect<dim>(Lattice<dim> &,                                           \
                                      const std::function<void(double, NodalVectors<dim> &)> &, \
                                      double, const AdvectionScheme &);                         \
  template AdvectionCount advect<dim>(Lattice<dim> &, const NodalVectors<dim> &, double,        \
                                      const AdvectionScheme &);                                 \
  template AdvectionCount advect_increment<dim>(Lattice<dim> &, const NodalVectors<dim> &,      \
                                                IncrementMotion, const AdvectionScheme &);      \
  template AdvectionCount image_of_initial<dim>(                                                \
    Lattice<dim> &, const Lattice<dim> &, const NodalVectors<dim> &, const NodalVectors<dim> &, \
    NodalVectors<dim> &, double);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
