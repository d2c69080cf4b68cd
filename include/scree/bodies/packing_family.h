#pragma once

#include <scree/bodies/body_family.h>

namespace scree
{
/** A random packing of convex shapes in a box or a cylinder: pack_at_random(). */
template <int dim>
FamilyKind<dim> packing_family();
} // namespace scree
