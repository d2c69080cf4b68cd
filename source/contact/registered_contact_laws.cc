#include <scree/contact/coulomb_law.h>
#include <scree/contact/frictionless_law.h>
#include <scree/contact/no_contact.h>
#include <scree/contact/stick_law.h>
#include <scree/contact/tied_law.h>

#include <deal.II/base/exceptions.h>

namespace scree
{
const std::vector<ContactLaw> &
registered_contact_laws()
{
  static const std::vector<ContactLaw> laws
    = {no_contact(), frictionless_law(), coulomb_law(), stick_law(), tied_law()};
  return laws;
}

const ContactLaw &
contact_law(const std::string &name)
{
  for (const ContactLaw &law : registered_contact_laws())
    if (law.name == name)
      return law;
  AssertThrow(false, dealii::ExcMessage("There is no contact law '" + name + "'."));
}
} // namespace scree
