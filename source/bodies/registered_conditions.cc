#include <scree/bodies/displacement_condition.h>
#include <scree/bodies/mean_support.h>
#include <scree/bodies/point_support.h>
#include <scree/bodies/pressure_condition.h>
#include <scree/bodies/spring_condition.h>
#include <scree/bodies/traction_condition.h>

namespace scree
{
template <int dim>
const std::vector<ConditionKind<dim>> &
registered_conditions()
{
  static const std::vector<ConditionKind<dim>> kinds = {
    displacement_condition<dim>(), traction_condition<dim>(), pressure_condition<dim>(),
    spring_condition<dim>(),       point_support<dim>(),      mean_support<dim>(),
  };
  return kinds;
}

template const std::vector<ConditionKind<2>> &registered_conditions();
template const std::vector<ConditionKind<3>> &registered_conditions();
} // namespace scree
