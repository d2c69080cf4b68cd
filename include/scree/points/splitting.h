#pragma once

#include <scree/points/material_points.h>
#include <scree/points/moving_least_squares.h>

#include <functional>

namespace scree
{
/** The cloud of the points as they are now, for transfers from them. */
template <int dim>
MovingLeastSquares<dim> moving_least_squares(const MaterialPoints<dim>       &points,
                                             const MovingLeastSquaresOptions &options);

/** How many points were divided, and what their states came from. */
struct SplittingReport
{
  std::size_t              n_split = 0;
  MovingLeastSquaresReport transfer;
};

/**
 * Divides the points that are too far apart for the grid: those whose spacing exceeds
 * `cell_size / n_per_direction`, cell_size [L] being the edge of the cell around each point. A
 * point makes 2^dim at x + F dX, X + dX, with dX half-way to the corners of the cube of its volume,
 * of equal shares of mass and initial volume; F, stress and internal variables by moving least
 * squares from all old points, velocity too, but corrected so that the momentum is kept. Repeats
 * until no process has a point left to divide; the children of a point take its cell size.
 *
 * @param with_neighbours the old points, then those of other processes near them; called by all
 *                        processes at once
 */
template <int dim>
SplittingReport
split_points(MaterialPoints<dim> &points, const std::vector<double> &cell_size,
             const unsigned int n_per_direction, const MovingLeastSquaresOptions &options,
             const std::function<MaterialPoints<dim>(const MaterialPoints<dim> &)> &with_neighbours,
             const MPI_Comm                                                         comm);
} // namespace scree
