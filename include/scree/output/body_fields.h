#pragma once

#include <scree/mechanics/bulk.h>
#include <scree/output/field_parameters.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** What is known at a vertex of a piece of a body; zero in rigid bodies but for the motion. */
template <int dim>
struct VertexSample
{
  BulkSample<dim>        bulk;
  dealii::Tensor<1, dim> velocity;
  unsigned int           body = 0;
};

/** The fields of the files of bodies: names, quantities, values. */
template <int dim>
class BodyFields
{
public:
  /** @param with_plastic_strain whether there is a law with a yield stress */
  BodyFields(const FieldParameters &parameters, const bool with_velocity,
             const bool with_plastic_strain);

  /** One of each component, those of vectors with the same name. */
  std::vector<std::string> names() const;

  /** Each name once, without the components of vectors. */
  std::vector<std::pair<std::string, Quantity>> quantities() const;

  /** The first component and the name of each vector. */
  std::vector<std::pair<unsigned int, std::string>> vectors() const;

  /** The values in the order of names(). */
  std::vector<double> values(const VertexSample<dim> &sample) const;

private:
  using Sample = VertexSample<dim>;
  using Append = std::function<void(const Sample &, std::vector<double> &)>;
  struct Field
  {
    std::vector<std::string> names; //!< of its components
    Quantity                 quantity;
    bool                     is_vector;
    Append                   append; //!< the values
  };

  using TensorOf = std::function<dealii::SymmetricTensor<2, dim>(const Sample &)>;

  void add_number(const std::string &name, const Quantity quantity,
                  const std::function<double(const Sample &)> &number);
  void add_vector(const std::string &name, const Quantity quantity,
                  const std::function<dealii::Tensor<1, dim>(const Sample &)> &vector);
  void add_tensor(const std::string &name, const Quantity quantity, const TensorOf &tensor);
  void add_stresses();

  std::vector<Field> fields;
};

/** Whether a body has a yield stress. */
template <int dim>
bool may_flow(const Body<dim> &body);

/** Whether one of the bodies has. */
template <int dim>
bool may_flow(const std::vector<Body<dim>> &bodies);

/** Von Mises stress; `zz` is the out-of-plane stress of plane strain, ignored in 3D. */
template <int dim>
double von_mises(const dealii::SymmetricTensor<2, dim> &stress, const double zz);
} // namespace scree
