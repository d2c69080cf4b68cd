#pragma once

#include <scree/contact/contact_law.h>

namespace scree
{
/** No sliding under pressure: b(p) is infinite for p > 0. */
ContactLaw stick_law();
} // namespace scree
