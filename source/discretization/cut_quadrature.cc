#include <scree/discretization/cut_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace scree
{
namespace
{
/**
 * From a point of the cut to the boundary along the gradient, to first order; within half a cell.
 * Of the nearest piece if the shape has several: the interpolant is rough beside kinks.
 */
template <int dim>
double
distance_to_contour(const Body<dim> &body, const GridCell<dim> &cell,
                    const dealii::Point<dim> &unit_point)
{
  const dealii::Point<dim> x        = cell.lower + cell.size * dealii::Tensor<1, dim>(unit_point);
  double                   distance = 0.5 * cell.size;
  const auto               take_nearer = [&](const std::pair<double, dealii::Tensor<1, dim>> &phi) {
    const double found = -phi.first / phi.second.norm();
    if (std::abs(found) < std::abs(distance))
      distance = found;
  };
  std::vector<SmoothPiece<dim>> pieces;
  if (body.shape && !body.shape->is_smooth())
    {
      const dealii::Point<dim> X = initial_position(body, x);
      dealii::BoundingBox<dim> near({X, X});
      near.extend(0.5 * cell.size);
      body.shape->append_pieces(near, pieces);
    }
  for (const auto &piece : pieces)
    take_nearer(value_and_gradient(body, piece, x));
  if (pieces.empty())
    take_nearer(body.level_set.value_and_gradient(x, 3));
  return std::abs(distance) < 0.5 * cell.size ? distance : 0.;
}
} // namespace

template <int dim>
CutQuadrature<dim>::CutQuadrature(const DisplacementSpace<dim> &space,
                                  const LevelSetNodes<dim>     &level_set_nodes,
                                  const std::vector<Body<dim>> &bodies)
{
  CutCellRules<dim>         rules = level_set_nodes.rules();
  const dealii::QGauss<dim> gauss(rules.gauss.bulk);
  whole_cell.points  = gauss.get_points();
  whole_cell.weights = gauss.get_weights();
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      if (!cell.is_cut)
        {
          bulk.append({});
          surface.append({});
          continue;
        }
      const auto &geometry = space.grid.cells()[cell.grid_cell];
      const auto  cut      = level_set_nodes.cut(cell.grid_cell, bodies[cell.body]);
      const auto  points   = rules.rules(cut, geometry.size);
      bulk.append(points.inside);
      surface.append(points.surface);
      for (const auto &point : points.surface.points)
        strip_widths.push_back(
          cut.parts.empty() ? distance_to_contour(bodies[cell.body], geometry, point) : 0.);
    }
}

template class CutQuadrature<2>;
template class CutQuadrature<3>;
} // namespace scree
