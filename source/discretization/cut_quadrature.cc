#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/polytope_rules.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace scree
{
/** phi/h on the unit cell, with the derivatives that the generator needs for its bounds. */
template <int dim>
class CutCellRules<dim>::CellLevelSet : public dealii::Function<dim>
{
public:
  explicit CellLevelSet(const LagrangeBasis<dim> &basis)
      : basis(basis)
  {
  }

  double value(const dealii::Point<dim> &point, const unsigned int = 0) const override
  {
    double shape[max_nodes_per_cell<dim>], sum = 0.;
    basis.evaluate_values(point, shape);
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      sum += shape[i] * nodal[i];
    return sum;
  }

  dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &point,
                                  const unsigned int = 0) const override
  {
    basis.evaluate(point, shape);
    dealii::Tensor<1, dim> sum;
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      sum += nodal[i] * shape.gradient[i];
    return sum;
  }

  dealii::SymmetricTensor<2, dim> hessian(const dealii::Point<dim> &point,
                                          const unsigned int = 0) const override
  {
    basis.evaluate(point, shape);
    dealii::SymmetricTensor<2, dim> sum;
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      sum += nodal[i] * shape.hessian[i];
    return sum;
  }

  const double *nodal = nullptr;

private:
  LagrangeBasis<dim>       basis;
  mutable ShapeValues<dim> shape;
};

template <int dim>
CutCellRules<dim>::CutCellRules(const LagrangeBasis<dim> &basis)
    : degree(basis.degree)
    , level_set(std::make_unique<CellLevelSet>(basis))
    , gauss(dealii::QGauss<1>(basis.degree + 1))
    , generator(gauss)
    , face_generator(std::make_unique<dealii::NonMatching::FaceQuadratureGenerator<dim>>(gauss))
{
}

template <int dim>
CutCellRules<dim>::~CutCellRules() = default;

template <int dim>
typename CutCellRules<dim>::Rules
CutCellRules<dim>::rules(const double *scaled, const double cell_size)
{
  level_set->nodal = scaled;
  generator.generate(*level_set, dealii::create_unit_bounding_box<dim>());
  const double volume = std::pow(cell_size, dim), area = std::pow(cell_size, dim - 1);
  Rules        result;
  const auto  &inside = generator.get_inside_quadrature();
  for (unsigned int q = 0; q < inside.size(); ++q)
    {
      result.inside.points.push_back(inside.point(q));
      result.inside.weights.push_back(inside.weight(q) * volume);
    }
  const auto &surface = generator.get_surface_quadrature();
  for (unsigned int q = 0; q < surface.size(); ++q)
    {
      result.surface.points.push_back(surface.point(q));
      result.surface.weights.push_back(surface.weight(q) * area);
      result.surface.normals.push_back(surface.normal_vector(q));
    }
  return result;
}

template <int dim>
typename CutCellRules<dim>::Rules
CutCellRules<dim>::rules(const CellCut<dim> &cut, const double cell_size)
{
  if (cut.parts.empty())
    return rules(cut.scaled.data(), cell_size);
  Rules result;
  for (const auto &part : cut.parts)
    {
      append_rule(part, degree, cell_size, result.inside);
      for (const auto &facet : part.facets)
        if (facet.is_surface())
          append_rule(facet, facet.normal, degree, cell_size, result.surface);
    }
  return result;
}

template <int dim>
CellPoints<dim>
CutCellRules<dim>::face_rule(const CellCut<dim> &cut, const double cell_size,
                             const unsigned int face)
{
  const double sign = face % 2 == 0 ? -1. : 1.;
  if (cut.location == CellLocation::cut && cut.parts.empty())
    return face_rule(cut.scaled.data(), cell_size, face);
  CellPoints<dim> result;
  const auto      append = [&](const Polytope<dim> &part) {
    for (const auto &facet : part.facets)
      if (facet.face == int(face))
        append_rule(facet, sign * dealii::Point<dim>::unit_vector(face / 2), degree, cell_size,
                         result);
  };
  if (cut.location == CellLocation::inside)
    append(Polytope<dim>::unit_cell());
  for (const auto &part : cut.parts)
    append(part);
  return result;
}

template <int dim>
CellPoints<dim>
CutCellRules<dim>::face_rule(const double *scaled, const double cell_size, const unsigned int face)
{
  level_set->nodal = scaled;
  face_generator->generate(*level_set, dealii::create_unit_bounding_box<dim>(), face);
  const double       area      = std::pow(cell_size, dim - 1);
  const auto        &inside    = face_generator->get_inside_quadrature();
  const unsigned int direction = face / 2;
  CellPoints<dim>    result;
  for (unsigned int q = 0; q < inside.size(); ++q)
    {
      // deal.II orders the coordinates of a face cyclically after its normal direction.
      dealii::Point<dim> point;
      point[direction] = face % 2;
      for (unsigned int d = 0; d < dim - 1; ++d)
        point[(direction + 1 + d) % dim] = inside.point(q)[d];
      dealii::Tensor<1, dim> normal;
      normal[direction] = face % 2 == 0 ? -1. : 1.;
      result.points.push_back(point);
      result.weights.push_back(inside.weight(q) * area);
      result.normals.push_back(normal);
    }
  return result;
}

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
  const dealii::QGauss<dim> gauss(space.basis.degree + 1);
  whole_cell.points  = gauss.get_points();
  whole_cell.weights = gauss.get_weights();

  CutCellRules<dim> rules(space.basis);
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

template class CutCellRules<2>;
template class CutCellRules<3>;
template class CutQuadrature<2>;
template class CutQuadrature<3>;
} // namespace scree
