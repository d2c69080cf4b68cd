#include <scree/mechanics/point_neighbours.h>
#include <scree/points/migration.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace scree
{
template <int dim>
MaterialPoints<dim>
with_neighbours(const DisplacementSpace<dim> &space, const double support,
                const MaterialPoints<dim> &points)
{
  MaterialPoints<dim> cloud = points;
  const MPI_Comm      comm  = space.grid.communicator();
  if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
    return cloud;
  // A radius that has grown six times by 1.25 is 3.8 times the first one.
  double largest_size = 0.;
  for (const ActiveCell &cell : space.cells())
    largest_size = std::max(largest_size, space.grid.cells()[cell.grid_cell].size);
  for (std::size_t p = 0; p < points.size(); ++p)
    largest_size = std::max(largest_size, points.spacing(p));
  const double reach  = 4. * support * dealii::Utilities::MPI::max(largest_size, comm);
  const auto   others = neighbours_from_others<dim>(
    points,
    [&](const dealii::Point<dim> &x) {
      // The processes of a lattice of probes as fine as the cells are.
      const int              n = static_cast<int>(std::ceil(reach / space.grid.finest_size()));
      std::set<unsigned int> ranks;
      const int              stride = std::max(1, n / 4);
      for (int i = -n; i <= n; i += stride)
        for (int j = -n; j <= n; j += stride)
          for (int k = dim == 3 ? -n : 0; k <= (dim == 3 ? n : 0); k += stride)
            {
              dealii::Point<dim> probe = x;
              probe[0] += i * space.grid.finest_size();
              probe[1] += j * space.grid.finest_size();
              probe[dim - 1] += dim == 3 ? k * space.grid.finest_size() : 0.;
              ranks.insert(space.grid.locate(probe).rank);
            }
      return std::vector<unsigned int>(ranks.begin(), ranks.end());
    },
    comm);
  for (std::size_t i = 0; i < others.size(); ++i)
    cloud.add_copy(others, i);
  return cloud;
}

template MaterialPoints<2> with_neighbours(const DisplacementSpace<2> &, const double,
                                           const MaterialPoints<2> &);
template MaterialPoints<3> with_neighbours(const DisplacementSpace<3> &, const double,
                                           const MaterialPoints<3> &);
} // namespace scree
