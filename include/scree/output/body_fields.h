#pragma once

#include <scree/mechanics/bulk.h>
#include <scree/output/field_parameters.h>

#include <array>
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

/** What a run has, so that fields of it can be written. */
struct FieldsOfRun
{
  bool velocity       = false;
  bool plastic_strain = false; //!< there is a law with a yield stress
  bool stretches      = false; //!< the geometry moves, so that strains are logarithmic
};

/** The fields of the files of bodies: names, quantities, values. */
template <int dim>
class BodyFields
{
public:
  BodyFields(const FieldParameters &parameters, const FieldsOfRun &of_run);

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
  /** Of a tensor, in falling order: NAME_1 ... */
  void add_eigenvalues(const std::string &name, const Quantity quantity, const TensorOf &tensor,
                       double (*function)(double));

  std::vector<Field> fields;
};

/** Whether a body has a yield stress. */
template <int dim>
bool may_flow(const Body<dim> &body);

/** Whether one of the bodies has. */
template <int dim>
bool may_flow(const std::vector<Body<dim>> &bodies);

/** Whether the material has yielded in the course of the run, by its equivalent plastic strain: 1
 * or 0. Less than 1e-12 is round-off. */
double plastic_zone(const double plastic_strain);

/** Von Mises stress; `zz` is the out-of-plane stress of plane strain, ignored in 3D. */
template <int dim>
double von_mises(const dealii::SymmetricTensor<2, dim> &stress, const double zz);

/** Eigenvalues, the largest first, also of a tensor that is isotropic but for round-off. */
std::array<double, 2> principal_values(const dealii::SymmetricTensor<2, 2> &tensor);
std::array<double, 3> principal_values(const dealii::SymmetricTensor<2, 3> &tensor);
} // namespace scree
