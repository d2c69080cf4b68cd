#include <scree/material/small_strain.h>

namespace scree
{
using namespace dealii;

namespace
{
/** `sym(e_k (x) f)`. */
Tensor<2, 3>
symmetric_part(const unsigned int k, const Tensor<1, 3> &f)
{
  Tensor<2, 3> strain;
  for (unsigned int i = 0; i < 3; ++i)
    {
      strain[i][k] += 0.5 * f[i];
      strain[k][i] += 0.5 * f[i];
    }
  return strain;
}

/** `sym(F - I)`. */
Tensor<2, 3>
small_strain(const Tensor<2, 3> &F)
{
  Tensor<2, 3> strain = 0.5 * (F + transpose(F));
  for (unsigned int i = 0; i < 3; ++i)
    strain[i][i] -= 1;
  return strain;
}

/** Writes what the plastic laws say alike. */
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

template <WorkOf configuration>
Tensor<2, 3>
LinearPoint<configuration>::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  return moduli.stress(symmetric_part(k, f));
}

template struct LinearPoint<WorkOf::start>;
template struct LinearPoint<WorkOf::reference>;

SmallStrain::SmallStrain(const IsotropicModuli &moduli)
    : moduli(moduli)
{
}

SmallStrain::Point
SmallStrain::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  const Tensor<2, 3> strain = small_strain(F_D * start.deformation_gradient);
  Point              point;
  point.moduli    = moduli;
  point.kirchhoff = moduli.stress(strain);
  point.energy    = 0.5 * scalar_product(point.kirchhoff, strain);
  return point;
}

SmallStrainIncremental::SmallStrainIncremental(const IsotropicModuli &moduli)
    : moduli(moduli)
{
}

SmallStrainIncremental::Point
SmallStrainIncremental::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  Point point;
  point.moduli    = moduli;
  point.kirchhoff = start.tensor + moduli.stress(small_strain(F_D));
  point.internal  = point.kirchhoff;
  point.energy    = moduli.energy(point.kirchhoff);
  return point;
}

SmallStrainPlasticity::SmallStrainPlasticity(const IsotropicModuli &moduli,
                                             const Hardening       &hardening)
    : moduli(moduli)
    , hardening(hardening)
{
}

SmallStrainPlasticity::Point::Point(const RadialReturn &flow)
    : flow(flow)
{
}

SmallStrainPlasticity::Point
SmallStrainPlasticity::at(const Tensor<2, 3> &F_D, const double, const IncrementStart &start) const
{
  const Tensor<2, 3> strain = small_strain(F_D * start.deformation_gradient);
  const Tensor<2, 3> trial  = moduli.stress(strain - start.tensor);
  Point              point(RadialReturn(trial, start.alpha, moduli.mu, hardening));
  point.moduli = moduli;
  set_response(point, point.flow, moduli, hardening);
  point.internal = start.tensor + (trial - point.flow.stress) / (2 * moduli.mu);
  return point;
}

Tensor<2, 3>
SmallStrainPlasticity::Point::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  return flow.derivative(moduli.stress(symmetric_part(k, f)));
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
