#include <scree/output/column_names.h>
#include <scree/output/long_tables.h>

#include <algorithm>

namespace scree
{
namespace
{
std::vector<std::string>
word_row(const std::vector<double> &values)
{
  std::vector<std::string> result;
  result.reserve(values.size());
  for (const double value : values)
    result.push_back(CsvTable::word(value));
  return result;
}

template <int dim>
void
add_vector(const dealii::Tensor<1, dim> &vector, std::vector<std::string> &row)
{
  for (unsigned int d = 0; d < dim; ++d)
    row.push_back(CsvTable::word(vector[d]));
}

template <int dim>
void
add_axial(const dealii::Tensor<1, 3> &vector, std::vector<std::string> &row)
{
  for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
    row.push_back(CsvTable::word(vector[d]));
}
} // namespace

template <int dim>
LongTables<dim>::LongTables(const std::string &directory, const std::vector<Body<dim>> &bodies,
                            const bool has_stages)
    : directory(directory)
    , bodies(bodies)
    , has_stages(has_stages)
{
}

template <int dim>
std::vector<std::string>
LongTables<dim>::step_columns() const
{
  std::vector<std::string> names = {"step", "time"};
  if (has_stages)
    names.push_back("stage");
  return names;
}

template <int dim>
std::vector<double>
LongTables<dim>::step_values(const StepRecord &record) const
{
  std::vector<double> values = {double(record.step), record.time};
  if (has_stages)
    values.push_back(record.stage);
  return values;
}

template <int dim>
std::vector<std::string>
LongTables<dim>::contact_columns() const
{
  std::vector<std::string> names = step_columns();
  names.insert(names.end(), {"pair", "body_a", "body_b"});
  add_vector_names<dim>("force", names);
  add_axial_names<dim>("moment", names);
  for (const std::string name : {"minimum_gap", "max_penetration", "open", "stick", "slip", "area",
                                 "max_pressure", "open_points", "stick_points", "slip_points"})
    names.push_back(name);
  add_axial_names<dim>("moment_a", names);
  add_axial_names<dim>("moment_b", names);
  add_vector_names<dim>("place", names);
  add_vector_names<dim>("normal", names);
  names.push_back("normal_force");
  names.push_back("tangential_force");
  add_vector_names<dim>("branch", names);
  if (is_moving)
    add_vector_names<dim>("transfer", names);
  return names;
}

template <int dim>
std::vector<std::string>
LongTables<dim>::body_columns() const
{
  std::vector<std::string> names = step_columns();
  names.push_back("body");
  add_vector_names<dim>("position", names);
  add_vector_names<dim>("displacement", names);
  add_axial_names<dim>("rotation", names);
  add_vector_names<dim>("contact_force", names);
  add_axial_names<dim>("contact_moment", names);
  names.push_back("contacts");
  names.push_back("volume");
  add_symmetric_names<dim>("stress", names);
  add_symmetric_names<dim>("force_stress", names);
  names.push_back("pressure");
  return names;
}

template <int dim>
std::vector<std::string>
LongTables<dim>::assembly_columns() const
{
  std::vector<std::string> names = step_columns(), of_assembly = Assembly<dim>::columns();
  names.insert(names.end(), of_assembly.begin(), of_assembly.end());
  return names;
}

template <int dim>
void
LongTables<dim>::add_contact(const StepRecord &record, const ContactPair &pair,
                             const ContactSummary<dim>          &summary,
                             const std::vector<GrainState<dim>> &grains)
{
  auto &row = contact_rows.emplace_back(word_row(step_values(record)));
  row.insert(row.end(), {pair.name, bodies[pair.a].name, bodies[pair.b].name});
  add_vector<dim>(summary.force, row);
  add_axial<dim>(summary.moment, row);
  for (const double value :
       {summary.minimum_gap, summary.max_penetration, summary.open, summary.stick, summary.slip,
        summary.stick + summary.slip, summary.max_pressure, summary.open_points,
        summary.stick_points, summary.slip_points})
    row.push_back(CsvTable::word(value));
  for (const dealii::Tensor<1, 3> &moment : contact_moments(pair, summary, grains))
    add_axial<dim>(moment, row);
  add_vector<dim>(summary.place(), row);
  add_vector<dim>(summary.normal(), row);
  row.push_back(CsvTable::word(summary.normal_force()));
  row.push_back(CsvTable::word(summary.tangential_force()));
  add_vector<dim>(branch_vector(bodies, pair, summary, grains), row);
}

template <int dim>
void
LongTables<dim>::add_body(const StepRecord &record, const std::string &name,
                          const GrainState<dim> &state)
{
  auto &row = body_rows.emplace_back(word_row(step_values(record)));
  row.push_back(name);
  add_vector<dim>(state.motion.position, row);
  add_vector<dim>(state.motion.displacement, row);
  add_axial<dim>(state.motion.rotation, row);
  add_vector<dim>(state.contact.force, row);
  add_axial<dim>(state.contact.moment, row);
  std::vector<double> values = {double(state.n_contacts), state.volume};
  add_symmetric(state.stress, values);
  add_symmetric(state.force_stress, values);
  values.push_back(-trace(state.force_stress) / dim);
  for (const double value : values)
    row.push_back(CsvTable::word(value));
}

template <int dim>
void
LongTables<dim>::gather(const StepRecord &record, const std::vector<ContactPair> &pairs,
                        const std::vector<ContactSummary<dim>> &summaries,
                        const std::vector<GrainState<dim>>     &grains,
                        const AssemblyRegion<dim> &region, const bool geometry_is_moving,
                        const bool writes)
{
  contact_rows.clear();
  body_rows.clear();
  pairs_of_rows.clear();
  has_pairs |= !pairs.empty();
  is_moving = geometry_is_moving;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const auto unique_pair = std::make_pair(pairs[p].a, pairs[p].b);
      if (summaries[p].is_closed())
        met.insert(unique_pair);
      if (!writes || met.count(unique_pair) == 0)
        continue;
      add_contact(record, pairs[p], summaries[p], grains);
      pairs_of_rows.push_back(unique_pair);
    }
  if (!writes)
    return;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    add_body(record, bodies[b].name, grains[b]);
  assembly_row           = step_values(record);
  const auto of_assembly = Assembly<dim>(region, bodies, pairs, summaries, grains).values();
  assembly_row.insert(assembly_row.end(), of_assembly.begin(), of_assembly.end());
}

