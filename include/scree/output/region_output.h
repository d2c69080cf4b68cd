#pragma once

#include <scree/mechanics/boundary_regions.h>

#include <string>

namespace scree
{
/**
 * Writes DIR/regions.csv with the points at which integral boundary conditions act: body,
 * condition, position, length or area. Collective.
 */
template <int dim>
void write_regions_csv(const std::vector<BoundaryRegion<dim>> &regions,
                       const std::vector<Body<dim>> &bodies, const MPI_Comm communicator,
                       const std::string &directory);
} // namespace scree
