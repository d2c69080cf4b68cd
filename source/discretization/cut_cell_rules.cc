#include <scree/discretization/cut_cell_rules.h>
#include <scree/discretization/polytope_rules.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace scree
{
/**
 * phi/h on the unit cell, with the derivatives that the generator needs for its bounds, and the 1D
 * rules of which the generators keep references.
 */
template <int dim>
class CutCellRules<dim>::CellLevelSet : public dealii::Function<dim>
{
public:
  CellLevelSet(const LagrangeBasis<dim> &basis, const GaussPoints gauss)
      : bulk_gauss(dealii::QGauss<1>(gauss.bulk))
      , surface_gauss(dealii::QGauss<1>(gauss.surface))
      , basis(basis)
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

  const double                    *nodal = nullptr;
  const dealii::hp::QCollection<1> bulk_gauss, surface_gauss;

private:
  LagrangeBasis<dim>       basis;
  mutable ShapeValues<dim> shape;
};

template <int dim>
CutCellRules<dim>::CutCellRules(const LagrangeBasis<dim> &basis, const GaussPoints gauss)
    : basis(basis)
    , gauss(gauss)
    , level_set(std::make_unique<CellLevelSet>(basis, gauss))
    , generator(level_set->bulk_gauss)
    , face_generator(std::make_unique<dealii::NonMatching::FaceQuadratureGenerator<dim>>(
        level_set->surface_gauss))
{
  if (gauss.surface != gauss.bulk)
    surface_generator = std::make_unique<Generator>(level_set->surface_gauss);
}

template <int dim>
CutCellRules<dim>::~CutCellRules() = default;

template <int dim>
typename CutCellRules<dim>::Rules
CutCellRules<dim>::rules(const double *scaled, const double cell_size)
{
  level_set->nodal = scaled;
  generator.generate(*level_set, dealii::create_unit_bounding_box<dim>());
  if (surface_generator)
    surface_generator->generate(*level_set, dealii::create_unit_bounding_box<dim>());
  const double volume = std::pow(cell_size, dim), area = std::pow(cell_size, dim - 1);
  Rules        result;
  const auto  &inside = generator.get_inside_quadrature();
  for (unsigned int q = 0; q < inside.size(); ++q)
    {
      result.inside.points.push_back(inside.point(q));
      result.inside.weights.push_back(inside.weight(q) * volume);
    }
  const auto &surface
    = (surface_generator ? *surface_generator : generator).get_surface_quadrature();
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
      append_rule(part, gauss.bulk, cell_size, result.inside);
      for (const auto &facet : part.facets)
        if (facet.is_surface())
          append_rule(facet, facet.normal, gauss.surface, cell_size, result.surface);
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
        append_rule(facet, sign * dealii::Point<dim>::unit_vector(face / 2), gauss.surface,
                         cell_size, result);
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

template class CutCellRules<2>;
template class CutCellRules<3>;
} // namespace scree
