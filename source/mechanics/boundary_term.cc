#include <scree/mechanics/mean_supports.h>
#include <scree/mechanics/surface_tractions.h>

namespace scree
{
template <int dim>
BoundaryTerm<dim>::BoundaryTerm(const BoundarySetting<dim>      &setting,
                                const std::vector<unsigned int> &own_regions)
    : setting(setting)
    , space(setting.space)
    , own_regions(own_regions)
{
}

template <int dim>
bool
BoundaryTerm<dim>::is_linear() const
{
  return true;
}

template <int dim>
void
BoundaryTerm<dim>::add_internal_forces(const PointEvaluator<dim> &, const double, Vector &) const
{
}

template <int dim>
void
BoundaryTerm<dim>::add_tangent(const PointEvaluator<dim> &, const double, Matrix &) const
{
}

template <int dim>
bool
BoundaryTerm<dim>::is_symmetric() const
{
  return true;
}

template <int dim>
std::vector<std::vector<DofIndex>>
BoundaryTerm<dim>::couplings() const
{
  return {};
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
BoundaryTerm<dim>::tractions(const unsigned int index, const PointEvaluator<dim> &,
                             const double) const
{
  return std::vector<dealii::Tensor<1, dim>>(region(index).points.size());
}

template <int dim>
Resultant<dim>
BoundaryTerm<dim>::resultant_of_multipliers(const unsigned int, const PointEvaluator<dim> &) const
{
  return {};
}

template <int dim>
double
BoundaryTerm<dim>::energy(const PointEvaluator<dim> &, const double) const
{
  return 0.;
}

template <int dim>
std::vector<DofIndex>
BoundaryTerm<dim>::unknowns(const BoundaryPoint<dim> &point) const
{
  return unknowns_of_nodes<dim>(space.nodes(point.active_cell), space.basis.n_nodes);
}

template <int dim>
void
BoundaryTerm<dim>::set_unknowns(const BoundaryPoint<dim> &point,
                                std::vector<DofIndex>    &unknowns) const
{
  set_unknowns_of_nodes<dim>(space.nodes(point.active_cell), space.basis.n_nodes, unknowns);
}

template <int dim>
void
BoundaryTerm<dim>::set_tangent(const BoundaryPoint<dim> &point, const ShapeValues<dim> &shape,
                               const dealii::Tensor<3, dim> &by_increment,
                               dealii::FullMatrix<double>   &block) const
{
  const unsigned int n = space.basis.n_nodes;
  for (unsigned int b = 0; b < n; ++b)
    for (unsigned int i = 0; i < dim; ++i)
      {
        const dealii::Tensor<1, dim> column = by_increment[i] * shape.gradient[b];
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int k = 0; k < dim; ++k)
            block(a * dim + i, b * dim + k) = point.weight * shape.value[a] * column[k];
      }
}

template <int dim>
std::unique_ptr<BoundaryTerm<dim>>
make_boundary_term(const Imposition imposition, const BoundarySetting<dim> &setting,
                   const std::vector<unsigned int> &own_regions)
{
  switch (imposition)
    {
    case Imposition::traction:
      return std::make_unique<SurfaceTractions<dim>>(setting, own_regions);
    case Imposition::displacement:
      return setting.kinematics.prescribed_displacements(setting, own_regions);
    case Imposition::mean:
      return std::make_unique<MeanSupports<dim>>(setting, own_regions);
    case Imposition::vertex:
      break;
    }
  return nullptr;
}

#define SCREE_INSTANTIATE(dim)                                    \
  template class BoundaryTerm<dim>;                               \
  template std::unique_ptr<BoundaryTerm<dim>> make_boundary_term( \
    const Imposition, const BoundarySetting<dim> &, const std::vector<unsigned int> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
