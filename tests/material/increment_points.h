#pragma once

#include <scree/material/increment_law.h>
#include <scree/material/logarithmic_strain.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

/** Laws, single points and random states for the tests of laws in increments. */
namespace scree::increment_points
{
constexpr double young = 200, poisson = 0.3, yield_stress = 8, hardening_modulus = 20;
constexpr double mu     = young / (2 * (1 + poisson));
constexpr double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));

/** Laws of the linear theory in total strains. */
inline bool
is_total(const std::string &name)
{
  return name == "linear elastic" || name == "J2 small strain";
}

inline bool
is_geometric(const std::string &name)
{
  return !is_total(name) && name != "linear elastic incremental";
}

inline MaterialParameters
parameters_of(const std::string &name)
{
  MaterialParameters parameters;
  parameters.law     = name;
  parameters.young   = young;
  parameters.poisson = poisson;
  if (is_plastic(name))
    {
      parameters.yield_stress      = yield_stress;
      parameters.hardening_modulus = hardening_modulus;
    }
  return parameters;
}

template <int dim>
struct Answer
{
  IncrementResponse<dim> response;
  dealii::Tensor<4, dim> tangent;
};

template <int dim>
Answer<dim>
answer(const IncrementLaw<dim> &law, const dealii::Tensor<2, dim> &F_D, const IncrementStart &start)
{
  using namespace dealii;
  Answer<dim> result;
  law.respond(ArrayView<const Tensor<2, dim>>(&F_D, 1), ArrayView<const IncrementStart>(&start, 1),
              ArrayView<IncrementResponse<dim>>(&result.response, 1),
              ArrayView<Tensor<4, dim>>(&result.tangent, 1));
  return result;
}

template <int dim>
dealii::Tensor<2, dim>
unit()
{
  return dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
}

/** Entries uniform in (-size, size). */
template <int dim>
dealii::Tensor<2, dim>
random_tensor(std::mt19937 &generator, const double size)
{
  std::uniform_real_distribution<double> uniform(-size, size);
  dealii::Tensor<2, dim>                 result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = uniform(generator);
  return result;
}

/** A rotation by a random axis (3D) and angle. */
template <int dim>
dealii::Tensor<2, dim>
random_rotation(std::mt19937 &generator)
{
  // Cayley: (I - W)^{-1} (I + W) of a skew W.
  const auto a = random_tensor<dim>(generator, 2.);
  const auto w = 0.5 * (a - transpose(a));
  return invert(unit<dim>() - w) * (unit<dim>() + w);
}

/** `F` with three rows, for plane strain. */
template <int dim>
dealii::Tensor<2, 3>
with_three_rows(const dealii::Tensor<2, dim> &gradient)
{
  dealii::Tensor<2, 3> result;
  result[2][2] = 1;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = gradient[i][j];
  return result;
}

/** `ln(F^{-1} b_e F^{-T})` with a `b_e` of small shear and the volume of `F`. */
inline dealii::SymmetricTensor<2, 3>
plastic_metric(const dealii::Tensor<2, 3> &F, const dealii::SymmetricTensor<2, 3> &shear)
{
  using namespace dealii;
  const Tensor<2, 3> inverse = invert(F);
  const Tensor<2, 3> b_e     = std::pow(determinant(F), 2. / 3.) * exponential(deviator(shear));
  const Tensor<2, 3> metric  = inverse * b_e * transpose(inverse);
  return symmetrize(2. * LogarithmicStrain(eigensystem(metric)).value());
}

/** A history after some straining, at a moderate stress. */
template <int dim>
PointHistory<dim>
random_history(std::mt19937 &generator, const IncrementLaw<dim> &law)
{
  using namespace dealii;
  PointHistory<dim>     history;
  const auto            in_plane = symmetrize(random_tensor<dim>(generator, 0.03));
  SymmetricTensor<2, 3> small;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      small[i][j] = in_plane[i][j];
  small[2][2] += 0.01;
  history.deformation_gradient = unit<dim>() + random_tensor<dim>(generator, 0.3);
  const Tensor<2, 3> F         = with_three_rows<dim>(history.deformation_gradient);
  switch (law.internal())
    {
    case InternalTensor::none:
      break;
    case InternalTensor::plastic_metric:
      history.internal = plastic_metric(F, small);
      break;
    case InternalTensor::plastic_strain:
      history.internal = deviator(symmetrize(F) - small);
      break;
    case InternalTensor::cauchy_stress:
      history.internal = young * small;
      break;
    }
  history.alpha = std::abs(in_plane[0][1]);
  return history;
}
} // namespace scree::increment_points
