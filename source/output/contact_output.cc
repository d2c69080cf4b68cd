#include <scree/mechanics/boundary_terms.h>
#include <scree/output/column_names.h>
#include <scree/output/contact_output.h>
#include <scree/output/csv_table.h>
#include <scree/output/patch_output.h>
#include <scree/output/vtu_files.h>
#include <scree/state/gather.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace scree
{
namespace
{
/** Status for output: a point without pressure is open. */
template <int dim>
ContactStatus
shown_status(const ContactResponse<dim> &response)
{
  return response.pressure == 0. && response.tau.norm_square() == 0. ? ContactStatus::open
                                                                     : response.status;
}

/** Mean pressures p, tangential tractions of the points of a pair in a cell, at each of them. */
template <int dim>
class CellMeans
{
public:
  explicit CellMeans(const ContactPoints<dim> &contact)
      : contact(contact)
  {
    for (unsigned int i = 0; i < contact.points().size(); ++i)
      {
        const auto &point    = contact.points()[i];
        const auto &response = contact.responses()[i];
        if (point.cell == dealii::numbers::invalid_unsigned_int)
          continue;
        Sum &sum = sums[{point.pair, point.cell}];
        sum.weight += point.weight;
        sum.pressure += point.weight * response.pressure;
        sum.tau += point.weight * response.tau;
      }
  }

  /** Pressure and tangential traction; those of the point itself where it is of no cell. */
  std::pair<double, dealii::Tensor<1, dim>> at(const unsigned int i) const
  {
    const auto &point = contact.points()[i];
    const auto  sum   = sums.find({point.pair, point.cell});
    if (sum == sums.end())
      return {contact.responses()[i].pressure, contact.responses()[i].tau};
    const double weight = sum->second.weight;
    return {sum->second.pressure / weight, sum->second.tau / weight};
  }

private:
  struct Sum
  {
    double                 weight = 0., pressure = 0.;
    dealii::Tensor<1, dim> tau = {};
  };

  const ContactPoints<dim>                            &contact;
  std::map<std::pair<unsigned int, unsigned int>, Sum> sums;
};

template <int dim>
ContactRow<dim>
columns(const ContactPoints<dim> &contact, const CellMeans<dim> &means, const unsigned int i)
{
  const auto     &point    = contact.points()[i];
  const auto     &response = contact.responses()[i];
  ContactRow<dim> values;
  auto            next   = values.begin();
  const auto      append = [&](const dealii::Tensor<1, dim> &vector) {
    next = std::copy(vector.begin_raw(), vector.end_raw(), next);
  };
  *next++ = point.pair;
  append(point.position);
  append(point.normal);
  *next++ = point.weight;
  *next++ = contact.gap(i);
  *next++ = response.pressure;
  append(response.tau);
  append(contact.jumps()[i]);
  *next++                    = static_cast<unsigned int>(shown_status(response));
  const auto [pressure, tau] = means.at(i);
  *next++                    = pressure;
  append(tau);
  return values;
}
} // namespace

template <int dim>
std::vector<std::string>
contact_columns()
{
  std::vector<std::string> names = {"pair"};
  for (const std::string prefix : {"", "normal_"})
    for (unsigned int d = 0; d < dim; ++d)
      names.push_back(prefix + axes[d]);
  for (const std::string name : {"weight", "gap", "pressure"})
    names.push_back(name);
  for (const std::string prefix : {"tau_", "jump_"})
    for (unsigned int d = 0; d < dim; ++d)
      names.push_back(prefix + axes[d]);
  names.push_back("status");
  names.push_back("cell_pressure");
  add_vector_names<dim>("cell_tau", names);
  return names;
}

template <int dim>
std::vector<ContactRow<dim>>
contact_rows(const ContactPoints<dim> &contact)
{
  const CellMeans<dim>         means(contact);
  std::vector<ContactRow<dim>> rows;
  rows.reserve(contact.points().size());
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    rows.push_back(columns(contact, means, i));
  return rows;
}

template <int dim>
void
ContactSummary<dim>::merge(const ContactSummary &other)
{
  force += other.force;
  moment += other.moment;
  virial_a += other.virial_a;
  virial_b += other.virial_b;
  strength += other.strength;
  placed += other.placed;
  directed += other.directed;
  open += other.open;
  stick += other.stick;
  slip += other.slip;
  open_points += other.open_points;
  stick_points += other.stick_points;
  slip_points += other.slip_points;
  max_pressure = std::max(max_pressure, other.max_pressure);
  if (other.minimum_gap < minimum_gap)
    {
      minimum_gap = other.minimum_gap;
      where       = other.where;
    }
}

namespace
{
/** Adds where the force of a point acts. */
template <int dim>
void
add_place(const ContactPoints<dim> &contact, const unsigned int i,
          const dealii::Tensor<1, dim> &force, const bool geometry_is_moving,
          ContactSummary<dim> &summary)
{
  const auto            &point = contact.points()[i];
  dealii::Tensor<1, dim> mean, half_jump;
  if (geometry_is_moving)
    {
      mean      = contact.mean_displacements()[i];
      half_jump = 0.5 * contact.jumps()[i];
    }
  const auto add = [&](const dealii::Tensor<1, dim> &place, dealii::Tensor<2, dim> &virial) {
    virial += outer_product(force, place);
  };
  add(point.feet[0] + (mean - half_jump), summary.virial_a);
  add(point.feet[1] + (mean + half_jump), summary.virial_b);
  const double strength = force.norm();
  summary.strength += strength;
  summary.placed += strength * (point.position + mean);
  summary.directed += strength * point.normal;
}
} // namespace

template <int dim>
std::vector<ContactSummary<dim>>
summarise_contact(const ContactPoints<dim> &contact, const MPI_Comm communicator,
                  const bool geometry_is_moving)
{
  using Table         = std::vector<ContactSummary<dim>>;
  constexpr auto none = std::numeric_limits<double>::max();
  Table          own(contact.pairs().size());
  for (auto &summary : own)
    summary.minimum_gap = none;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto                  &point    = contact.points()[i];
      const auto                  &response = contact.responses()[i];
      ContactSummary<dim>         &summary  = own[point.pair];
      const dealii::Tensor<1, dim> force    = point.weight * response.traction(point.normal);
      summary.force += force;
      summary.moment += moment_of<dim>(point.position, force);
      add_place(contact, i, force, geometry_is_moving, summary);
      // Slivers of the surface carry nothing and would decide which extremes are sampled.
      if (point.weight > 1e-3 * std::pow(point.cell_size, dim - 1))
        {
          summary.max_pressure = std::max(summary.max_pressure, response.pressure);
          if (contact.gap(i) < summary.minimum_gap)
            {
              summary.minimum_gap = contact.gap(i);
              summary.where       = point.position;
            }
        }
      const ContactStatus status = shown_status(response);
      (status == ContactStatus::open    ? summary.open
       : status == ContactStatus::stick ? summary.stick
                                        : summary.slip)
        += point.weight;
      (status == ContactStatus::open    ? summary.open_points
       : status == ContactStatus::stick ? summary.stick_points
                                        : summary.slip_points)
        += 1.;
    }
  auto result = dealii::Utilities::MPI::all_reduce<Table>(
    own, communicator, [](const Table &a, const Table &b) {
      Table both(a);
      for (unsigned int p = 0; p < both.size(); ++p)
        both[p].merge(b[p]);
      return both;
    });
  for (auto &summary : result)
    {
      if (summary.minimum_gap == none)
        summary.minimum_gap = std::numeric_limits<double>::quiet_NaN();
      summary.max_penetration = std::max(0., -summary.minimum_gap);
    }
  return result;
}

