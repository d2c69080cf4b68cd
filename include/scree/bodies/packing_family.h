#pragma once

#include <scree/bodies/body_family.h>

namespace scree
{
/** A random packing of discs or balls in a box: pack_balls(). */
template <int dim>
FamilyKind<dim> packing_family();
} // namespace scree
