#include <scree/mechanics/material_point_quadrature.h>
#include <scree/mechanics/material_update.h>

#include <algorithm>
#include <numeric>

namespace scree
{
template <int dim>
MaterialPointQuadrature<dim>::MaterialPointQuadrature(const DisplacementSpace<dim> &space,
                                                      const std::vector<Body<dim>> &bodies,
                                                      const StepStart<dim>         &start)
    : BulkQuadrature<dim>(space, bodies)
    , start(start)
    , begin(space.n_owned_cells() + 1, 0)
{
  const auto &located = start.material_points();
  for (std::size_t p = 0; p < located.size(); ++p)
    if (located[p].active_cell < space.n_owned_cells())
      {
        points.push_back(p);
        ++begin[located[p].active_cell + 1];
      }
  std::stable_sort(points.begin(), points.end(), [&](const std::size_t p, const std::size_t q) {
    return located[p].active_cell < located[q].active_cell;
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (const std::size_t p : points)
    {
      places.push_back(located[p].unit_point);
      volumes.push_back(start.points().volume(p));
    }
  this->tabulate();
}

template <int dim>
CellRule<dim>
MaterialPointQuadrature<dim>::rule(const unsigned int active_cell) const
{
  const std::size_t first = begin[active_cell];
  return {places.data() + first, volumes.data() + first,
          static_cast<unsigned int>(begin[active_cell + 1] - first), 1.};
}

template <int dim>
std::vector<PointHistory<dim>>
MaterialPointQuadrature<dim>::histories(const std::vector<PointInCell<dim>> &of_points) const
{
  return start.histories(of_points);
}

template <int dim>
std::vector<PointHistory<dim>>
MaterialPointQuadrature<dim>::histories_of_rules(const std::vector<PointInCell<dim>> &) const
{
  std::vector<PointHistory<dim>> result;
  result.reserve(points.size());
  for (const std::size_t p : points)
    result.push_back(start.carried_history(p));
  return result;
}

template <int dim>
MaterialPoints<dim>
MaterialPointQuadrature<dim>::moved(const MaterialPoints<dim>  &before,
                                    const IncrementalBulk<dim> &bulk,
                                    const PointEvaluator<dim>  &u) const
{
  std::vector<PointHistory<dim>> histories;
  for (std::size_t p = 0; p < before.size(); ++p)
    histories.push_back(start.carried_history(p));
  return moved_points<dim>(before, start.material_points(), histories, this->bodies, bulk, u, true);
}

template class MaterialPointQuadrature<2>;
template class MaterialPointQuadrature<3>;
} // namespace scree
