#include <scree/contact/enforcement_parameters.h>

namespace scree
{
void
EnforcementParameters::declare(ParameterSection &section)
{
  type                 = section.choice("Enforcement", type, {"penalty", "augmented Lagrangian"},
                                        "penalty (bodies overlap by p/eps_n and stick to within |tau|/eps_t), "
                                                        "augmented Lagrangian (multipliers take both away, by more iterations).");
  ParameterSection own = section.subsection(
    "Augmented Lagrangian", "Multipliers of contact: Uzawa's method (theory.md section 8).");
  const dealii::Patterns::Double factor(1., 1e6);
  own.entry("Largest gap", largest_gap, dealii::Patterns::Double(1e-12, 1.),
            "Of closed points, and the largest slide of sticking ones, in cells.");
  own.entry("Maximum updates", maximum_updates, dealii::Patterns::Integer(1, 1000),
            "Of multipliers in a step; then the step has failed.");
  own.entry("Growth", growth, factor,
            "Of the penalties where an update does not make the gaps four times smaller; no "
            "dimension.");
  own.entry("Largest growth", largest_growth, factor, "Of the penalties in a step; no dimension.");
}
} // namespace scree
