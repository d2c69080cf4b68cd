#pragma once

#include <scree/material/increment_law.h>

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

inline bool
is_plastic(const std::string &name)
{
  return name.find("J2") != std::string::npos;
}

inline bool
is_geometric(const std::string &name)
{
  return name != "linear elastic" && name != "J2 small strain";
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

/** The history at the end of an increment. */
template <int dim>
PointHistory<dim>
after(const PointHistory<dim> &history, const dealii::Tensor<2, dim> &F_D,
      const IncrementResponse<dim> &response)
{
  return {F_D * history.deformation_gradient, response.internal, response.alpha};
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

/** A history after some straining, such that laws with internal tensors have a stress. */
template <int dim>
PointHistory<dim>
random_history(std::mt19937 &generator, const IncrementLaw<dim> &law)
{
  using namespace dealii;
  PointHistory<dim> history;
  const double      scale      = law.internal() == InternalTensor::cauchy_stress ? young : 1;
  const auto        in_plane   = symmetrize(random_tensor<dim>(generator, 0.03 * scale));
  history.deformation_gradient = unit<dim>() + random_tensor<dim>(generator, 0.3);
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      history.internal[i][j] = in_plane[i][j];
  history.internal[2][2] += 0.01 * scale;
  history.alpha = std::abs(in_plane[0][1]) / scale;
  return history;
}
} // namespace scree::increment_points
