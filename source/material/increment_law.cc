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
elastic(const IsotropicModuli &moduli, const Hardening &)
{
  return std::make_unique<IncrementLawOf<dim, Law>>(Law(moduli));
}

/** Also for laws that are elastic because the yield stress is infinite. */
template <int dim, class Law>
std::unique_ptr<IncrementLaw<dim>>
plastic(const IsotropicModuli &moduli, const Hardening &hardening)
{
  return std::make_unique<IncrementLawOf<dim, Law>>(Law(moduli, hardening));
}

/** All laws: a new one is registered by one line here. */
template <int dim>
const std::vector<Registration<dim>> &
registered_laws()
{
  static const std::vector<Registration<dim>> laws = {
    {"linear elastic", false, plastic<dim, SmallStrain>},
    {"linear elastic rotated", false, plastic<dim, SmallStrainRotated>},
    {"Hencky", false, elastic<dim, Hencky>},
    {"neo-Hookean", false, elastic<dim, NeoHookean>},
    {"Saint Venant-Kirchhoff", false, elastic<dim, SaintVenantKirchhoff>},
    {"J2 small strain", true, plastic<dim, SmallStrain>},
    {"J2 small strain rotated", true, plastic<dim, SmallStrainRotated>},
    {"J2", true, plastic<dim, HenckyPlasticity>},
  };
  return laws;
}

Hardening
checked_hardening(const MaterialParameters &parameters, const bool is_plastic)
{
  const std::string where = "Materials";
  if (!is_plastic)
    {
      require(std::isnan(parameters.yield_stress) && std::isnan(parameters.hardening_modulus),
              where,
              "the law '" + parameters.law + "' has no yield stress and no hardening modulus",
              "remove them or choose a law called J2");
      return {};
    }
  // The negated comparisons of require() are also true for NaN.
  require(parameters.yield_stress > 0, where, "Yield stress must be set to a number greater than 0",
          "give it in force per area");
  require(parameters.hardening_modulus >= 0, where,
          "Hardening modulus must be set to a number that is not negative",
          "give it in force per area, 0 for perfect plasticity");
  return {parameters.yield_stress, parameters.hardening_modulus};
}
} // namespace

template <int dim>
IncrementStart
IncrementLaw<dim>::start(const PointHistory<dim> &history) const
{
  IncrementStart result;
  result.alpha                   = std::max(0., history.alpha);
  const Tensor<2, 3> internal    = Tensor<2, 3>(history.internal);
  const Tensor<2, 3> deformation = embed<dim>(history.deformation_gradient);
  switch (this->internal())
    {
    case InternalTensor::none:
      result.tensor       = deformation * transpose(deformation);
      result.volume_ratio = determinant(deformation);
      break;
    case InternalTensor::logarithmic_strain:
      result.tensor       = exponential(internal);
      result.volume_ratio = determinant(deformation);
      break;
    case InternalTensor::cauchy_stress:
      result.tensor = internal;
      break;
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

template <int dim>
std::unique_ptr<IncrementLaw<dim>>
make_increment_law(const MaterialParameters &parameters)
{
  for (const auto &law : registered_laws<dim>())
    if (law.name == parameters.law)
      {
        check_elastic_constants(parameters);
        return law.make(IsotropicModuli::from_young(parameters.young, parameters.poisson),
                        checked_hardening(parameters, law.is_plastic));
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
