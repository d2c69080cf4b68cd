#pragma once

#include <scree/contact/contact_law.h>

namespace scree
{
/** Bodies pass through each other. */
ContactLaw no_contact();
} // namespace scree
