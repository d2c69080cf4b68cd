#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** Springs to the ground, t_i = -k_i(X) u_i with k_i >= 0. */
template <int dim>
ConditionKind<dim> spring_condition();
} // namespace scree
