#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** The mean of displacement components or of the rotation over a region, by multipliers. */
template <int dim>
ConditionKind<dim> mean_support();
} // namespace scree
