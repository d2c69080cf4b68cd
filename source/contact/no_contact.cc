#include <scree/contact/no_contact.h>

namespace scree
{
ContactLaw
no_contact()
{
  ContactLaw law;
  law.name = "none";
  law.acts = false;
  return law;
}
} // namespace scree
