#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/mechanics/kinematics.h>

#include <vector>

namespace scree
{
/** Where a body is at the end of a step, and how it has moved since the start of the run. */
template <int dim>
struct MeanMotion
{
  dealii::Point<dim>     position;     //!< of the centroid at the end of the step
  dealii::Tensor<1, dim> displacement; //!< mean displacement [L]
  dealii::Tensor<1, 3>   rotation;     //!< rotation vector [rad]; 2D: only the last component
};

/**
 * The motions of deformable bodies for the ghosted `u` of a step, entries of rigid ones empty:
 * means over the volume, and the rotation R for which int |x - x_c - R (X - X_c)|^2 is least, with
 * X and x at the start of the run and now. One pass over the cells, one reduction (collective).
 */
template <int dim>
std::vector<MeanMotion<dim>>
mean_motions(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
             const CutQuadrature<dim> &quadrature, const Kinematics<dim> &kinematics,
             const dealii::TrilinosWrappers::MPI::Vector &u);

/** The vector of the rotation next to a matrix M with det M > 0, the R of its polar decomposition.
 */
template <int dim>
dealii::Tensor<1, 3> rotation_vector(const dealii::Tensor<2, dim> &matrix);
} // namespace scree
