#include <scree/contact/contact_cells.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <utility>

namespace scree
{
template <int dim>
std::vector<bool>
cells_around(const std::vector<bool> &marked, const ContactPoints<dim> &contact,
             const BackgroundGrid<dim> &grid, const double reach)
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
  // Places in the cube, at most a cell apart.
  const unsigned int                  n_1d = 1 + static_cast<unsigned int>(std::ceil(2. * reach));
  std::vector<dealii::Tensor<1, dim>> places(1);
  for (unsigned int d = 0; d < dim; ++d)
    {
      std::vector<dealii::Tensor<1, dim>> more;
      for (dealii::Tensor<1, dim> place : places)
        for (unsigned int i = 0; i < n_1d; ++i)
          {
            place[d] = reach * (2. * i / (n_1d - 1) - 1.);
            more.push_back(place);
          }
      places = std::move(more);
    }
  std::vector<bool>  result(grid.n_owned_cells(), false);
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(grid.communicator(), own))
    for (const auto &point : of_rank)
      for (const dealii::Tensor<1, dim> &place : places)
        {
          dealii::Point<dim> position;
          for (unsigned int d = 0; d < dim; ++d)
            position[d] = point[d] + place[d] * point[dim];
          const auto location = grid.locate(position);
          if (location.rank == rank)
            result[location.local_cell] = true;
        }
  return result;
}

template std::vector<bool> cells_around(const std::vector<bool> &, const ContactPoints<2> &,
                                        const BackgroundGrid<2> &, const double);
template std::vector<bool> cells_around(const std::vector<bool> &, const ContactPoints<3> &,
                                        const BackgroundGrid<3> &, const double);
} // namespace scree
