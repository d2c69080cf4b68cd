#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace scree
{
/**
 * Sums numbers over all processes with one reduction, however many they are and wherever they are
 * kept. All processes add as many, in the same order:
 *
 *     JointSum sum;
 *     for (auto &row : table)
 *       sum.add(row.force), sum.add(row.area);
 *     sum.reduce(communicator);
 */
class JointSum
{
public:
  void add(double &number)
  {
    places.push_back(&number);
  }

  template <int rank, int dim>
  void add(dealii::Tensor<rank, dim> &tensor)
  {
    for (unsigned int i = 0; i < dim; ++i)
      add(tensor[i]);
  }

  /** Replaces what was added, which must still be where it was, by its sums. Collective. */
  void reduce(const MPI_Comm communicator) const
  {
    std::vector<double> numbers(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      numbers[i] = *places[i];
    dealii::Utilities::MPI::sum(numbers, communicator, numbers);
    for (std::size_t i = 0; i < places.size(); ++i)
      *places[i] = numbers[i];
  }

private:
  std::vector<double *> places;
};
} // namespace scree
