#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace scree
{
/**
 * What inertia adds to the equations of a step, whatever the scheme that integrates them in time:
 * with accelerations that are linear in the unknowns, M a = c M u - h. Equations without inertia
 * have c = 0.
 */
struct Inertia
{
  double factor = 0.; //!< c [1/time^2]; 0: the rest is not looked at

  /** M [mass], distributed as the unknowns, its entries among those of the tangent. */
  std::shared_ptr<const dealii::TrilinosWrappers::SparseMatrix> mass;

  dealii::TrilinosWrappers::MPI::Vector forces; //!< h, without ghosts [force]
};
} // namespace scree
