#include <scree/output/body_fields.h>
#include <scree/output/column_names.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
BodyFields<dim>::BodyFields(const FieldParameters &parameters, const bool with_velocity,
                            const bool with_plastic_strain)
{
  using Sample = VertexSample<dim>;
  add_vector("displacement", Quantity::length,
             [](const Sample &sample) { return sample.bulk.displacement; });
  if (with_velocity)
    add_vector("velocity", Quantity::velocity,
               [](const Sample &sample) { return sample.velocity; });
  if (parameters.has("stress"))
    add_stresses();
  if (parameters.has("strain"))
    add_tensor("strain", Quantity::number, [](const Sample &sample) { return sample.bulk.strain; });
  if (parameters.has("plastic strain") && with_plastic_strain)
    add("plastic_strain", Quantity::number,
        [](const Sample &sample) { return sample.bulk.plastic_strain; });
  if (parameters.has("strain energy"))
    add("strain_energy_density", Quantity::stress,
        [](const Sample &sample) { return sample.bulk.energy_density; });
  if (parameters.has("volume ratio"))
    add("volume_ratio", Quantity::number,
        [](const Sample &sample) { return sample.bulk.volume_ratio; });
  add("body", Quantity::number, [](const Sample &sample) { return double(sample.body); });
}

template <int dim>
void
BodyFields<dim>::add_stresses()
{
  using Sample = VertexSample<dim>;
  add_tensor("stress", Quantity::stress, [](const Sample &sample) { return sample.bulk.stress; });
  if (dim == 2)
    add("stress_zz", Quantity::stress,
        [](const Sample &sample) { return sample.bulk.out_of_plane_stress; });
  add("von_mises", Quantity::stress, [](const Sample &sample) {
    return von_mises(sample.bulk.stress, sample.bulk.out_of_plane_stress);
  });
  for (unsigned int d = 0; d < dim; ++d)
    add("principal_stress_" + std::to_string(d + 1), Quantity::stress,
        [d](const Sample &sample) { return eigenvalues(sample.bulk.stress)[d]; });
}

template <int dim>
void
BodyFields<dim>::add(const std::string &name, const Quantity quantity, const Value &value)
{
  fields.push_back({name, quantity, value, 0, false});
}

template <int dim>
void
BodyFields<dim>::add_vector(
  const std::string &name, const Quantity quantity,
  const std::function<dealii::Tensor<1, dim>(const VertexSample<dim> &)> &vector)
{
  for (unsigned int d = 0; d < dim; ++d)
    fields.push_back({name, quantity,
                      [vector, d](const VertexSample<dim> &sample) { return vector(sample)[d]; }, d,
                      true});
}

template <int dim>
void
BodyFields<dim>::add_tensor(
  const std::string &name, const Quantity quantity,
  const std::function<dealii::SymmetricTensor<2, dim>(const VertexSample<dim> &)> &tensor)
{
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      add(name + "_" + axes[i] + axes[j], quantity,
          [tensor, i, j](const VertexSample<dim> &sample) { return tensor(sample)[i][j]; });
}

template <int dim>
std::vector<std::string>
BodyFields<dim>::names() const
{
  std::vector<std::string> result;
  for (const Field &field : fields)
    result.push_back(field.name);
  return result;
}

template <int dim>
std::vector<std::pair<std::string, Quantity>>
BodyFields<dim>::quantities() const
{
  std::vector<std::pair<std::string, Quantity>> result;
  for (const Field &field : fields)
    if (field.component == 0)
      result.emplace_back(field.name, field.quantity);
  return result;
}

template <int dim>
std::vector<std::pair<unsigned int, std::string>>
BodyFields<dim>::vectors() const
{
  std::vector<std::pair<unsigned int, std::string>> result;
  for (unsigned int f = 0; f < fields.size(); ++f)
    if (fields[f].is_vector && fields[f].component == 0)
      result.emplace_back(f, fields[f].name);
  return result;
}

template <int dim>
std::vector<double>
BodyFields<dim>::values(const VertexSample<dim> &sample) const
{
  std::vector<double> result;
  result.reserve(fields.size());
  for (const Field &field : fields)
    result.push_back(field.value(sample));
  return result;
}

template <int dim>
bool
may_flow(const std::vector<Body<dim>> &bodies)
{
  return std::any_of(bodies.begin(), bodies.end(), [](const Body<dim> &body) {
    return body.law && body.law->secant_ratio(1.) < 1.;
  });
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

template class BodyFields<2>;
template class BodyFields<3>;
template bool   may_flow(const std::vector<Body<2>> &);
template bool   may_flow(const std::vector<Body<3>> &);
template double von_mises(const dealii::SymmetricTensor<2, 2> &, const double);
template double von_mises(const dealii::SymmetricTensor<2, 3> &, const double);
} // namespace scree
