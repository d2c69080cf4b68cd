#include <scree/discretization/point_evaluator.h>

#include <Epetra_BlockMap.h>
#include <algorithm>

namespace scree
{
template <int dim>
PointEvaluator<dim>::PointEvaluator(const DisplacementSpace<dim> &space)
    : space(&space)
    , values(space.cells().size() * space.basis.n_nodes * dim, 0.)
    , trailing(space.n_trailing(), 0.)
{
}

template <int dim>
PointEvaluator<dim>::PointEvaluator(const DisplacementSpace<dim> &space, const Vector &u)
    : PointEvaluator(space)
{
  gather(u);
}

template <int dim>
void
PointEvaluator<dim>::gather(const Vector &u)
{
  // The components of a node follow each other in the vector, too.
  const auto        &map   = u.trilinos_vector().Map();
  const double      *local = u.trilinos_vector()[0];
  const unsigned int n     = space->basis.n_nodes;
  double            *value = values.data();
  for (unsigned int cell = 0; cell < space->cells().size(); ++cell)
    for (unsigned int a = 0; a < n; ++a)
      {
        const int first
          = map.LID(static_cast<dealii::TrilinosWrappers::types::int_type>(space->nodes(cell)[a]));
        AssertIndexRange(first, map.NumMyElements());
        value = std::copy_n(local + first, dim, value);
      }
  for (unsigned int i = 0; i < trailing.size(); ++i)
    trailing[i] = u(space->n_dofs() - trailing.size() + i);
}

template <int dim>
bool
PointEvaluator<dim>::operator==(const PointEvaluator &other) const
{
  return space == other.space && values == other.values && trailing == other.trailing;
}

template <int dim>
dealii::Tensor<1, dim>
PointEvaluator<dim>::value(const PointInCell<dim> &point) const
{
  std::array<double, max_nodes_per_cell<dim>> shape;
  space->basis.evaluate_values(point.unit_point, shape.data());
  const double          *nodal = nodal_values(point.active_cell);
  dealii::Tensor<1, dim> result;
  for (unsigned int a = 0; a < space->basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      result[d] += nodal[a * dim + d] * shape[a];
  return result;
}

template <int dim>
dealii::Tensor<2, dim>
PointEvaluator<dim>::gradient(const PointInCell<dim> &point) const
{
  return evaluate(point).gradient;
}

template <int dim>
typename PointEvaluator<dim>::ValueAndGradient
PointEvaluator<dim>::evaluate(const PointInCell<dim> &point) const
{
  ShapeValues<dim> shape;
  space->evaluate_basis(point.active_cell, point.unit_point, shape);
  const double    *nodal = nodal_values(point.active_cell);
  ValueAndGradient result;
  for (unsigned int a = 0; a < space->basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.value[d] += nodal[a * dim + d] * shape.value[a];
        result.gradient[d] += nodal[a * dim + d] * shape.gradient[a];
      }
  return result;
}

template class PointEvaluator<2>;
template class PointEvaluator<3>;
} // namespace scree
