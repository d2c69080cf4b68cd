#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/point_support.h>

namespace scree
{
namespace
{
template <int dim>
void
declare_point_support(BoundaryConditionParameters<dim> &p, const ParameterSection &section,
                      const bool)
{
  section.entry("Point", p.point, "Position of a point support [L].");
}
} // namespace

template <int dim>
ConditionKind<dim>
point_support()
{
  ConditionKind<dim> kind;
  kind.name       = "point support";
  kind.imposition = Imposition::vertex;
  kind.entries    = {"Components", "Point"};
  kind.declare    = declare_point_support<dim>;
  return kind;
}

template ConditionKind<2> point_support();
template ConditionKind<3> point_support();
} // namespace scree
