#include <scree/base/exceptions.h>
#include <scree/output/column_names.h>
#include <scree/output/results.h>

#include <set>

namespace scree
{
namespace
{
template <int dim>
std::vector<std::string>
pair_columns(const std::vector<ContactPair> &pairs)
{
  std::vector<std::string> names;
  for (const ContactPair &pair : pairs)
    {
      add_resultant_names<dim>(pair.name, names);
      for (const std::string column :
           {"minimum_gap", "max_penetration", "max_pressure", "open", "stick", "slip"})
        names.push_back(pair.name + "." + column);
    }
  return names;
}

/** Columns of pairs on a moving geometry: see MotionRecord::force_jumps. */
template <int dim>
std::vector<std::string>
transfer_columns(const std::vector<ContactPair> &pairs)
{
  std::vector<std::string> names;
  for (const ContactPair &pair : pairs)
    add_vector_names<dim>(pair.name + ".transfer", names);
  return names;
}
} // namespace

template <int dim>
const std::vector<ContactPair> &
Results<dim>::pairs_with_columns(const ContactPoints<dim> &contact) const
{
  static const std::vector<ContactPair> none;
  return pairs_change ? none : contact.pairs();
}

template <int dim>
std::set<std::string>
Results<dim>::left_out(const Equilibrium<dim> &equilibrium, const ContactPoints<dim> &contact) const
{
  const auto &pairs = pairs_with_columns(contact);
  if (pairs.size() <= most_pairs_in_history)
    return {};
  const auto            names = pair_columns<dim>(pairs);
  std::set<std::string> result(names.begin(), names.end());
  if (equilibrium.kinematics.moves_bodies())
    {
      const auto transfers = transfer_columns<dim>(pairs);
      result.insert(transfers.begin(), transfers.end());
    }
  return result;
}

template <int dim>
std::vector<std::string>
Results<dim>::state_columns(const Equilibrium<dim>   &equilibrium,
                            const ContactPoints<dim> &contact) const
{
  std::vector<std::string> names
    = {"time", "step", "newton_iterations", "attempts", "linear_iterations"};
  if (of_steps.stage)
    names.push_back("stage");
  if (of_steps.local_error)
    names.push_back("local_error");
  const auto of_pairs = pair_columns<dim>(pairs_with_columns(contact));
  names.insert(names.end(), of_pairs.begin(), of_pairs.end());
  for (const std::string &condition : equilibrium.condition_names())
    {
      add_vector_names<dim>(condition + ".displacement", names);
      add_resultant_names<dim>(condition, names);
    }
  for (const auto &body : bodies)
    if (body.is_rigid())
      add_rigid_names<dim>(body.name, names);
  const bool is_moving = equilibrium.kinematics.moves_bodies();
  for (const auto &body : bodies)
    if (!body.is_rigid())
      names.push_back(body.name + (is_moving ? ".start_volume" : ".volume"));
  for (const std::string energy : {"strain", "ghost_penalty", "boundary", "contact", "dissipation",
                                   "plastic", "external_work", "transfer", "balance_error"})
    names.push_back("energy." + energy);
  if (equilibrium.mass)
    {
      names.push_back("energy.kinetic");
      for (const auto &body : bodies)
        {
          add_vector_names<dim>(body.name + ".momentum", names);
          add_axial_names<dim>(body.name + ".angular_momentum", names);
        }
    }
  return names;
}

template <int dim>
std::vector<std::string>
Results<dim>::history_columns(const Equilibrium<dim>   &equilibrium,
                              const ContactPoints<dim> &contact) const
{
  std::vector<std::string> names = state_columns(equilibrium, contact);
  if (!equilibrium.kinematics.moves_bodies())
    return names;
  for (const auto &body : bodies)
    if (!body.is_rigid())
      for (const std::string column : {"volume", "point_volume", "mass", "points"})
        names.push_back(body.name + "." + column);
  const auto transfers = transfer_columns<dim>(pairs_with_columns(contact));
  names.insert(names.end(), transfers.begin(), transfers.end());
  names.push_back("islands");
  names.push_back("widened_transfers");
  return names;
}

template <int dim>
std::vector<std::string>
Results<dim>::quantities(const Equilibrium<dim>   &equilibrium,
                         const ContactPoints<dim> &contact) const
{
  std::vector<std::string> names = state_columns(equilibrium, contact);
  if (long_tables.is_assembly(pairs_change || !contact.pairs().empty()))
    {
      const auto of_assembly = Assembly<dim>::columns();
      names.insert(names.end(), of_assembly.begin(), of_assembly.end());
    }
  return names;
}

template <int dim>
std::vector<double>
Results<dim>::quantity_values() const
{
  std::vector<double> values      = history_row;
  const auto          of_assembly = long_tables.assembly_values();
  values.insert(values.end(), of_assembly.begin(), of_assembly.end());
  return values;
}

template <int dim>
std::vector<std::string>
Results<dim>::probe_columns() const
{
  std::vector<std::string> names;
  for (const auto &probe : probes)
    if (probe.n_points == 1)
      for (const std::string &column : sample_columns(probe))
        names.push_back(probe.name + "." + column);
  return names;
}

template <int dim>
std::vector<std::string>
Results<dim>::probe_table_columns() const
{
  std::vector<std::string> names = probe_columns();
  names.insert(names.begin(), "time");
  return names;
}

template <int dim>
std::vector<std::string>
Results<dim>::columns(const Equilibrium<dim> &equilibrium, const ContactPoints<dim> &contact) const
{
  std::vector<std::string>       names     = history_columns(equilibrium, contact);
  const std::vector<std::string> of_probes = probe_columns();
  names.insert(names.end(), of_probes.begin(), of_probes.end());
  return names;
}

template <int dim>
void
Results<dim>::require_distinct_columns(const Equilibrium<dim>   &equilibrium,
                                       const ContactPoints<dim> &contact) const
{
  std::set<std::string> seen;
  for (const std::string &name : columns(equilibrium, contact))
    require(seen.insert(name).second, "Bodies",
            "two columns of history.csv and probes.csv would be called '" + name + "'",
            "change the names of bodies, boundary conditions or probes: those of pairs, 'a-b', and "
            "of conditions, 'body.condition', must differ when they are joined");
}

#define SCREE_INSTANTIATE(dim)                                                                       \
  template const std::vector<ContactPair> &Results<dim>::pairs_with_columns(                         \
    const ContactPoints<dim> &) const;                                                               \
  template std::set<std::string>    Results<dim>::left_out(const Equilibrium<dim> &,                 \
                                                           const ContactPoints<dim> &) const;        \
  template std::vector<std::string> Results<dim>::state_columns(const Equilibrium<dim> &,            \
                                                                const ContactPoints<dim> &) const;   \
  template std::vector<std::string> Results<dim>::history_columns(                                   \
    const Equilibrium<dim> &, const ContactPoints<dim> &) const;                                     \
  template std::vector<std::string> Results<dim>::quantities(const Equilibrium<dim> &,               \
                                                             const ContactPoints<dim> &) const;      \
  template std::vector<double>      Results<dim>::quantity_values() const;                           \
  template std::vector<std::string> Results<dim>::probe_columns() const;                             \
  template std::vector<std::string> Results<dim>::probe_table_columns() const;                       \
  template std::vector<std::string> Results<dim>::columns(const Equilibrium<dim> &,                  \
                                                          const ContactPoints<dim> &) const;         \
  template void                     Results<dim>::require_distinct_columns(const Equilibrium<dim> &, \
                                                                           const ContactPoints<dim> &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
