#include <scree/contact/contact_cells.h>

#include <deal.II/base/mpi.h>

#include <array>

namespace scree
{
template <int dim>
std::vector<bool>
cells_around(const std::vector<bool> &marked, const ContactPoints<dim> &contact,
             const BackgroundGrid<dim> &grid)
{
  std::vector<std::array<double, dim + 1>> own; // place and cell size
  for (unsigned int i = 0; i < marked.size(); ++i)
    if (marked[i])
      {
        const ContactPoint<dim> &point = contact.points()[i];
        own.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          own.back()[d] = point.position[d];
        own.back()[dim] = point.cell_size;
      }
  std::vector<bool>  result(grid.n_owned_cells(), false);
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(grid.communicator(), own))
    for (const auto &point : of_rank)
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          dealii::Point<dim> position;
          for (unsigned int d = 0; d < dim; ++d)
            position[d] = point[d] + ((corner >> d) & 1u ? 0.5 : -0.5) * point[dim];
          const auto location = grid.locate(position);
          if (location.rank == rank)
            result[location.local_cell] = true;
        }
  return result;
}

template std::vector<bool> cells_around(const std::vector<bool> &, const ContactPoints<2> &,
                                        const BackgroundGrid<2> &);
template std::vector<bool> cells_around(const std::vector<bool> &, const ContactPoints<3> &,
                                        const BackgroundGrid<3> &);
} // namespace scree
