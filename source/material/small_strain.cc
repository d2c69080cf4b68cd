#include <scree/material/small_strain.h>

namespace scree
{
using namespace dealii;

namespace
{
/** Writes what both laws say alike; the Kirchhoff stress is that of an unchanged volume. */
void
set_response(KirchhoffStress &point, const RadialReturn &flow, const IsotropicModuli &moduli,
             const Hardening &hardening)
{
  point.kirchhoff   = flow.stress;
  point.internal    = flow.stress;
  point.alpha       = flow.alpha;
  point.energy      = moduli.energy(flow.stress) + hardening.energy(flow.alpha);
  point.dissipation = flow.dissipation;
}
} // namespace

SmallStrain::SmallStrain(const IsotropicModuli &moduli, const Hardening &hardening)
    : moduli(moduli)
    , hardening(hardening)
{
}

SmallStrain::Point::Point(const RadialReturn &flow)
    : flow(flow)
{
}

SmallStrain::Point
SmallStrain::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  Tensor<2, 3> strain = 0.5 * (F_D + transpose(F_D));
  for (unsigned int i = 0; i < 3; ++i)
    strain[i][i] -= 1;
  Point point(
    RadialReturn(start.tensor + moduli.stress(strain), start.alpha, moduli.mu, hardening));
  point.moduli = moduli;
  set_response(point, point.flow, moduli, hardening);
  return point;
}

Tensor<2, 3>
SmallStrain::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  Tensor<2, 3> strain;
  for (unsigned int i = 0; i < 3; ++i)
    {
      strain[i][k] += 0.5 * f[i];
      strain[k][i] += 0.5 * f[i];
    }
  return flow.derivative(moduli.stress(strain));
}

SmallStrainRotated::SmallStrainRotated(const IsotropicModuli &moduli, const Hardening &hardening)
    : moduli(moduli)
    , hardening(hardening)
{
}

SmallStrainRotated::Point::Point(const LogarithmicStrain &strain, const PolarRotation &rotation,
                                 const RadialReturn &flow)
    : strain(strain)
    , rotation(rotation)
    , flow(flow)
{
}

SmallStrainRotated::Point
SmallStrainRotated::at(const Tensor<2, 3> &F_D, const double J_D, const IncrementStart &start) const
{
  const Eigensystem       system = eigensystem(F_D * transpose(F_D));
  const LogarithmicStrain strain(system);
  const PolarRotation     rotation(F_D, system);
  const Tensor<2, 3>      rotated = rotation.value() * start.tensor * transpose(rotation.value());
  const RadialReturn      flow(rotated + moduli.stress(strain.value()), start.alpha, moduli.mu,
                               hardening);
  Point                   point(strain, rotation, flow);
  point.rotated_stress = rotated;
  point.moduli         = moduli;
  point.J_D            = J_D;
  set_response(point, flow, moduli, hardening);
  point.kirchhoff *= J_D;
  return point;
}

Tensor<2, 3>
SmallStrainRotated::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  const Tensor<2, 3> turned = rotation.spin(k, f) * rotated_stress; // its transpose belongs to it
  const Tensor<2, 3> trial  = turned + transpose(turned) + moduli.stress(strain.derivative(k, f));
  return J_D * (flow.derivative(trial) + f[k] * flow.stress);
}
} // namespace scree
