#include <scree/base/exceptions.h>
#include <scree/state/gather.h>
#include <scree/state/gathered_state.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
/** Places closer than this part of the finest cell are the same. */
constexpr double resolution = 1e-9;

/** Calls f(body, position, first unknown) for the own nodes; those of several cells repeatedly. */
template <int dim, typename F>
void
for_each_node(const DisplacementSpace<dim> &space, const F &f)
{
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      if (space.owned().is_element(space.nodes(a)[i]))
        f(space.cells()[a].body, space.position(a, space.basis.node(i)), space.nodes(a)[i]);
}

/** Calls f(i, unknown) for the own ones of the unknowns without a node. */
template <int dim, typename F>
void
for_each_trailing(const DisplacementSpace<dim> &space, const F &f)
{
  for (unsigned int i = 0; i < space.n_trailing(); ++i)
    {
      const DofIndex unknown = space.n_dofs() - space.n_trailing() + i;
      if (space.owned().is_element(unknown))
        f(i, unknown);
    }
}

/** The row of a place. @throws UserError if there is none */
template <int dim>
const double *
row_of(const PlacedValues<dim> &values, const unsigned int number, const dealii::Point<dim> &x,
       const std::string &directory)
{
  const double *row = values.find(number, x);
  require(row != nullptr, directory, "the checkpoint belongs to another grid",
          "go on with the version of scree that wrote it (see log.txt), or start the run anew");
  return row;
}

void
require_consistent(const bool is_consistent, const std::string &directory)
{
  require(is_consistent, directory, "the checkpoint contradicts itself", "start the run anew");
}

/** Whether sums and squares of all of them are numbers, too. */
bool
are_numbers(const std::vector<double> &values)
{
  return std::all_of(values.begin(), values.end(),
                     [](const double x) { return std::abs(x) < 1e100; });
}

template <int dim>
double
diagonal(const dealii::BoundingBox<dim> &box)
{
  const auto [lower, upper] = box.get_boundary_points();
  return lower.distance(upper);
}

/** That points belong to bodies, are near the grid and no larger than it: else they would be
 * searched for in vain, or divided without end. */
template <int dim>
void
require_sound(const MaterialPoints<dim> &points, const std::size_t n_bodies,
              const dealii::BoundingBox<dim> &box, const std::string &directory)
{
  const double reach = diagonal(box);
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.body[i] < n_bodies && points.position[i].distance(box.center()) < reach
              && points.spacing(i) < reach,
            directory, "the checkpoint has material points outside of bodies and grid",
            "start the run anew");
}

/** The same of what contact remembers, which is searched for as well. */
template <int dim>
void
require_sound(const ContactMemory<dim> &memory, const dealii::BoundingBox<dim> &box,
              const std::string &directory)
{
  const double reach = diagonal(box);
  for (const std::size_t size :
       {memory.body_a.size(), memory.body_b.size(), memory.normal.size(), memory.weight.size(),
        memory.cell_size.size(), memory.tau.size(), memory.pressure.size()})
    require_consistent(size == memory.size(), directory);
  for (std::size_t i = 0; i < memory.size(); ++i)
    require_consistent(memory.position[i].distance(box.center()) < reach && memory.cell_size[i] > 0.
                         && memory.cell_size[i] < reach,
                       directory);
}

/** No node of a lattice, which reaches beyond its body, moves so far. */
template <int dim>
double
farthest_motion(const dealii::BoundingBox<dim> &box)
{
  return 1e3 * (diagonal(box) + box.get_boundary_points().first.norm());
}

/** That there is a motion of each body, as the next step asks for it. */
template <int dim>
void
require_motions(const GatheredState<dim> &saved, const std::vector<Body<dim>> &bodies,
                const dealii::BoundingBox<dim> &box, const std::string &directory)
{
  require_consistent(saved.last_step_size >= 0. && std::isfinite(saved.last_step_size), directory);
  if (saved.last_step_size > 0.)
    {
      require_consistent(saved.increments_of_bodies.size() == bodies.size()
                           && saved.increments_of_rigid.size() == bodies.size(),
                         directory);
      for (unsigned int b = 0; b < bodies.size(); ++b)
        require_consistent(saved.increments_of_bodies[b].is_whole(farthest_motion(box))
                             && saved.increments_of_bodies[b].is_empty() == bodies[b].is_rigid(),
                           directory);
    }
  require_consistent(!saved.has_inertia || saved.rates_of_rigid.size() == bodies.size(), directory);
  const std::size_t n_rigid
    = std::count_if(bodies.begin(), bodies.end(), [](const auto &body) { return body.is_rigid(); });
  require_consistent(saved.step_end.driving.of_rigid.size() == n_rigid * n_rigid_components<dim>,
                     directory);
}