template <int dim>
bool
write_contact_csv(const ContactPoints<dim> &contact, const MPI_Comm communicator,
                  const std::string &directory, const unsigned int number)
{
  auto rows = gather_joined(contact_rows(contact), communicator);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
    return true;
  std::sort(rows.begin(), rows.end());
  const std::string name = directory + "/contact_" + dealii::Utilities::int_to_string(number, 4);
  return write_file(name + ".csv", [&](std::ofstream &file) {
    const auto names = contact_columns<dim>();
    for (unsigned int c = 0; c < names.size(); ++c)
      file << (c == 0 ? "" : ",") << names[c];
    file << '\n';
    std::string line;
    for (const auto &row : rows)
      {
        line = contact.pairs()[static_cast<unsigned int>(row[0])].name;
        for (unsigned int c = 1; c < row.size(); ++c)
          (line += ',') += CsvTable::word(row[c]);
        file << (line += '\n');
      }
  });
}

template <int dim>
std::string
write_contact_vtu(const ContactPoints<dim> &contact, const FieldParameters &parameters,
                  const MPI_Comm communicator, const std::string &directory,
                  const unsigned int number, const double time)
{
  auto names = contact_columns<dim>();
  // Position comes with the vertex.
  names.erase(names.begin() + 1, names.begin() + 1 + dim);
  PointPatches<dim>   output(names);
  const auto          rows = contact_rows(contact);
  std::vector<double> values;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      values.assign(rows[i].begin() + dim, rows[i].end());
      values[0] = rows[i][0];
      output.add(contact.points()[i].position, values);
    }
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.physical_units    = unit_labels(parameters,
                                        {{"weight", Quantity::area},
                                         {"gap", Quantity::length},
                                         {"pressure", Quantity::stress},
                                         {"tau", Quantity::stress},
                                         {"cell_pressure", Quantity::stress},
                                         {"cell_tau", Quantity::stress},
                                         {"jump", Quantity::length}},
                                        dim);
  output.set_flags(flags);
  return write_vtu_files(
    output, directory, "contact_" + dealii::Utilities::int_to_string(number, 4), communicator,
    field_datum("TimeValue", time) + field_data_of_names("pair", contact.pairs()));
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template struct ContactSummary<dim>;                                                             \
  template std::vector<std::string>         contact_columns<dim>();                                \
  template std::vector<ContactRow<dim>>     contact_rows(const ContactPoints<dim> &);              \
  template std::vector<ContactSummary<dim>> summarise_contact(const ContactPoints<dim> &,          \
                                                              const MPI_Comm, const bool);         \
  template bool write_contact_csv(const ContactPoints<dim> &, const MPI_Comm, const std::string &, \
                                  const unsigned int);                                             \
  template std::string write_contact_vtu(const ContactPoints<dim> &, const FieldParameters &,      \
                                         const MPI_Comm, const std::string &, const unsigned int,  \
                                         const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
