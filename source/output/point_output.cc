#include <scree/mechanics/step_start.h>
#include <scree/output/body_fields.h>
#include <scree/output/column_names.h>
#include <scree/output/patch_output.h>
#include <scree/output/point_output.h>
#include <scree/output/vtu_files.h>

#include <deal.II/base/utilities.h>

namespace scree
{
namespace
{
/** Names and quantities of the columns of a material point, components of vectors with suffix. */
template <int dim>
std::vector<std::pair<std::string, Quantity>>
point_columns(const bool has_inertia, const bool has_plastic_strain)
{
  std::vector<std::pair<std::string, Quantity>> columns;
  const auto add_vector = [&](const std::string &name, const Quantity quantity) {
    for (unsigned int d = 0; d < dim; ++d)
      columns.emplace_back(name + "_" + axes[d], quantity);
  };
  add_vector("displacement", Quantity::length);
  if (has_inertia)
    add_vector("velocity", Quantity::velocity);
  columns.emplace_back("volume", Quantity::volume);
  columns.emplace_back("volume_ratio", Quantity::number);
  std::vector<std::string> stresses;
  add_symmetric_names<dim>("stress", stresses);
  for (const std::string &stress : stresses)
    columns.emplace_back(stress, Quantity::stress);
  if (has_plastic_strain)
    columns.emplace_back("plastic_strain", Quantity::number);
  columns.emplace_back("body", Quantity::number);
  return columns;
}

template <int dim>
std::vector<double>
point_values(const MaterialPoints<dim> &points, const std::size_t p, const bool has_inertia,
             const bool has_plastic_strain)
{
  std::vector<double> values;
  const auto          append = [&](const dealii::Tensor<1, dim> &vector) {
    for (unsigned int d = 0; d < dim; ++d)
      values.push_back(vector[d]);
  };
  append(points.position[p] - points.reference_position[p]);
  if (has_inertia)
    append(points.velocity[p]);
  values.push_back(points.volume(p));
  values.push_back(determinant(points.deformation_gradient[p]));
  add_symmetric(points.stress[p], values);
  if (has_plastic_strain)
    values.push_back(points.internal[p * points.n_internal() + StepStart<dim>::index_of_alpha]);
  values.push_back(points.body[p]);
  return values;
}
} // namespace

template <int dim>
std::string
write_points_vtu(const MaterialPoints<dim> &points, const std::vector<Body<dim>> &bodies,
                 const FieldParameters &parameters, const bool has_inertia,
                 const MPI_Comm communicator, const std::string &directory,
                 const unsigned int number, const double time)
{
  const bool               has_plastic_strain = may_flow(bodies);
  const auto               columns            = point_columns<dim>(has_inertia, has_plastic_strain);
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const auto &[name, quantity] : columns)
    names.push_back(name);
  PointPatches<dim> output(names);
  for (std::size_t p = 0; p < points.size(); ++p)
    output.add(points.position[p], point_values(points, p, has_inertia, has_plastic_strain));
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.physical_units    = unit_labels(parameters, columns, dim);
  output.set_flags(flags);
  return write_vtu_files(output, directory, "points_" + dealii::Utilities::int_to_string(number, 4),
                         communicator,
                         field_datum("TimeValue", time) + field_data_of_names("body", bodies));
}

#define SCREE_INSTANTIATE(dim)                                                            \
  template std::string write_points_vtu(                                                  \
    const MaterialPoints<dim> &, const std::vector<Body<dim>> &, const FieldParameters &, \
    const bool, const MPI_Comm, const std::string &, const unsigned int, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
