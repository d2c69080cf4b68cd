#pragma once

#include <scree/contact/contact_law.h>

namespace scree
{
/** Coulomb's friction, b(p) = mu p. */
ContactLaw coulomb_law();
} // namespace scree
