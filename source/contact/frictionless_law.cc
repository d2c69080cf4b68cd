#include <scree/contact/frictionless_law.h>

namespace scree
{
ContactLaw
frictionless_law()
{
  ContactLaw law;
  law.name = "frictionless";
  return law;
}
} // namespace scree
