#pragma once

#include <scree/points/material_points.h>

#include <functional>

namespace scree
{
/**
 * Sends every point with all it carries to the process that `owner(position)` names, collectively.
 * Those that stay keep their order; those that arrive follow by rank of the sender, in its order.
 * Returns how many points of all processes moved.
 */
template <int dim>
std::uint64_t send_to_owners(MaterialPoints<dim>                                           &points,
                             const std::function<unsigned int(const dealii::Point<dim> &)> &owner,
                             const MPI_Comm                                                 comm);

/**
 * Copies of the points of other processes that this one needs as neighbours of its targets,
 * collectively: `takers(position)` names the processes that want a point; the own one is skipped.
 * They come by rank of the sender, in its order.
 */
template <int dim>
MaterialPoints<dim> neighbours_from_others(
  const MaterialPoints<dim>                                                  &points,
  const std::function<std::vector<unsigned int>(const dealii::Point<dim> &)> &takers,
  const MPI_Comm                                                              comm);
} // namespace scree
