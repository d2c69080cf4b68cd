#pragma once

#include <scree/bodies/body_family.h>

namespace scree
{
/** Copies of the shape of the section on a lattice, numbered along x first, from 1. */
template <int dim>
FamilyKind<dim> array_family();
} // namespace scree
