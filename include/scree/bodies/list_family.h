#pragma once

#include <scree/bodies/body_family.h>

namespace scree
{
/**
 * A body for each row of a table (CSV). Columns are entries of section Shape, numbers of
 * coordinates in columns of their own, as "Centre x", and Name and Material.
 */
template <int dim>
FamilyKind<dim> list_family();
} // namespace scree
