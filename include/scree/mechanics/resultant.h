#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
/**
 * Resultant on the body of one condition: force, and moment about the origin. Of the conditions of
 * an Equilibrium also what these move.
 */
template <int dim>
struct Resultant
{
  dealii::Tensor<1, dim> force;
  dealii::Tensor<1, 3>   moment;       //!< 2D: only the last component
  dealii::Tensor<1, dim> displacement; //!< mean over the region since the start of the run [L]
};

/** Sums resultants over all processes with one reduction. Collective. */
template <int dim>
void sum_over_processes(std::vector<Resultant<dim>> &resultants, const MPI_Comm communicator);

/** Moment of a force at a position about the origin. */
template <int dim>
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, dim> &position,
                               const dealii::Tensor<1, dim> &force);

/** Moment about the origin of forces f at places x with the sum f x^T. */
template <int dim>
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<2, dim> &virial);
} // namespace scree
