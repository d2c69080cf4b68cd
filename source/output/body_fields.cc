#include <scree/output/body_fields.h>
#include <scree/output/column_names.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
BodyFields<dim>::BodyFields(const FieldParameters &parameters, const FieldsOfRun &of_run)
{
  add_vector("displacement", Quantity::length,
             [](const Sample &sample) { return sample.bulk.displacement; });
  if (of_run.velocity)
    add_vector("velocity", Quantity::velocity,
               [](const Sample &sample) { return sample.velocity; });
  if (parameters.has("stress"))
    add_stresses();
  if (parameters.has("strain"))
    add_tensor("strain", Quantity::number, [](const Sample &sample) { return sample.bulk.strain; });
  if (parameters.has("plastic strain") && of_run.plastic_strain)
    add_number("plastic_strain", Quantity::number,
               [](const Sample &sample) { return sample.bulk.plastic_strain; });
  if (parameters.has("plastic zone") && of_run.plastic_strain)
    add_number("plastic_zone", Quantity::number,
               [](const Sample &sample) { return plastic_zone(sample.bulk.plastic_strain); });
  if (parameters.has("principal stretches") && of_run.stretches)
    add_eigenvalues(
      "principal_stretch", Quantity::number,
      [](const Sample &sample) { return sample.bulk.strain; },
      [](const double logarithmic_strain) { return std::exp(logarithmic_strain); });
  if (parameters.has("strain energy"))
    add_number("strain_energy_density", Quantity::stress,
               [](const Sample &sample) { return sample.bulk.energy_density; });
  if (parameters.has("volume ratio"))
    add_number("volume_ratio", Quantity::number,
               [](const Sample &sample) { return sample.bulk.volume_ratio; });
  add_number("body", Quantity::number, [](const Sample &sample) { return double(sample.body); });
}

template <int dim>
void
BodyFields<dim>::add_stresses()
{
  add_tensor("stress", Quantity::stress, [](const Sample &sample) { return sample.bulk.stress; });
  if (dim == 2)
    add_number("stress_zz", Quantity::stress,
               [](const Sample &sample) { return sample.bulk.out_of_plane_stress; });
  add_number("von_mises", Quantity::stress, [](const Sample &sample) {
    return von_mises(sample.bulk.stress, sample.bulk.out_of_plane_stress);
  });
  add_eigenvalues(
    "principal_stress", Quantity::stress, [](const Sample &sample) { return sample.bulk.stress; },
    [](const double stress) { return stress; });
}

template <int dim>
void
BodyFields<dim>::add_eigenvalues(const std::string &name, const Quantity quantity,
                                 const TensorOf &tensor, double (*function)(double))
{
  std::vector<std::string> names;
  for (unsigned int d = 0; d < dim; ++d)
    names.push_back(name + "_" + std::to_string(d + 1));
  fields.push_back(
    {names, quantity, false, [tensor, function](const Sample &sample, std::vector<double> &values) {
       for (const double principal : principal_values(tensor(sample)))
         values.push_back(function(principal));
     }});
}

template <int dim>
void
BodyFields<dim>::add_number(const std::string &name, const Quantity quantity,
                            const std::function<double(const Sample &)> &number)
{
  fields.push_back(
    {{name}, quantity, false, [number](const Sample &sample, std::vector<double> &values) {
       values.push_back(number(sample));
     }});
}

template <int dim>
void
BodyFields<dim>::add_vector(const std::string &name, const Quantity quantity,
                            const std::function<dealii::Tensor<1, dim>(const Sample &)> &vector)
{
  fields.push_back({std::vector<std::string>(dim, name), quantity, true,
                    [vector](const Sample &sample, std::vector<double> &values) {
                      const dealii::Tensor<1, dim> all = vector(sample);
                      values.insert(values.end(), all.begin_raw(), all.end_raw());
                    }});
}

template <int dim>
void
BodyFields<dim>::add_tensor(const std::string &name, const Quantity quantity,
                            const TensorOf &tensor)
{
  std::vector<std::string> names;
  add_symmetric_names<dim>(name, names);
  fields.push_back(
    {names, quantity, false, [tensor](const Sample &sample, std::vector<double> &values) {
       add_symmetric<dim>(tensor(sample), values);
     }});
}

template <int dim>
std::vector<std::string>
BodyFields<dim>::names() const
{
  std::vector<std::string> result;
  for (const Field &field : fields)
    result.insert(result.end(), field.names.begin(), field.names.end());
  return result;
}

template <int dim>
std::vector<std::pair<std::string, Quantity>>
BodyFields<dim>::quantities() const
{
  std::vector<std::pair<std::string, Quantity>> result;
  for (const Field &field : fields)
    for (unsigned int c = 0; c < (field.is_vector ? 1 : field.names.size()); ++c)
      result.emplace_back(field.names[c], field.quantity);
  return result;
}

template <int dim>
std::vector<std::pair<unsigned int, std::string>>
BodyFields<dim>::vectors() const
{
  std::vector<std::pair<unsigned int, std::string>> result;
  unsigned int                                      first = 0;
  for (const Field &field : fields)
    {
      if (field.is_vector)
        result.emplace_back(first, field.names[0]);
      first += field.names.size();
    }
  return result;
}

template <int dim>
std::vector<double>
BodyFields<dim>::values(const VertexSample<dim> &sample) const
{
  std::vector<double> result;
  result.reserve(32);
  for (const Field &field : fields)
    field.append(sample, result);
  return result;
}

template <int dim>
bool
may_flow(const Body<dim> &body)
{
  return body.law && body.law->secant_ratio(1.) < 1.;
}

template <int dim>
bool
may_flow(const std::vector<Body<dim>> &bodies)
{
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const Body<dim> &body) { return may_flow(body); });
}

double
plastic_zone(const double plastic_strain)
{
  return plastic_strain > 1e-12 ? 1. : 0.;
}

template <int dim>
double
von_mises(const dealii::SymmetricTensor<2, dim> &stress, const double zz)
{
  dealii::SymmetricTensor<2, 3> full;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      full[i][j] = stress[i][j];
  if (dim == 2)
    full[2][2] = zz;
  return std::sqrt(1.5) * deviator(full).norm();
}

std::array<double, 2>
principal_values(const dealii::SymmetricTensor<2, 2> &tensor)
{
  const double mean   = 0.5 * (tensor[0][0] + tensor[1][1]);
  const double radius = std::hypot(0.5 * (tensor[0][0] - tensor[1][1]), tensor[0][1]);
  return {{mean + radius, mean - radius}};
}

std::array<double, 3>
principal_values(const dealii::SymmetricTensor<2, 3> &tensor)
{
  return eigenvalues(tensor);
}

template class BodyFields<2>;
template class BodyFields<3>;
template bool   may_flow(const Body<2> &);
template bool   may_flow(const Body<3> &);
template bool   may_flow(const std::vector<Body<2>> &);
template bool   may_flow(const std::vector<Body<3>> &);
template double von_mises(const dealii::SymmetricTensor<2, 2> &, const double);
template double von_mises(const dealii::SymmetricTensor<2, 3> &, const double);
} // namespace scree
