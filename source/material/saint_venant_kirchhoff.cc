#include <scree/material/saint_venant_kirchhoff.h>

namespace scree
{
using namespace dealii;

SaintVenantKirchhoff::SaintVenantKirchhoff(const IsotropicModuli &moduli)
    : moduli(moduli)
{
}

SaintVenantKirchhoff::Point
SaintVenantKirchhoff::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  Point point;
  point.moduli        = moduli;
  point.b             = F_D * start.tensor * transpose(F_D);
  Tensor<2, 3> strain = 0.5 * point.b; // has the invariants of E
  for (unsigned int i = 0; i < 3; ++i)
    strain[i][i] -= 0.5;
  const Tensor<2, 3> stress = moduli.stress(strain);
  point.kirchhoff           = stress * point.b;
  point.energy              = 0.5 * scalar_product(stress, strain);
  return point;
}

Tensor<2, 3>
SaintVenantKirchhoff::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  const Tensor<1, 3> w = b * f;
  Tensor<2, 3>       db;
  for (unsigned int i = 0; i < 3; ++i)
    {
      db[i][k] += w[i];
      db[k][i] += w[i];
    }
  const Tensor<2, 3> product = db * b;
  return moduli.lambda * (w[k] * b + 0.5 * (trace(b) - 3) * db)
         + moduli.mu * (product + transpose(product) - db);
}
} // namespace scree
