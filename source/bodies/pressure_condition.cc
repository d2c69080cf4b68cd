#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/pressure_condition.h>

namespace scree
{
namespace
{
/** -p J_D F_D^{-T} n and its derivative; F_D = I on a fixed geometry. */
template <int dim>
void
evaluate_pressure(const BoundaryCondition<dim>                    &condition,
                  const dealii::ArrayView<const SurfacePoint<dim>> points, const double time,
                  const dealii::ArrayView<SurfaceTraction<dim>> tractions)
{
  for (std::size_t q = 0; q < points.size(); ++q)
    {
      const dealii::Tensor<2, dim> &F       = points[q].increment;
      const dealii::Tensor<2, dim>  inverse = invert(F);
      const dealii::Tensor<1, dim>  normal  = transpose(inverse) * points[q].normal;
      const double scale = -condition.value(0, points[q].reference_position, time) * determinant(F);
      tractions[q].traction = scale * normal;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            tractions[q].by_increment[i][k][l]
              = scale * (inverse[l][k] * normal[i] - inverse[l][i] * normal[k]);
    }
}

/** All around, the uniform stress is exact on the cut boundary. */
template <int dim>
bool
acts_on_exact_boundary(const BoundaryConditionParameters<dim> &parameters)
{
  return !parameters.is_all_around();
}
} // namespace

template <int dim>
ConditionKind<dim>
pressure_condition()
{
  ConditionKind<dim> kind;
  kind.name        = "pressure";
  kind.imposition  = Imposition::traction;
  kind.entries     = {"On", "Where"};
  kind.needs_value = true;
  kind.law         = {evaluate_pressure<dim>, false, true, acts_on_exact_boundary<dim>};
  return kind;
}

template ConditionKind<2> pressure_condition();
template ConditionKind<3> pressure_condition();
} // namespace scree
