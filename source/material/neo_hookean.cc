#include <scree/material/neo_hookean.h>

#include <cmath>

namespace scree
{
using namespace dealii;

NeoHookean::NeoHookean(const IsotropicModuli &moduli)
    : moduli(moduli)
{
}

NeoHookean::Point
NeoHookean::at(const Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const
{
  const double log_J = std::log(J_D * start.volume_ratio);
  Point        point;
  point.moduli    = moduli;
  point.b         = F_D * start.tensor * transpose(F_D);
  point.kirchhoff = moduli.mu * point.b;
  for (unsigned int i = 0; i < 3; ++i)
    point.kirchhoff[i][i] += moduli.lambda * log_J - moduli.mu;
  point.energy
    = moduli.mu * (0.5 * (trace(point.b) - 3) - log_J) + 0.5 * moduli.lambda * log_J * log_J;
  return point;
}

Tensor<2, 3>
NeoHookean::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  const Tensor<1, 3> change = moduli.mu * (b * f);
  Tensor<2, 3>       result;
  for (unsigned int i = 0; i < 3; ++i)
    {
      result[i][k] += change[i];
      result[k][i] += change[i];
      result[i][i] += moduli.lambda * f[k];
    }
  return result;
}
} // namespace scree
