#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** A pressure p(X, t), t = -p n; on a moving geometry it follows the surface, -p J_D F_D^{-T} n. */
template <int dim>
ConditionKind<dim> pressure_condition();
} // namespace scree
