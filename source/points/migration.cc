#include <scree/points/migration.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace scree
{
using namespace dealii;

namespace
{
/** Sends messages of packed points to their processes and adds what arrives to `points`. */
template <int dim>
void
exchange(const std::map<unsigned int, std::vector<double>> &messages, MaterialPoints<dim> &points,
         const MPI_Comm comm)
{
  for (const auto &[rank, message] : Utilities::MPI::some_to_some(comm, messages))
    for (std::size_t first = 0; first < message.size(); first += points.n_values())
      points.unpack(message.data() + first);
}
} // namespace

template <int dim>
std::uint64_t
send_to_owners(MaterialPoints<dim>                                   &points,
               const std::function<unsigned int(const Point<dim> &)> &owner, const MPI_Comm comm)
{
  const unsigned int me = Utilities::MPI::this_mpi_process(comm);

  std::map<unsigned int, std::vector<double>> messages;
  std::vector<bool>                           stays(points.size());
  std::uint64_t                               n_sent = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const unsigned int rank = owner(points.position[i]);
      AssertIndexRange(rank, Utilities::MPI::n_mpi_processes(comm));
      stays[i] = rank == me;
      if (stays[i])
        continue;
      points.pack(i, messages[rank]);
      ++n_sent;
    }
  points.keep(stays);
  exchange(messages, points, comm);
  return Utilities::MPI::sum(n_sent, comm);
}

template <int dim>
MaterialPoints<dim>
neighbours_from_others(const MaterialPoints<dim>                                          &points,
                       const std::function<std::vector<unsigned int>(const Point<dim> &)> &takers,
                       const MPI_Comm                                                      comm)
{
  const unsigned int me = Utilities::MPI::this_mpi_process(comm);

  std::map<unsigned int, std::vector<double>> messages;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const unsigned int rank : takers(points.position[i]))
      if (rank != me)
        points.pack(i, messages[rank]);
  MaterialPoints<dim> result(points.n_internal());
  exchange(messages, result, comm);
  return result;
}

template std::uint64_t send_to_owners(MaterialPoints<2> &,
                                      const std::function<unsigned int(const Point<2> &)> &,
                                      const MPI_Comm);
template std::uint64_t send_to_owners(MaterialPoints<3> &,
                                      const std::function<unsigned int(const Point<3> &)> &,
                                      const MPI_Comm);
template MaterialPoints<2>
neighbours_from_others(const MaterialPoints<2> &,
                       const std::function<std::vector<unsigned int>(const Point<2> &)> &,
                       const MPI_Comm);
template MaterialPoints<3>
neighbours_from_others(const MaterialPoints<3> &,
                       const std::function<std::vector<unsigned int>(const Point<3> &)> &,
                       const MPI_Comm);
} // namespace scree
