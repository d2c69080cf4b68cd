#pragma once

#include <deal.II/base/mpi.h>

#include <type_traits>
#include <vector>

namespace scree
{
/** The arrays of all processes by rank, on the first one; elsewhere nothing. Collective. */
template <typename T>
std::vector<std::vector<T>>
gather_arrays(const std::vector<T> &own, const MPI_Comm communicator)
{
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr int     tag   = 1;
  const std::size_t size  = own.size();
  const auto        sizes = dealii::Utilities::MPI::gather(communicator, size);
  MPI_Datatype      type;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  std::vector<std::vector<T>> result(sizes.size());
  if (dealii::Utilities::MPI::this_mpi_process(communicator) > 0)
    MPI_Send(own.data(), size, type, 0, tag, communicator);
  else
    for (unsigned int p = 0; p < sizes.size(); ++p)
      if (p == 0)
        result[p] = own;
      else
        {
          result[p].resize(sizes[p]);
          MPI_Recv(result[p].data(), sizes[p], type, p, tag, communicator, MPI_STATUS_IGNORE);
        }
  MPI_Type_free(&type);
  return result;
}

/** The same in one array. */
template <typename T>
std::vector<T>
gather_joined(const std::vector<T> &own, const MPI_Comm communicator)
{
  std::vector<T> result;
  for (const auto &of_process : gather_arrays(own, communicator))
    result.insert(result.end(), of_process.begin(), of_process.end());
  return result;
}
} // namespace scree