template <int dim>
typename GatheredState<dim>::Geometry
saved_geometry(const Body<dim> &body, const bool is_reset)
{
  typename GatheredState<dim>::Geometry result;
  result.pose = body.pose.unknowns();
  if (body.is_rigid())
    return result;
  result.lower        = body.level_set.lower();
  result.n_nodes      = body.level_set.n_nodes();
  result.level_set    = body.level_set.values();
  result.box          = body.box;
  result.displacement = body.displacement;
  result.has_shape    = body.shape != nullptr;
  if (is_reset)
    {
      result.initial_lower     = body.initial_level_set->lower();
      result.initial_n_nodes   = body.initial_level_set->n_nodes();
      result.initial_level_set = body.initial_level_set->values();
    }
  return result;
}

template <int dim>
Lattice<dim>
restored_lattice(const LatticeFrame<dim> &frame, const typename Lattice<dim>::Index &lower,
                 const typename Lattice<dim>::Index &n, const std::vector<double> &values,
                 const std::string &directory)
{
  constexpr int farthest = 1 << 29; // what is near may be counted from there
  require_consistent(is_number_of_nodes<dim>(values.size(), n, 4) && are_numbers(values),
                     directory);
  for (const int node : lower)
    require_consistent(node > -farthest && node < farthest, directory);
  Lattice<dim> result(frame, lower, n);
  result.values() = values;
  return result;
}

template <int dim>
void
restore_geometry(const typename GatheredState<dim>::Geometry &saved, const bool is_reset,
                 const dealii::BoundingBox<dim> &background, const std::string &directory,
                 Body<dim> &geometry)
{
  const LatticeFrame<dim> frame = geometry.level_set.frame();
  geometry.level_set
    = restored_lattice<dim>(frame, saved.lower, saved.n_nodes, saved.level_set, directory);
  if (is_reset)
    geometry.initial_level_set = std::make_shared<const Lattice<dim>>(restored_lattice<dim>(
      frame, saved.initial_lower, saved.initial_n_nodes, saved.initial_level_set, directory));
  const auto [lower, upper] = saved.box.get_boundary_points();
  for (unsigned int d = 0; d < dim; ++d)
    require_consistent(lower[d] <= upper[d] && std::isfinite(upper[d] - lower[d]), directory);
  require_consistent(saved.displacement.is_whole(farthest_motion(background)), directory);
  geometry.box          = saved.box;
  geometry.displacement = saved.displacement;
  if (!saved.has_shape)
    geometry.shape = nullptr;
}

template <int dim>
void
gather_moving(const State<dim> &state, const MPI_Comm communicator, const bool is_reset,
              GatheredState<dim> &result)
{
  std::vector<double> points;
  points.reserve(state.points.size() * state.points.n_values());
  for (std::size_t i = 0; i < state.points.size(); ++i)
    state.points.pack(i, points);
  result.points                     = gather_arrays(points, communicator);
  result.step_end                   = state.step_end;
  result.start_gaps                 = state.start_gaps;
  result.step_end.driving.of_points = gather_joined(state.step_end.driving.of_points, communicator);
  result.increments_of_bodies       = state.predictor.of_bodies;
  result.increments_of_rigid        = state.predictor.of_rigid;
  result.rates_of_rigid             = state.predictor.rates_of_rigid;
  for (const Body<dim> &body : state.bodies)
    result.bodies.push_back(saved_geometry(body, is_reset));
}

/** The vectors of a state of a fixed geometry, with or without those of inertia. */
template <typename S>
auto
vectors_of(S &state, const bool has_inertia)
{
  std::vector result = {&state.displacement, &state.predictor.rates.velocity};
  if (has_inertia)
    result.insert(result.end(),
                  {&state.predictor.rates.acceleration, &state.predictor.rates.forces});
  return result;
}

template <int dim>
void
gather_fixed(const State<dim> &state, const DisplacementSpace<dim> &space,
             const ContactPoints<dim> &contact, GatheredState<dim> &result)
{
  const MPI_Comm communicator = space.grid.communicator();
  const double   length       = resolution * space.grid.finest_size();
  const auto     origin       = space.grid.box().get_boundary_points().first;
  const auto     vectors      = vectors_of(state, result.has_inertia);
  result.nodes                = PlacedValues<dim>(vectors.size() * dim, origin, length);
  for_each_node(space,
                [&](const unsigned int body, const dealii::Point<dim> &x, const DofIndex first) {
                  std::vector<double> row;
                  for (const auto *vector : vectors)
                    for (unsigned int d = 0; d < dim; ++d)
                      row.push_back((*vector)(first + d));
                  result.nodes.add(body, x, row);
                });
  result.nodes.gather(communicator);

  result.contact = PlacedValues<dim>(2 * dim + 2, origin, length);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto         &tau = state.contact.tau[i], &jump = state.contact.jump[i];
      std::vector<double> row(tau.begin_raw(), tau.end_raw());
      row.insert(row.end(), jump.begin_raw(), jump.end_raw());
      row.insert(row.end(), {state.contact.pressure[i], double(state.was_closed[i])});
      result.contact.add(contact.points()[i].pair, contact.points()[i].position, row);
    }
  result.contact.gather(communicator);

  result.trailing.resize(vectors.size() * space.n_trailing());
  for_each_trailing(space, [&](const unsigned int i, const DofIndex unknown) {
    for (unsigned int v = 0; v < vectors.size(); ++v)
      result.trailing[vectors.size() * i + v] = (*vectors[v])(unknown);
  });
  dealii::Utilities::MPI::sum(result.trailing, communicator, result.trailing);
}
} // namespace

