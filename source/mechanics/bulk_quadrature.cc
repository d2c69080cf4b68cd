#include <scree/mechanics/bulk_quadrature.h>

#include <map>

namespace scree
{
template <int dim>
BulkQuadrature<dim>::BulkQuadrature(const DisplacementSpace<dim> &space,
                                    const std::vector<Body<dim>> &bodies)
    : space(space)
    , bodies(bodies)
{
}

template <int dim>
std::vector<PointHistory<dim>>
BulkQuadrature<dim>::histories_of_rules(const std::vector<PointInCell<dim>> &points) const
{
  return histories(points);
}

template <int dim>
void
BulkQuadrature<dim>::tabulate()
{
  std::vector<PointInCell<dim>>                     points;
  std::map<const dealii::Point<dim> *, std::size_t> gradients_of_rule;
  ShapeValues<dim>                                  shape;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim> cell = rule(a);
      first_points.push_back(points.size());
      for (unsigned int q = 0; q < cell.n_points; ++q)
        points.push_back({a, cell.points[q]});
      if (cell.n_points == 0)
        {
          first_gradients.push_back(0);
          continue;
        }
      const auto [place, is_new] = gradients_of_rule.emplace(cell.points, all_gradients.size());
      first_gradients.push_back(place->second);
      for (unsigned int q = 0; q < cell.n_points && is_new; ++q)
        {
          space.basis.evaluate_gradients(cell.points[q], shape);
          for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              all_gradients.push_back(shape.gradient[i][d]);
        }
    }
  const auto of_points = histories_of_rules(points);
  all_starts.reserve(points.size());
  all_volume_ratios.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto &body = bodies[space.cells()[points[i].active_cell].body];
      all_starts.push_back(body.law->start(of_points[i]));
      all_volume_ratios.push_back(determinant(of_points[i].deformation_gradient));
    }
}

template class BulkQuadrature<2>;
template class BulkQuadrature<3>;
} // namespace scree
