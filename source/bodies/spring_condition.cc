#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/spring_condition.h>

namespace scree
{
namespace
{
template <int dim>
void
evaluate_spring(const BoundaryCondition<dim>                    &condition,
                const dealii::ArrayView<const SurfacePoint<dim>> points, const double /*time*/,
                const dealii::ArrayView<SurfaceTraction<dim>>    tractions)
{
  for (std::size_t q = 0; q < points.size(); ++q)
    for (unsigned int k = 0; k < condition.components.size(); ++k)
      {
        const unsigned int c         = condition.components[k];
        const double       u         = points[q].displacement[c];
        const double       stiffness = condition.value(k, points[q].reference_position, 0.);
        require(stiffness >= 0., condition.path + "/Value", "a spring stiffness is negative",
                "give values that are not less than zero");
        tractions[q].traction[c]           = -stiffness * u;
        tractions[q].by_displacement[c][c] = -stiffness;
        tractions[q].energy += 0.5 * stiffness * u * u;
      }
}
} // namespace

template <int dim>
ConditionKind<dim>
spring_condition()
{
  ConditionKind<dim> kind;
  kind.name               = "springs";
  kind.imposition         = Imposition::traction;
  kind.entries            = {"On", "Where", "Components"};
  kind.needs_value        = true;
  kind.law.evaluate       = evaluate_spring<dim>;
  kind.law.resists_motion = true;
  return kind;
}

template ConditionKind<2> spring_condition();
template ConditionKind<3> spring_condition();
} // namespace scree
