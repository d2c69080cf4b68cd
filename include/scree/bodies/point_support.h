#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** Displacement components of the grid vertex at a point of a body clipped by the box. */
template <int dim>
ConditionKind<dim> point_support();
} // namespace scree
