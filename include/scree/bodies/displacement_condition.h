#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** Displacement components, u_i = value_i(X, t): on box faces exactly, else by Nitsche or penalty.
 */
template <int dim>
ConditionKind<dim> displacement_condition();
} // namespace scree
