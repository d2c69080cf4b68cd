#include <scree/base/joint_sum.h>
#include <scree/mechanics/resultant.h>

namespace scree
{
template <int dim>
void
sum_over_processes(std::vector<Resultant<dim>> &resultants, const MPI_Comm communicator)
{
  JointSum sum;
  for (auto &resultant : resultants)
    {
      sum.add(resultant.force);
      sum.add(resultant.moment);
    }
  sum.reduce(communicator);
}

template <int dim>
dealii::Tensor<1, 3>
moment_of(const dealii::Tensor<1, dim> &position, const dealii::Tensor<1, dim> &force)
{
  return moment_of<dim>(outer_product(force, position));
}

template <int dim>
dealii::Tensor<1, 3>
moment_of(const dealii::Tensor<2, dim> &virial)
{
  dealii::Tensor<1, 3> moment;
  moment[2] = virial[1][0] - virial[0][1];
  if (dim == 3)
    {
      moment[0] = virial[dim - 1][1] - virial[1][dim - 1];
      moment[1] = virial[0][dim - 1] - virial[dim - 1][0];
    }
  return moment;
}

template void                 sum_over_processes(std::vector<Resultant<2>> &, const MPI_Comm);
template void                 sum_over_processes(std::vector<Resultant<3>> &, const MPI_Comm);
template dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 2> &, const dealii::Tensor<1, 2> &);
template dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 3> &, const dealii::Tensor<1, 3> &);
template dealii::Tensor<1, 3> moment_of(const dealii::Tensor<2, 2> &);
template dealii::Tensor<1, 3> moment_of(const dealii::Tensor<2, 3> &);
} // namespace scree
