#include <scree/mechanics/resultant.h>
#include <scree/output/column_names.h>
#include <scree/output/long_tables.h>

#include <tuple>

namespace scree
{
namespace
{
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
LongTables<dim>::LongTables(const std::string &directory, const std::vector<Body<dim>> &bodies)
    : directory(directory)
    , bodies(bodies)
{
}

template <int dim>
std::vector<std::string>
LongTables<dim>::contact_columns() const
{
  std::vector<std::string> names = {"step", "time", "pair", "body_a", "body_b"};
  add_vector_names<dim>("force", names);
  add_axial_names<dim>("moment", names);
  for (const std::string name : {"minimum_gap", "max_penetration", "open", "stick", "slip", "area",
                                 "max_pressure", "open_points", "stick_points", "slip_points"})
    names.push_back(name);
  add_axial_names<dim>("moment_a", names);
  add_axial_names<dim>("moment_b", names);
  if (is_moving)
    add_vector_names<dim>("transfer", names);
  return names;
}

template <int dim>
std::vector<std::string>
LongTables<dim>::body_columns() const
{
  std::vector<std::string> names = {"step", "time", "body"};
  add_vector_names<dim>("position", names);
  add_vector_names<dim>("displacement", names);
  add_axial_names<dim>("rotation", names);
  add_vector_names<dim>("contact_force", names);
  add_axial_names<dim>("contact_moment", names);
  names.push_back("contacts");
  return names;
}

template <int dim>
dealii::Tensor<1, 3>
LongTables<dim>::moment_about(const MeanMotion<dim>     &motion,
                              const ContactSummary<dim> &summary) const
{
  return is_moving
           ? summary.moved_moment - moment_of<dim>(motion.position, summary.force)
           : summary.moment - moment_of<dim>(motion.position - motion.displacement, summary.force);
}

template <int dim>
void
LongTables<dim>::add_contact(const double step, const double time, const ContactPair &pair,
                             const ContactSummary<dim>  &summary,
                             const dealii::Tensor<1, 3> &moment_a,
                             const dealii::Tensor<1, 3> &moment_b)
{
  contact_rows.push_back({CsvTable::word(step), CsvTable::word(time), pair.name,
                          bodies[pair.a].name, bodies[pair.b].name});
  auto &row = contact_rows.back();
  add_vector<dim>(summary.force, row);
  add_axial<dim>(summary.moment, row);
  for (const double value :
       {summary.minimum_gap, summary.max_penetration, summary.open, summary.stick, summary.slip,
        summary.stick + summary.slip, summary.max_pressure, summary.open_points,
        summary.stick_points, summary.slip_points})
    row.push_back(CsvTable::word(value));
  add_axial<dim>(moment_a, row);
  add_axial<dim>(moment_b, row);
}

template <int dim>
void
LongTables<dim>::gather(const double step, const double time, const std::vector<ContactPair> &pairs,
                        const std::vector<ContactSummary<dim>> &summaries,
                        const std::vector<MeanMotion<dim>> &motions, const bool geometry_is_moving,
                        const bool writes)
{
  contact_rows.clear();
  body_rows.clear();
  pairs_of_rows.clear();
  has_pairs |= !pairs.empty();
  is_moving = geometry_is_moving;
  std::vector<Resultant<dim>> on_body(bodies.size());
  std::vector<unsigned int>   n_contacts(bodies.size());
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const auto &[a, b]      = std::tie(pairs[p].a, pairs[p].b);
      const auto &summary     = summaries[p];
      const bool  is_closed   = summary.stick_points + summary.slip_points > 0.;
      const auto  unique_pair = std::make_pair(a, b);
      if (is_closed)
        met.insert(unique_pair);
      if (!writes || met.count(unique_pair) == 0)
        continue;
      const dealii::Tensor<1, 3> moment_a = -moment_about(motions[a], summary),
                                 moment_b = moment_about(motions[b], summary);
      add_contact(step, time, pairs[p], summary, moment_a, moment_b);
      pairs_of_rows.push_back(unique_pair);
      on_body[a].force -= summary.force;
      on_body[b].force += summary.force;
      on_body[a].moment += moment_a;
      on_body[b].moment += moment_b;
      n_contacts[a] += is_closed;
      n_contacts[b] += is_closed;
    }
  for (unsigned int b = 0; b < bodies.size() && writes; ++b)
    {
      body_rows.push_back({CsvTable::word(step), CsvTable::word(time), bodies[b].name});
      auto &row = body_rows.back();
      add_vector<dim>(motions[b].position, row);
      add_vector<dim>(motions[b].displacement, row);
      add_axial<dim>(motions[b].rotation, row);
      add_vector<dim>(on_body[b].force, row);
      add_axial<dim>(on_body[b].moment, row);
      row.push_back(CsvTable::word(n_contacts[b]));
    }
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
void
LongTables<dim>::write()
{
  if (!body_table)
    body_table = std::make_unique<CsvTable>(directory + "/grains.csv", body_columns());
  if (!contact_table && has_pairs)
    contact_table = std::make_unique<CsvTable>(directory + "/contacts.csv", contact_columns());
  if (contact_table)
    contact_table->add_rows(contact_rows);
  body_table->add_rows(body_rows);
}

template <int dim>
bool
LongTables<dim>::flush()
{
  const bool contact_is_written = !contact_table || contact_table->flush();
  return (!body_table || body_table->flush()) && contact_is_written;
}

template <int dim>
LongTablesRecord
LongTables<dim>::record() const
{
  return {contact_table ? contact_table->n_rows() : 0, body_table ? body_table->n_rows() : 0, met};
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
  if (has_pairs)
    contact_table = std::make_unique<CsvTable>(directory + "/contacts.csv", contact_columns(),
                                               record.n_contact_rows);
}

template class LongTables<2>;
template class LongTables<3>;
} // namespace scree
