#include <scree/contact/contact_parameters.h>
#include <scree/contact/coulomb_law.h>

#include <cmath>

namespace scree
{
namespace
{
void
coulomb_bound(const ContactPairParameters            &parameters,
              const dealii::ArrayView<const double>  &pressures,
              const dealii::ArrayView<FrictionBound> &bounds)
{
  const double mu = parameters.friction_coefficient;
  for (std::size_t i = 0; i < pressures.size(); ++i)
    bounds[i] = {mu * pressures[i], mu};
}

void
declare_coulomb(ContactPairParameters &parameters, const ParameterSection &section,
                const bool is_chosen)
{
  section.entry("Friction coefficient", parameters.friction_coefficient,
                dealii::Patterns::Double(0.), "Coulomb's mu; no dimension.");
  if (is_chosen && std::isnan(parameters.friction_coefficient))
    section.error("Friction coefficient", "the law coulomb needs a friction coefficient",
                  "set Friction coefficient, or Law = frictionless");
}
} // namespace

ContactLaw
coulomb_law()
{
  ContactLaw law;
  law.name        = "coulomb";
  law.description = "friction";
  law.bound       = coulomb_bound;
  law.entries     = {"Friction coefficient"};
  law.declare     = declare_coulomb;
  return law;
}
} // namespace scree
