#include <scree/material/hencky.h>

namespace scree
{
using namespace dealii;

namespace
{
/** `1/2 ln(F_D b_n F_D^T)`. */
LogarithmicStrain
strain_after(const Tensor<2, 3> &F_D, const IncrementStart &start)
{
  return LogarithmicStrain(eigensystem(F_D * start.tensor * transpose(F_D)));
}
} // namespace

Hencky::Hencky(const IsotropicModuli &moduli)
    : moduli(moduli)
{
}

Hencky::Point::Point(const LogarithmicStrain &strain)
    : strain(strain)
{
}

Hencky::Point
Hencky::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  Point              point(strain_after(F_D, start));
  const Tensor<2, 3> strain = point.strain.value();
  point.moduli              = moduli;
  point.kirchhoff           = moduli.stress(strain);
  point.energy              = 0.5 * scalar_product(point.kirchhoff, strain);
  return point;
}

Tensor<2, 3>
Hencky::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  return moduli.stress(strain.derivative(k, f));
}

HenckyPlasticity::HenckyPlasticity(const IsotropicModuli &moduli, const Hardening &hardening)
    : moduli(moduli)
    , hardening(hardening)
{
}

HenckyPlasticity::Point::Point(const LogarithmicStrain &trial_strain, const RadialReturn &flow)
    : trial_strain(trial_strain)
    , flow(flow)
{
}

HenckyPlasticity::Point
HenckyPlasticity::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  const LogarithmicStrain trial_strain = strain_after(F_D, start);
  const RadialReturn flow(moduli.stress(trial_strain.value()), start.alpha, moduli.mu, hardening);
  Point              point(trial_strain, flow);
  point.moduli              = moduli;
  point.kirchhoff           = flow.stress;
  const Tensor<2, 3> strain = moduli.strain(flow.stress);
  point.internal            = 2 * strain;
  point.alpha               = flow.alpha;
  point.energy      = 0.5 * scalar_product(flow.stress, strain) + hardening.energy(flow.alpha);
  point.dissipation = flow.dissipation;
  return point;
}

Tensor<2, 3>
HenckyPlasticity::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  return flow.derivative(moduli.stress(trial_strain.derivative(k, f)));
}
} // namespace scree
