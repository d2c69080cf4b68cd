#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/base/interruption.h>
#include <scree/bodies/rigid_placement.h>
#include <scree/state/gather.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// How a run is saved and goes on.
#include <functional>
#include <numeric>

namespace scree
{
namespace
{
/** Places closer than this part of the finest cell are the same. */
constexpr double resolution = 1e-9;

/** Calls f(body, position, first unknown) for the own nodes; those of several cells repeatedly. */
template <int dim, typename F>
void
for_each_node(const Fields<dim> &fields, const F &f)
{
  for (unsigned int a = 0; a < fields.n_owned_cells(); ++a)
    {
      const ActiveCell &cell     = fields.cells()[a];
      const auto       &geometry = fields.grid.cells()[cell.grid_cell];
      for (unsigned int i = 0; i < fields.basis.n_nodes; ++i)
        if (fields.owned().is_element(fields.nodes(a)[i]))
          f(cell.body,
            geometry.lower + geometry.size * dealii::Tensor<1, dim>(fields.basis.node(i)),
            fields.nodes(a)[i]);
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

/** That points belong to bodies, are near the grid and no larger than it: else they would be
 * searched for in vain, or divided without end. */
template <int dim>
void
require_sound(const MaterialPoints<dim> &points, const std::size_t n_bodies,
              const dealii::BoundingBox<dim> &box, const std::string &directory)
{
  const auto [lower, upper] = box.get_boundary_points();
  const double reach        = lower.distance(upper);
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points.body[i] < n_bodies && points.position[i].distance(box.center()) < reach
              && points.spacing(i) < reach,
            directory, "the checkpoint has material points outside of bodies and grid",
            "start the run anew");
}
} // namespace

template <int dim>
void
Simulation<dim>::save_if_due()
{
  const auto &output     = parameters.output;
  const bool  is_written = results->flush();
  if (!is_written)
    log.line("Warning: rows of history.csv or other tables cannot be written (is the disk full?). "
             "They are kept and tried again after the next step; no checkpoint is written "
             "meanwhile, the last one remains");
  const bool by_steps
    = output.checkpoint_every > 0
      && (step_control.n_accepted() % output.checkpoint_every == 0 || step_control.finished());
  const bool by_time = output.checkpoint_minutes > 0.
                       && (since_checkpoint.wall_time() > 60. * output.checkpoint_minutes
                           || step_control.finished());
  // The first process, which has the clock and writes the tables, decides.
  if (!dealii::Utilities::MPI::broadcast(communicator, is_written && (by_steps || by_time)))
    return;
  save();
}

template <int dim>
void
Simulation<dim>::end_if_interrupted()
{
  const int signal = dealii::Utilities::MPI::max(Interruption::signal(), communicator);
  if (signal == 0)
    return;
  const bool        may_resume = parameters.study.n_cycles <= 1;
  const std::string by         = "interrupted by " + signal_name(signal) + " ";
  const std::string after      = step_control.n_accepted() == 0
                                   ? "in the first load step"
                                   : "after step " + std::to_string(step_control.n_accepted());
  std::string       remedy;
  if (may_resume && step_control.n_accepted() > 0)
    {
      if (dealii::Utilities::MPI::broadcast(communicator, results->flush()))
        save();
      remedy = "go on with scree --resume " + directory;
    }
  else
    remedy = "start it anew: there is no checkpoint";
  log.line("The run was " + by + after + "; " + remedy);
  throw Interrupted{signal, by + after + "\n  remedy: " + remedy};
}

template <int dim>
void
Simulation<dim>::save()
{
  const Timings::Scope  scope(timings, "checkpoint");
  const Checkpoint<dim> checkpoint = collect();
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    try
      {
        checkpoint_bytes = checkpoint.write(directory);
        ++n_checkpoints;
      }
    catch (const UserError &error)
      {
        log.line(std::string("Warning: ") + error.what());
      }
  since_checkpoint.restart();
}

template <int dim>
Checkpoint<dim>
Simulation<dim>::collect() const
{
  Checkpoint<dim> result;
  result.program           = std::string(SCREE_VERSION) + " (commit " + SCREE_REVISION + ")";
  result.parameters        = parameters.resolved;
  result.steps             = step_control.record();
  result.results           = results->record();
  result.warned_pairs      = warned_pairs;
  result.is_second_attempt = is_second_attempt;
  if (is_moving())
    {
      std::vector<double> points;
      points.reserve(state.points.size() * state.points.n_values());
      for (std::size_t i = 0; i < state.points.size(); ++i)
        state.points.pack(i, points);
      result.moving.points   = gather_arrays(points, communicator);
      result.moving.step_end = state.step_end;
      result.moving.step_end.driving.of_points
        = gather_joined(state.step_end.driving.of_points, communicator);
      result.moving.predictor = predictor;
      for (const Body<dim> &body : bodies)
        {
          result.moving.bodies.emplace_back();
          BodyPlace<dim> &place = result.moving.bodies.back();
          place.pose            = body.pose.unknowns();
          if (body.is_rigid())
            continue;
          place.lower        = body.level_set.lower();
          place.n_nodes      = body.level_set.n_nodes();
          place.level_set    = body.level_set.values();
          place.box          = body.box;
          place.displacement = body.displacement;
        }
    }
  else
    result.fixed = collect_fixed();
  return result;
}

template <int dim>
FixedState<dim>
Simulation<dim>::collect_fixed() const
{
  FixedState<dim> result;
  const double    length     = resolution * grid->finest_size();
  const auto     &origin     = parameters.grid.lower;
  const auto     &contacts   = contact->points();
  const auto     &increments = last_increment;
  result.energies            = equilibrium->energies();
  result.nodes               = PlacedValues<dim>(2 * dim, origin, length);
  for_each_node(*fields,
                [&](const unsigned int body, const dealii::Point<dim> &x, const DofIndex first) {
                  std::vector<double> row;
                  for (const auto *vector : {&state.displacement, &increments})
                    for (unsigned int d = 0; d < dim; ++d)
                      row.push_back((*vector)(first + d));
                  result.nodes.add(body, x, row);
                });
  result.nodes.gather(communicator);

  result.contact = PlacedValues<dim>(2 * dim + 2, origin, length);
  for (unsigned int i = 0; i < contacts.size(); ++i)
    {
      const auto         &tau = state.contact.tau[i], &jump = state.contact.jump[i];
      std::vector<double> row(tau.begin_raw(), tau.end_raw());
      row.insert(row.end(), jump.begin_raw(), jump.end_raw());
      row.insert(row.end(), {state.contact.pressure[i], double(was_closed[i])});
      result.contact.add(contacts[i].pair, contacts[i].position, row);
    }
  result.contact.gather(communicator);

  result.trailing.resize(2 * fields->n_trailing());
  for (unsigned int i = 0; i < fields->n_trailing(); ++i)
    {
      const DofIndex unknown = fields->n_dofs() - fields->n_trailing() + i;
      if (!fields->owned().is_element(unknown))
        continue;
      result.trailing[2 * i]     = state.displacement(unknown);
      result.trailing[2 * i + 1] = increments(unknown);
    }
  dealii::Utilities::MPI::sum(result.trailing, communicator, result.trailing);
  return result;
}

template <int dim>
void
Simulation<dim>::resume(const Checkpoint<dim> &checkpoint)
{
  step_control.resume(checkpoint.steps);
  state.time          = step_control.time();
  warned_pairs        = checkpoint.warned_pairs;
  is_second_attempt   = checkpoint.is_second_attempt;
  fraction_at_restart = state.time / parameters.time.end_time;
  if (is_moving())
    resume_moving(checkpoint.moving);
  else
    resume_fixed(checkpoint.fixed);
  results->resume(checkpoint.results, *equilibrium, *contact);
  if (!checkpoint.warning.empty())
    log.line("Warning: " + checkpoint.warning);
  log.line("Resumed after step " + std::to_string(step_control.n_accepted()) + ", time "
           + short_number(state.time) + "; the checkpoint is of scree " + checkpoint.program);
  if (step_control.finished())
    log.line("The run had reached its end time; to go on beyond it, set Time/End time and "
             "Time/Steps");
}

template <int dim>
void
Simulation<dim>::resume_moving(const MovingState<dim> &saved)
{
  const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int n_here = dealii::Utilities::MPI::n_mpi_processes(communicator);
  // In the order of the processes that had them, now for those that are there.
  state.points = MaterialPoints<dim>(state.points.n_internal());
  require_consistent(saved.bodies.size() == bodies.size(), directory);
  for (const auto &points : saved.points)
    require_consistent(points.size() % state.points.n_values() == 0, directory);
  for (unsigned int p = 0; p < saved.points.size(); ++p)
    if (p * n_here / saved.points.size() == rank)
      for (std::size_t i = 0; i < saved.points[p].size(); i += state.points.n_values())
        state.points.unpack(&saved.points[p][i]);
  require_sound(state.points, bodies.size(), grid->box(), directory);
  state.step_end = saved.step_end;
  if (rank > 0)
    state.step_end.driving.of_points.clear();
  predictor = saved.predictor;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const BodyPlace<dim> &place = saved.bodies[b];
      if (bodies[b].is_rigid())
        {
          place_rigid_body(bodies[b], place.pose, lattice_frame(), lattice_margin());
          continue;
        }
      require_consistent(place.level_set.size()
                           == std::accumulate(place.n_nodes.begin(), place.n_nodes.end(),
                                              std::size_t(1), std::multiplies<std::size_t>()),
                         directory);
      bodies[b].level_set = Lattice<dim>(bodies[b].level_set.frame(), place.lower, place.n_nodes);
      bodies[b].level_set.values() = place.level_set;
      bodies[b].box                = place.box;
      bodies[b].displacement       = place.displacement;
      if (parameters.moving.motion != IncrementMotion::reference_map)
        bodies[b].shape = nullptr;
    }
  try
    {
      discretise();
    }
  catch (const dealii::ExceptionBase &error)
    {
      throw UserError(directory,
                      std::string("the grid of the checkpoint does not fit its bodies and points: ")
                        + error.what(),
                      "start the run anew");
    }
  results->set_discretization(*fields, *level_set_nodes);
  start_step();
  require_no_loss(state.points.totals(bodies.size(), communicator));
}

template <int dim>
void
Simulation<dim>::resume_fixed(const FixedState<dim> &saved)
{
  require_consistent(saved.trailing.size() == 2 * fields->n_trailing(), directory);
  last_increment = state.displacement;
  for_each_node(*fields,
                [&](const unsigned int body, const dealii::Point<dim> &x, const DofIndex first) {
                  const double *row = row_of(saved.nodes, body, x, directory);
                  for (auto *vector : {&state.displacement, &last_increment})
                    for (unsigned int d = 0; d < dim; ++d)
                      (*vector)(first + d) = *row++;
                });
  for (unsigned int i = 0; i < fields->n_trailing(); ++i)
    {
      const DofIndex unknown = fields->n_dofs() - fields->n_trailing() + i;
      if (!fields->owned().is_element(unknown))
        continue;
      state.displacement(unknown) = saved.trailing[2 * i];
      last_increment(unknown)     = saved.trailing[2 * i + 1];
    }
  state.displacement.compress(dealii::VectorOperation::insert);
  last_increment.compress(dealii::VectorOperation::insert);

  for (unsigned int i = 0; i < contact->points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact->points()[i];
      const double            *row   = row_of(saved.contact, point.pair, point.position, directory);
      std::copy_n(row, dim, state.contact.tau[i].begin_raw());
      std::copy_n(row + dim, dim, state.contact.jump[i].begin_raw());
      state.contact.pressure[i] = row[2 * dim];
      was_closed[i]             = row[2 * dim + 1] != 0.;
    }
  equilibrium->resume(state.time, state.displacement, state.contact, saved.energies);
}

#define SCREE_INSTANTIATE(dim)                                                       \
  template void            Simulation<dim>::save_if_due();                           \
  template void            Simulation<dim>::save();                                  \
  template void            Simulation<dim>::end_if_interrupted();                    \
  template Checkpoint<dim> Simulation<dim>::collect() const;                         \
  template FixedState<dim> Simulation<dim>::collect_fixed() const;                   \
  template void            Simulation<dim>::resume(const Checkpoint<dim> &);         \
  template void            Simulation<dim>::resume_moving(const MovingState<dim> &); \
  template void            Simulation<dim>::resume_fixed(const FixedState<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
