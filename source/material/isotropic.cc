#include <scree/material/isotropic.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

IsotropicModuli
IsotropicModuli::from_young(const double young, const double poisson)
{
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

double
IsotropicModuli::projected_share(const unsigned int dim) const
{
  return std::max(0., lambda - largest_ratio * mu) / (lambda + 2 * mu / dim);
}

Tensor<2, 3>
IsotropicModuli::stress(const Tensor<2, 3> &strain) const
{
  Tensor<2, 3> result   = 2 * mu * strain;
  const double pressure = lambda * trace(strain);
  for (unsigned int i = 0; i < 3; ++i)
    result[i][i] += pressure;
  return result;
}

Tensor<2, 3>
IsotropicModuli::strain(const Tensor<2, 3> &stress) const
{
  Tensor<2, 3> result = stress / (2 * mu);
  const double shift  = lambda / (3 * lambda + 2 * mu) * trace(stress) / (2 * mu);
  for (unsigned int i = 0; i < 3; ++i)
    result[i][i] -= shift;
  return result;
}

double
IsotropicModuli::energy(const Tensor<2, 3> &stress) const
{
  return 0.5 * scalar_product(stress, strain(stress));
}

double
Hardening::energy(const double alpha) const
{
  return 0.5 * modulus * alpha * alpha;
}

RadialReturn::RadialReturn(const Tensor<2, 3> &trial_stress, const double alpha, const double mu,
                           const Hardening &hardening)
    : stress(trial_stress)
    , alpha(alpha)
{
  Tensor<2, 3> deviator = trial_stress;
  const double pressure = trace(trial_stress) / 3;
  for (unsigned int i = 0; i < 3; ++i)
    deviator[i][i] -= pressure;
  const double norm = deviator.norm();
  const double f = norm - std::sqrt(2. / 3.) * (hardening.yield_stress + hardening.modulus * alpha);
  if (f <= 0)
    return;
  const double dgamma = f / (2 * mu + 2. / 3. * hardening.modulus);
  direction           = deviator / norm;
  reduction           = 2 * mu * dgamma / norm;
  along_flow          = 1 - reduction - hardening.modulus / (3 * mu + hardening.modulus);
  stress -= 2 * mu * dgamma * direction;
  this->alpha += std::sqrt(2. / 3.) * dgamma;
  dissipation = hardening.yield_stress * std::sqrt(2. / 3.) * dgamma;
}

Tensor<2, 3>
RadialReturn::derivative(const Tensor<2, 3> &trial_change) const
{
  if (reduction == 0)
    return trial_change;
  const double flow     = along_flow * scalar_product(direction, trial_change);
  const double pressure = reduction * trace(trial_change) / 3;
  Tensor<2, 3> result   = (1 - reduction) * trial_change - flow * direction;
  for (unsigned int i = 0; i < 3; ++i)
    result[i][i] += pressure;
  return result;
}
} // namespace scree