template <int dim>
void
LongTables<dim>::add_transfers(
  const std::map<std::pair<unsigned int, unsigned int>, dealii::Tensor<1, dim>> &force_jumps)
{
  for (unsigned int i = 0; i < contact_rows.size(); ++i)
    {
      const auto jump = force_jumps.find(pairs_of_rows[i]);
      add_vector<dim>(jump == force_jumps.end() ? dealii::Tensor<1, dim>() : jump->second,
                      contact_rows[i]);
    }
}

template <int dim>
bool
LongTables<dim>::is_assembly(const bool there_are_pairs) const
{
  return there_are_pairs && std::count_if(bodies.begin(), bodies.end(), [](const Body<dim> &body) {
                              return !body.is_rigid();
                            }) > 1;
}

template <int dim>
std::vector<double>
LongTables<dim>::assembly_values() const
{
  const std::size_t n = assembly_row.empty() ? 0 : step_columns().size();
  return {assembly_row.begin() + n, assembly_row.end()};
}

template <int dim>
void
LongTables<dim>::write()
{
  if (!body_table)
    body_table = std::make_unique<CsvTable>(directory + "/grains.csv", body_columns());
  if (!contact_table && has_pairs)
    contact_table = std::make_unique<CsvTable>(directory + "/contacts.csv", contact_columns());
  if (!assembly_table && is_assembly())
    assembly_table = std::make_unique<CsvTable>(directory + "/assembly.csv", assembly_columns());
  if (contact_table)
    contact_table->add_rows(contact_rows);
  if (assembly_table)
    assembly_table->add_row(assembly_row);
  body_table->add_rows(body_rows);
}

template <int dim>
bool
LongTables<dim>::flush()
{
  const auto is_written
    = [](const std::unique_ptr<CsvTable> &table) { return !table || table->flush(); };
  const bool contact_is_written = is_written(contact_table),
             body_is_written    = is_written(body_table);
  return is_written(assembly_table) && body_is_written && contact_is_written;
}

template <int dim>
LongTablesRecord
LongTables<dim>::record() const
{
  const auto n_rows
    = [](const std::unique_ptr<CsvTable> &table) { return table ? table->n_rows() : 0; };
  return {n_rows(contact_table), n_rows(body_table), n_rows(assembly_table), met};
}

template <int dim>
void
LongTables<dim>::resume(const LongTablesRecord &record, const bool geometry_is_moving,
                        const bool contact_has_pairs)
{
  is_moving = geometry_is_moving;
  has_pairs = contact_has_pairs;
  met       = record.met;
  body_table
    = std::make_unique<CsvTable>(directory + "/grains.csv", body_columns(), record.n_body_rows);
  if (!has_pairs)
    return;
  contact_table = std::make_unique<CsvTable>(directory + "/contacts.csv", contact_columns(),
                                             record.n_contact_rows);
  if (is_assembly())
    assembly_table = std::make_unique<CsvTable>(directory + "/assembly.csv", assembly_columns(),
                                                record.n_assembly_rows);
}

template class LongTables<2>;
template class LongTables<3>;
} // namespace scree
