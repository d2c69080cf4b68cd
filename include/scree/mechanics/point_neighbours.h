#pragma once

#include <scree/discretization/displacement_space.h>
#include <scree/points/material_points.h>

namespace scree
{
/**
 * These points of the own process, then copies of those of others that a least squares fit with the
 * relative radius `support` at a place of the own cells may need (collective).
 */
template <int dim>
MaterialPoints<dim> with_neighbours(const DisplacementSpace<dim> &space, const double support,
                                    const MaterialPoints<dim> &points);
} // namespace scree
