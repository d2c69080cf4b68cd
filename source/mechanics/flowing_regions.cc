#include <scree/mechanics/boundary_coverage.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/flowing_regions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
template <int dim>
void
release_edges(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
              const std::vector<Body<dim>> &bodies, const Kinematics<dim> &kinematics,
              std::vector<BoundaryRegion<dim>> &regions)
{
  constexpr double largest = 0.5; // plastic strain beyond the elastic
  const auto       flows   = [&](const BoundaryPoint<dim> &point) {
    return kinematics.bulk().secant_ratio(point.active_cell) < largest;
  };
  std::vector<unsigned int> is_found(regions.size());
  for (unsigned int r = 0; r < regions.size(); ++r)
    {
      const bool has_edges = regions[r].condition->parameters.where != "1";
      is_found[r]          = is_nitsche(regions[r]) && has_edges
                    && std::any_of(regions[r].points.begin(), regions[r].points.end(), flows);
    }
  dealii::Utilities::MPI::max(is_found, space.grid.communicator(), is_found);
  // The first region of each body at once, then the second ones: bodies share no cells.
  std::vector<std::vector<unsigned int>> rounds;
  std::vector<unsigned int>              n_of_body(bodies.size());
  for (unsigned int r = 0; r < regions.size(); ++r)
    if (is_found[r])
      {
        const unsigned int round = n_of_body[regions[r].body]++;
        rounds.resize(std::max<std::size_t>(rounds.size(), round + 1));
        rounds[round].push_back(r);
      }
  for (const auto &round : rounds)
    {
      std::vector<double> covered(space.n_owned_cells(), 0.);
      for (const unsigned int r : round)
        set_coverage(space, level_set_nodes, bodies[regions[r].body], regions[r], kinematics,
                     covered);
      const auto is_outer = outer_edge(space, covered);
      for (const unsigned int r : round)
        {
          auto &points = regions[r].points;
          points.erase(std::remove_if(points.begin(), points.end(),
                                      [&](const BoundaryPoint<dim> &point) {
                                        return is_outer[point.active_cell] && flows(point);
                                      }),
                       points.end());
        }
    }
}

template <int dim>
void
forgive_flow(const Kinematics<dim> &kinematics, std::vector<BoundaryRegion<dim>> &regions)
{
  for (auto &region : regions)
    {
      const auto &condition = *region.condition;
      if (!is_nitsche(region))
        continue;
      for (auto &point : region.points)
        if (const double ratio = kinematics.bulk().secant_ratio(point.active_cell); ratio < 1.)
          for (unsigned int k = 0; k < condition.components.size(); ++k)
            {
              double &u_n = point.start_displacement[condition.components[k]];
              u_n
                += (1. - ratio)
                   * (condition.value(k, point.reference_position, kinematics.start_time()) - u_n);
            }
    }
}

#define SCREE_INSTANTIATE(dim)                                                            \
  template void release_edges(const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, \
                              const std::vector<Body<dim>> &, const Kinematics<dim> &,    \
                              std::vector<BoundaryRegion<dim>> &);                        \
  template void forgive_flow(const Kinematics<dim> &, std::vector<BoundaryRegion<dim>> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
