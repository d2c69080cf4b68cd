#pragma once

#include <scree/bodies/condition_kind.h>

namespace scree
{
/** A traction vector t(X, t), force per area of the undeformed surface. */
template <int dim>
ConditionKind<dim> traction_condition();
} // namespace scree
