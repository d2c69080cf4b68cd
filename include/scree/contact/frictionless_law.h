#pragma once

#include <scree/contact/contact_law.h>

namespace scree
{
/** Pressure only. */
ContactLaw frictionless_law();
} // namespace scree
