#include <scree/base/exceptions.h>
#include <scree/material/hencky.h>
#include <scree/material/increment_law.h>
#include <scree/material/increment_response.h>
#include <scree/material/neo_hookean.h>
#include <scree/material/saint_venant_kirchhoff.h>
#include <scree/material/small_strain.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace scree
{
using namespace dealii;

namespace
{
/** A law's name, whether it has a yield stress, and how it is made. */
template <int dim>
struct Registration
{
  using Factory
    = std::function<std::unique_ptr<IncrementLaw<dim>>(const IsotropicModuli &, const Hardening &)>;

  std::string name;
  bool        is_plastic;
  Factory     make;
};

template <int dim, class Law>
std::unique_ptr<IncrementLaw<dim>>
elastic(const IsotropicModuli &moduli, const Hardening &hardening)
{
  return std::make_unique<IncrementLawOf<dim, Law>>(Law(moduli), moduli, hardening);
}

/** Also for laws that are elastic because the yield stress is infinite. */
template <int dim, class Law>
std::unique_ptr<IncrementLaw<dim>>
plastic(const IsotropicModuli &moduli, const Hardening &hardening)
{
  return std::make_unique<IncrementLawOf<dim, Law>>(Law(moduli, hardening), moduli, hardening);
}

/** All laws: a new one is registered by one line here. */
template <int dim>
const std::vector<Registration<dim>> &
registered_laws()
{
  static const std::vector<Registration<dim>> laws = {
    {"linear elastic", false, elastic<dim, SmallStrain>},
    {"linear elastic incremental", false, elastic<dim, SmallStrainIncremental>},
    {"linear elastic rotated", false, plastic<dim, SmallStrainRotated>},
    {"Hencky", false, elastic<dim, Hencky>},
    {"neo-Hookean", false, elastic<dim, NeoHookean>},
    {"Saint Venant-Kirchhoff", false, elastic<dim, SaintVenantKirchhoff>},
    {"J2 small strain", true, plastic<dim, SmallStrainPlasticity>},
    {"J2 small strain rotated", true, plastic<dim, SmallStrainRotated>},
    {"J2", true, plastic<dim, HenckyPlasticity>},
  };
  return laws;
}

} // namespace

template <int dim>
IncrementLaw<dim>::IncrementLaw(const IsotropicModuli &moduli, const Hardening &hardening)
    : moduli(moduli)
    , hardening(hardening)
{
}

template <int dim>
double
IncrementLaw<dim>::projected_share() const
{
  if (std::isfinite(hardening.yield_stress))
    return 1.;
  return moduli.projected_share(dim);
}

template <int dim>
double
IncrementLaw<dim>::secant_ratio(const double alpha) const
{
  if (!std::isfinite(hardening.yield_stress))
    return 1.;
  const double plastic = std::max(0., alpha);
  const double elastic = (hardening.yield_stress + hardening.modulus * plastic) / (3. * moduli.mu);
  return elastic / (elastic + plastic);
}

template <int dim>
IncrementStart
IncrementLaw<dim>::start(const PointHistory<dim> &history) const
{
  IncrementStart result;
  result.alpha                = std::max(0., history.alpha);
  result.deformation_gradient = embed<dim>(history.deformation_gradient);
  const Tensor<2, 3> &F       = result.deformation_gradient;
  const Tensor<2, 3>  internal(history.internal);
  switch (this->internal())
    {
    case InternalTensor::none:
      result.tensor = F * transpose(F);
      break;
    case InternalTensor::plastic_metric:
      result.tensor = F * exponential(internal) * transpose(F);
      break;
    case InternalTensor::plastic_strain:
    case InternalTensor::cauchy_stress:
      result.tensor = internal;
      break;
    }
  if (this->internal() != InternalTensor::cauchy_stress)
    result.volume_ratio = determinant(F);
  return result;
}

template <int dim>
PointHistory<dim>
IncrementLaw<dim>::finish(const PointHistory<dim> &history, const Tensor<2, dim> &F_D,
                          const IncrementResponse<dim> &response) const
{
  PointHistory<dim> result    = history;
  result.deformation_gradient = F_D * history.deformation_gradient;
  result.alpha                = response.alpha;
  if (this->internal() != InternalTensor::plastic_metric)
    result.internal = response.internal;
  else if (response.alpha > std::max(0., history.alpha))
    {
      const Tensor<2, 3> inverse = invert(embed<dim>(result.deformation_gradient));
      const Tensor<2, 3> metric
        = inverse * exponential(Tensor<2, 3>(response.internal)) * transpose(inverse);
      result.internal = symmetrize(2. * LogarithmicStrain(eigensystem(metric)).value());
    }
  return result;
}

std::vector<std::string>
increment_laws()
{
  std::vector<std::string> names;
  for (const auto &law : registered_laws<2>())
    names.push_back(law.name);
  return names;
}

bool
is_plastic(const std::string &law)
{
  for (const auto &registration : registered_laws<2>())
    if (registration.name == law)
      return registration.is_plastic;
  return false;
}

template <int dim>
std::unique_ptr<IncrementLaw<dim>>
make_increment_law(const MaterialParameters &parameters)
{
  for (const auto &law : registered_laws<dim>())
    if (law.name == parameters.law)
      {
        check_constants(parameters);
        return law.make(IsotropicModuli::from_young(parameters.young, parameters.poisson),
                        law.is_plastic
                          ? Hardening{parameters.yield_stress, parameters.hardening_modulus}
                          : Hardening());
      }
  std::string names;
  for (const std::string &name : increment_laws())
    names += (names.empty() ? "" : ", ") + name;
  throw UserError("Materials", "there is no law in increments called '" + parameters.law + "'",
                  "choose one of " + names);
}

template class IncrementLaw<2>;
template class IncrementLaw<3>;
template std::unique_ptr<IncrementLaw<2>> make_increment_law<2>(const MaterialParameters &);
template std::unique_ptr<IncrementLaw<3>> make_increment_law<3>(const MaterialParameters &);
} // namespace scree
