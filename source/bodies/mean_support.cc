#include <scree/bodies/mean_support.h>

namespace scree
{
template <int dim>
ConditionKind<dim>
mean_support()
{
  ConditionKind<dim> kind;
  kind.name             = "mean support";
  kind.imposition       = Imposition::mean;
  kind.entries          = {"On", "Where", "Components"};
  kind.takes_a_rotation = true;
  return kind;
}

template ConditionKind<2> mean_support();
template ConditionKind<3> mean_support();
} // namespace scree