template <int dim>
GatheredState<dim>
gather(const State<dim> &state, const DisplacementSpace<dim> &space,
       const ContactPoints<dim> &contact, const bool is_moving, const bool is_reset)
{
  GatheredState<dim> result;
  result.energies       = state.energies;
  result.last_step_size = state.predictor.step_size;
  result.has_inertia    = state.predictor.rates.acceleration.size() > 0;
  result.is_reset       = is_reset;
  if (is_moving)
    gather_moving(state, space.grid.communicator(), is_reset, result);
  else
    gather_fixed(state, space, contact, result);
  return result;
}

template <int dim>
void
restore_fixed(const GatheredState<dim> &saved, const DisplacementSpace<dim> &space,
              const ContactPoints<dim> &contact, const std::string &directory, State<dim> &state)
{
  const unsigned int n_vectors = saved.has_inertia ? 4 : 2;
  require_consistent(saved.nodes.is_whole(n_vectors * dim) && saved.contact.is_whole(2 * dim + 2)
                       && saved.trailing.size() == n_vectors * space.n_trailing(),
                     directory);
  const auto vectors = vectors_of(state, saved.has_inertia);
  for (auto *vector : vectors)
    *vector = state.displacement;
  for_each_node(space,
                [&](const unsigned int body, const dealii::Point<dim> &x, const DofIndex first) {
                  const double *row = row_of(saved.nodes, body, x, directory);
                  for (auto *vector : vectors)
                    for (unsigned int d = 0; d < dim; ++d)
                      (*vector)(first + d) = *row++;
                });
  for_each_trailing(space, [&](const unsigned int i, const DofIndex unknown) {
    for (unsigned int v = 0; v < n_vectors; ++v)
      (*vectors[v])(unknown) = saved.trailing[n_vectors * i + v];
  });
  for (auto *vector : vectors)
    vector->compress(dealii::VectorOperation::insert);
  state.predictor.step_size = saved.last_step_size;

  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      const double            *row   = row_of(saved.contact, point.pair, point.position, directory);
      std::copy_n(row, dim, state.contact.tau[i].begin_raw());
      std::copy_n(row + dim, dim, state.contact.jump[i].begin_raw());
      state.contact.pressure[i] = row[2 * dim];
      state.was_closed[i]       = row[2 * dim + 1] != 0.;
    }
  state.energies    = saved.energies;
  state.has_started = true;
}

template <int dim>
void
restore_moving(const GatheredState<dim> &saved, const dealii::BoundingBox<dim> &background,
               const MPI_Comm communicator, const std::string &directory, State<dim> &state)
{
  const unsigned int rank     = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int n_here   = dealii::Utilities::MPI::n_mpi_processes(communicator);
  const unsigned int n_values = state.points.n_values();
  require_consistent(saved.bodies.size() == state.bodies.size(), directory);
  for (const auto &points : saved.points)
    require_consistent(points.size() % n_values == 0 && are_numbers(points), directory);
  state.points = MaterialPoints<dim>(state.points.n_internal());
  for (unsigned int p = 0; p < saved.points.size(); ++p)
    if (p * n_here / saved.points.size() == rank)
      for (std::size_t i = 0; i < saved.points[p].size(); i += n_values)
        state.points.unpack(&saved.points[p][i]);
  require_sound(state.points, state.bodies.size(), background, directory);
  require_sound(saved.step_end.contact, background, directory);
  require_motions(saved, state.bodies, background, directory);
  state.step_end   = saved.step_end;
  state.start_gaps = saved.start_gaps;
  if (rank > 0)
    state.step_end.driving.of_points.clear();
  state.predictor.step_size      = saved.last_step_size;
  state.predictor.of_bodies      = saved.increments_of_bodies;
  state.predictor.of_rigid       = saved.increments_of_rigid;
  state.predictor.rates_of_rigid = saved.rates_of_rigid;
  for (unsigned int b = 0; b < state.bodies.size(); ++b)
    if (!state.bodies[b].is_rigid())
      restore_geometry<dim>(saved.bodies[b], saved.is_reset, background, directory,
                            state.bodies[b]);
  state.energies    = saved.energies;
  state.has_started = true;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template GatheredState<dim> gather(const State<dim> &, const DisplacementSpace<dim> &,      \
                                     const ContactPoints<dim> &, const bool, const bool);     \
  template void restore_fixed(const GatheredState<dim> &, const DisplacementSpace<dim> &,     \
                              const ContactPoints<dim> &, const std::string &, State<dim> &); \
  template void restore_moving(const GatheredState<dim> &, const dealii::BoundingBox<dim> &,  \
                               const MPI_Comm, const std::string &, State<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
