#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/traction_condition.h>

namespace scree
{
namespace
{
template <int dim>
void
evaluate_traction(const BoundaryCondition<dim>                    &condition,
                  const dealii::ArrayView<const SurfacePoint<dim>> points, const double time,
                  const dealii::ArrayView<SurfaceTraction<dim>> tractions)
{
  for (std::size_t q = 0; q < points.size(); ++q)
    tractions[q].traction
      = points[q].area_ratio * condition.vector(points[q].reference_position, time);
}
} // namespace

template <int dim>
ConditionKind<dim>
traction_condition()
{
  ConditionKind<dim> kind;
  kind.name                       = "traction";
  kind.imposition                 = Imposition::traction;
  kind.entries                    = {"On", "Where", "Components"};
  kind.needs_value                = true;
  kind.law.evaluate               = evaluate_traction<dim>;
  kind.law.acts_on_exact_boundary = [](const BoundaryConditionParameters<dim> &) { return true; };
  return kind;
}

template ConditionKind<2> traction_condition();
template ConditionKind<3> traction_condition();
} // namespace scree
