#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/output/column_names.h>
#include <scree/output/point_output.h>
#include <scree/output/results.h>
#include <scree/output/vtu_files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <set>

namespace scree
{
namespace
{
/** The entries of a row whose columns are not left out. */
template <typename T>
std::vector<T>
kept(const std::vector<T> &row, const std::vector<std::string> &names,
     const std::set<std::string> &left_out)
{
  std::vector<T> result;
  for (unsigned int i = 0; i < row.size(); ++i)
    if (left_out.count(names[i]) == 0)
      result.push_back(row[i]);
  return result;
}

template <int dim>
void
add_resultant(const dealii::Tensor<1, dim> &force, const dealii::Tensor<1, 3> &moment,
              std::vector<double> &values)
{
  for (unsigned int d = 0; d < dim; ++d)
    values.push_back(force[d]);
  for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
    values.push_back(moment[d]);
}
} // namespace

template <int dim>
Results<dim>::Results(const std::string &directory, const std::vector<Body<dim>> &bodies,
                      const std::vector<ProbeParameters<dim>> &probes,
                      const FieldParameters &fields, const bool pairs_change,
                      const StepColumns &of_steps)
    : directory(directory)
    , bodies(bodies)
    , probes(probes)
    , fields(fields)
    , pairs_change(pairs_change)
    , of_steps(of_steps)
    , long_tables(directory, bodies, of_steps.stage)
{
  for (auto &probe : this->probes)
    probe.with_plastic_strain = may_flow(bodies[body_of_probe(probe, bodies)]);
}

template <int dim>
void
Results<dim>::set_discretization(const DisplacementSpace<dim> &new_space,
                                 const LevelSetNodes<dim>     &level_set_nodes)
{
  space = &new_space;
  nodes = &level_set_nodes;
  body_output.reset();
  is_first = dealii::Utilities::MPI::this_mpi_process(new_space.grid.communicator()) == 0;
}

template <int dim>
std::vector<double>
Results<dim>::last_values() const
{
  std::vector<double> values = history_row;
  values.insert(values.end(), probe_row.begin(), probe_row.end());
  return values;
}

template <int dim>
void
Results<dim>::gather_history(const StepRecord &record, const Equilibrium<dim> &equilibrium,
                             const ContactPoints<dim> &contact,
                             const CutQuadrature<dim> &quadrature, const Vector &u)
{
  const Kinematics<dim> &kinematics = equilibrium.kinematics;
  if (history_names.empty())
    {
      // They stay: pairs that come and go have no columns.
      history_names  = history_columns(equilibrium, contact);
      names_left_out = left_out(equilibrium, contact);
    }
  is_moving                   = kinematics.moves_bodies();
  const auto ghosted_u        = equilibrium.with_ghosts(u);
  const auto summaries        = summarise_contact(contact, space->grid.communicator(), is_moving);
  auto       motions          = mean_motions(*space, bodies, quadrature, kinematics, ghosted_u);
  std::vector<double> &values = history_row;
  values                      = {record.time, double(record.step), double(record.newton_iterations),
                                 double(record.attempts), double(record.linear_iterations)};
  if (of_steps.stage)
    values.push_back(record.stage);
  if (of_steps.local_error)
    values.push_back(record.local_error);
  for (unsigned int p = 0; p < pairs_with_columns(contact).size(); ++p)
    {
      const auto &summary = summaries[p];
      add_resultant<dim>(summary.force, summary.moment, values);
      for (const double value : {summary.minimum_gap, summary.max_penetration, summary.max_pressure,
                                 summary.open, summary.stick, summary.slip})
        values.push_back(value);
    }
  for (const auto &resultant : equilibrium.resultants(u))
    {
      for (unsigned int d = 0; d < dim; ++d)
        values.push_back(resultant.displacement[d]);
      add_resultant<dim>(resultant.force, resultant.moment, values);
    }
  for (const auto &state : equilibrium.rigid_states(ghosted_u))
    {
      const dealii::Point<dim> &reference = bodies[state.body].rigid->reference_point;
      motions[state.body] = {reference + state.displacement, state.displacement, state.rotation};
      add_resultant<dim>(state.displacement, state.rotation, values);
      add_resultant<dim>(state.force, state.moment, values);
    }
  const std::vector<double> volumes = kinematics.bulk().volumes();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      values.push_back(volumes[b]);
  const Energies &energies = equilibrium.energies();
  for (const double energy : {energies.strain, energies.ghost_penalty, energies.boundary,
                              energies.contact, energies.dissipation, energies.plastic,
                              energies.external_work, energies.transfer, energies.balance_error()})
    values.push_back(energy);
  if (equilibrium.mass)
    {
      values.push_back(energies.kinetic);
      values.insert(values.end(), record.momenta.begin(), record.momenta.end());
    }
  const auto grains = grain_states(bodies, contact.pairs(), summaries, motions,
                                   equilibrium.body_stresses(u), is_moving);
  chains            = ForceChains<dim>(bodies, contact.pairs(), summaries, grains);
  long_tables.gather(record, contact.pairs(), summaries, grains,
                     assembly_region(*space, *nodes, bodies, quadrature, ghosted_u), is_moving,
                     is_first);
}

template <int dim>
void
Results<dim>::gather_motion(const MotionRecord<dim> &motion)
{
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      for (const double value : {motion.volumes[b], motion.points[b].volume, motion.points[b].mass,
                                 double(motion.points[b].count)})
        history_row.push_back(value);
  for (const auto &[pair, jump] : motion.force_jumps)
    for (unsigned int d = 0; d < dim && !pairs_change; ++d)
      history_row.push_back(jump[d]);
  long_tables.add_transfers(motion.force_jumps);
  history_row.push_back(motion.n_islands);
  history_row.push_back(motion.transfer_report.widened + motion.transfer_report.lowered);
}

template <int dim>
void
Results<dim>::write_history()
{
  AssertThrow(history_row.size() == history_names.size(),
              dealii::ExcDimensionMismatch(history_row.size(), history_names.size()));
  // Only a pair without contact points has no gap.
  for (unsigned int i = 0; i < history_row.size(); ++i)
    require(std::isfinite(history_row[i])
              || boost::algorithm::ends_with(history_names[i], ".minimum_gap"),
            directory + "/history.csv",
            "after the step to time " + short_number(history_row[0]) + ", which converged, '"
              + history_names[i] + "' is no finite number",
            "check that moduli, penalties, loads and lengths are in consistent units, neither "
            "extremely large nor small");
  if (!is_first)
    return;
  if (!history)
    history = std::make_unique<CsvTable>(directory + "/history.csv",
                                         kept(history_names, history_names, names_left_out));
  history->add_row(kept(history_row, history_names, names_left_out));
  long_tables.write();
}

template <int dim>
bool
Results<dim>::write_fields(const StepRecord &record, const Kinematics<dim> &kinematics,
                           const Vector &ghosted_u, const VelocityField<dim> *velocities)
{
  if (!body_output)
    body_output = std::make_unique<BodyOutput<dim>>(*space, *nodes, bodies, fields);
  bool is_written = add_picture(
    record.time,
    body_output->write(kinematics, ghosted_u, velocities, directory, record.step, record.time),
    "bodies.pvd", body_records);
  if (is_first && long_tables.is_assembly() && record.step > 0)
    is_written &= add_picture(record.time, chains.write(directory, record.step, record.time),
                              "chains.pvd", chain_records);
  for (const auto &probe : probes)
    if (probe.n_points > 1)
      {
        const auto rows = sample_probe(probe, kinematics, ghosted_u);
        if (!is_first)
          continue;
        CsvTable table(directory + "/line_" + probe.name + "_"
                         + dealii::Utilities::int_to_string(record.step, 4) + ".csv",
                       sample_columns(probe));
        table.add_rows(rows);
        is_written &= table.flush();
      }
  return is_written;
}

template <int dim>
bool
Results<dim>::write_contact(const StepRecord &record, const ContactPoints<dim> &contact)
{
  const MPI_Comm communicator = space->grid.communicator();
  const bool     is_written   = write_contact_csv(contact, communicator, directory, record.step);
  return add_picture(
           record.time,
           write_contact_vtu(contact, fields, communicator, directory, record.step, record.time),
           "contact.pvd", contact_records)
         && is_written;
}

template <int dim>
bool
Results<dim>::write_points(const StepRecord &record, const MaterialPoints<dim> &points,
                           const bool has_inertia)
{
  return add_picture(record.time,
                     write_points_vtu(points, bodies, fields, has_inertia,
                                      space->grid.communicator(), directory, record.step,
                                      record.time),
                     "points.pvd", point_records);
}

template <int dim>
std::vector<std::vector<double>>
Results<dim>::sample_probe(const ProbeParameters<dim> &probe, const Kinematics<dim> &kinematics,
                           const Vector &ghosted_u) const
{
  return sample(probe, body_of_probe(probe, bodies), *space, kinematics.bulk(), ghosted_u,
                !kinematics.moves_bodies());
}

template <int dim>
void
Results<dim>::require_probes(const Kinematics<dim> &kinematics, const Vector &ghosted_u) const
{
  for (const auto &probe : probes)
    sample(probe, body_of_probe(probe, bodies), *space, kinematics.bulk(), ghosted_u, true);
}

template <int dim>
void
Results<dim>::write_probes(const StepRecord &record, const Kinematics<dim> &kinematics,
                           const Vector &ghosted_u)
{
  probe_row.clear();
  for (const auto &probe : probes)
    if (probe.n_points == 1)
      {
        const auto row = sample_probe(probe, kinematics, ghosted_u).front();
        probe_row.insert(probe_row.end(), row.begin(), row.end());
      }
  if (!is_first || probe_row.empty())
    return;
  if (!probe_table)
    probe_table = std::make_unique<CsvTable>(directory + "/probes.csv", probe_table_columns());
  std::vector<double> values = probe_row;
  values.insert(values.begin(), record.time);
  probe_table->add_row(values);
}

template <int dim>
bool
Results<dim>::flush()
{
  const bool history_is_written = !history || history->flush();
  const bool probes_are_written = !probe_table || probe_table->flush();
  return long_tables.flush() && probes_are_written && history_is_written;
}

template <int dim>
ResultsRecord
Results<dim>::record() const
{
  return {body_records,
          contact_records,
          point_records,
          chain_records,
          history ? history->n_rows() : 0,
          probe_table ? probe_table->n_rows() : 0,
          long_tables.record()};
}

template <int dim>
void
Results<dim>::resume(const ResultsRecord &record, const Equilibrium<dim> &equilibrium,
                     const ContactPoints<dim> &contact)
{
  body_records    = record.bodies;
  contact_records = record.contact;
  point_records   = record.points;
  chain_records   = record.chains;
  if (!is_first)
    return;
  const auto names = history_columns(equilibrium, contact);
  history          = std::make_unique<CsvTable>(directory + "/history.csv",
                                       kept(names, names, left_out(equilibrium, contact)),
                                       record.n_history_rows);
  long_tables.resume(record.long_tables, equilibrium.kinematics.moves_bodies(),
                     pairs_change || !contact.pairs().empty());
  if (record.n_probe_rows > 0)
    probe_table = std::make_unique<CsvTable>(directory + "/probes.csv", probe_table_columns(),
                                             record.n_probe_rows);
  if (!body_records.empty())
    write_pvd("bodies.pvd", body_records);
  if (!contact_records.empty())
    write_pvd("contact.pvd", contact_records);
  if (!point_records.empty())
    write_pvd("points.pvd", point_records);
  if (!chain_records.empty())
    write_pvd("chains.pvd", chain_records);
}

template <int dim>
bool
Results<dim>::add_picture(const double time, const std::string &file, const std::string &pvd,
                          std::vector<std::pair<double, std::string>> &records) const
{
  if (file.empty())
    return false;
  records.emplace_back(time, file);
  return write_pvd(pvd, records);
}

template <int dim>
bool
Results<dim>::write_pvd(const std::string                                 &name,
                        const std::vector<std::pair<double, std::string>> &records) const
{
  return !is_first || write_file(directory + "/" + name, [&](std::ofstream &file) {
    dealii::DataOutBase::write_pvd_record(file, records);
  });
}

template class Results<2>;
template class Results<3>;
} // namespace scree
