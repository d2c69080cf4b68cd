#pragma once

#include <scree/contact/contact_law.h>

namespace scree
{
/** What touches at the start is glued: any p, and b infinite. */
ContactLaw tied_law();
} // namespace scree
