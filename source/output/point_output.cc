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
/** Which columns there are besides those of every run. */
struct PointColumns
{
  bool velocity, plastic_strain, internal;
};

/** Names and quantities of the columns of a material point, components of vectors with suffix. */
template <int dim>
std::vector<std::pair<std::string, Quantity>>
point_columns(const PointColumns &has)
{
  std::vector<std::pair<std::string, Quantity>> columns;
  const auto add = [&](const std::vector<std::string> &names, const Quantity quantity) {
    for (const std::string &name : names)
      columns.emplace_back(name, quantity);
  };
  std::vector<std::string> displacements, velocities, stresses, gradients, internals;
  add_vector_names<dim>("displacement", displacements);
  add_vector_names<dim>("velocity", velocities);
  add_symmetric_names<dim>("stress", stresses);
  if (dim == 2)
    stresses.emplace_back("stress_zz");
  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int e = 0; e < dim; ++e)
      gradients.push_back("deformation_gradient_" + axes[d] + axes[e]);
  add_symmetric_names<3>("internal", internals);
  add_symmetric_names<3>("elastic_deviator", internals);

  add(displacements, Quantity::length);
  if (has.velocity)
    add(velocities, Quantity::velocity);
  add({"volume"}, Quantity::volume);
  add({"volume_ratio"}, Quantity::number);
  add(stresses, Quantity::stress);
  add(gradients, Quantity::number);
  if (has.plastic_strain)
    add({"plastic_strain", "plastic_zone"}, Quantity::number);
  if (has.internal)
    add(internals, Quantity::number);
  add({"body"}, Quantity::number);
  return columns;
}

/** Appends the six components of a tensor that store_internal() put at `numbers`. */
void
add_internal_tensor(const double *numbers, std::vector<double> &values)
{
  dealii::SymmetricTensor<2, 3> tensor;
  for (unsigned int i = 0; i < 6; ++i)
    tensor.access_raw_entry(i) = numbers[i];
  add_symmetric(tensor, values);
}

template <int dim>
std::vector<double>
point_values(const MaterialPoints<dim> &points, const std::size_t p, const PointColumns &has)
{
  std::vector<double> values;
  const auto          append = [&](const dealii::Tensor<1, dim> &vector) {
    values.insert(values.end(), vector.begin_raw(), vector.end_raw());
  };
  append(points.position[p] - points.reference_position[p]);
  if (has.velocity)
    append(points.velocity[p]);
  values.push_back(points.volume(p));
  values.push_back(determinant(points.deformation_gradient[p]));
  add_symmetric(points.stress[p], values);
  if (dim == 2)
    values.push_back(points.out_of_plane_stress[p]);
  for (unsigned int d = 0; d < dim; ++d)
    append(points.deformation_gradient[p][d]);
  const double *internal = has.internal ? &points.internal[p * points.n_internal()] : nullptr;
  if (has.plastic_strain)
    for (const double value : {internal[StepStart<dim>::index_of_alpha],
                               plastic_zone(internal[StepStart<dim>::index_of_alpha])})
      values.push_back(value);
  if (has.internal)
    {
      add_internal_tensor(internal, values);
      add_internal_tensor(internal + StepStart<dim>::index_of_alpha + 1, values);
    }
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
  const PointColumns       has     = {has_inertia, may_flow(bodies), points.n_internal() > 0};
  const auto               columns = point_columns<dim>(has);
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const auto &[name, quantity] : columns)
    names.push_back(name);
  PointPatches<dim> output(names);
  for (std::size_t p = 0; p < points.size(); ++p)
    output.add(points.position[p], point_values(points, p, has));
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
