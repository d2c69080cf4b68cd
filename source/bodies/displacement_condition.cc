#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/displacement_condition.h>

namespace scree
{
namespace
{
template <int dim>
void
declare_displacement_condition(BoundaryConditionParameters<dim> &p, const ParameterSection &section,
                               const bool is_chosen)
{
  section.entry("Method", p.method, displacement_method_names,
                "How a displacement is imposed; automatic: exactly on a box face, by Nitsche on "
                "the cut surface.");
  section.entry("Penalty factor", p.penalty_factor, dealii::Patterns::Double(0.),
                "c in beta = c k^2 (2 mu + lambda)/h of Nitsche and penalty; no dimension.");
  if (is_chosen && p.penalty_factor == 0. && p.method != DisplacementMethod::nonsymmetric_nitsche)
    section.error("Penalty factor", "only nonsymmetric nitsche works without a penalty",
                  "10 to 100 for the other methods");
}
} // namespace

template <int dim>
ConditionKind<dim>
displacement_condition()
{
  ConditionKind<dim> kind;
  kind.name       = "displacement";
  kind.imposition = Imposition::displacement;
  kind.entries    = {"On", "Where", "Components", "Method", "Penalty factor"};
  kind.declare    = declare_displacement_condition<dim>;
  return kind;
}

template ConditionKind<2> displacement_condition();
template ConditionKind<3> displacement_condition();
} // namespace scree
