#include <scree/contact/contact_parameters.h>
#include <scree/contact/tied_law.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <limits>

namespace scree
{
namespace
{
void
tied_bound(const ContactPairParameters &, const dealii::ArrayView<const double> &,
           const dealii::ArrayView<FrictionBound> &bounds)
{
  std::fill(bounds.begin(), bounds.end(),
            FrictionBound{std::numeric_limits<double>::infinity(), 0.});
}

void
declare_tied(ContactPairParameters &parameters, const ParameterSection &section, const bool)
{
  section.entry("Tied gap", parameters.tied_gap, dealii::Patterns::Double(0.),
                "Tied: glued are points where the gap at the start, after Adjust, is not larger "
                "than this; default: a tenth of the cell [L].");
  section.entry("Where", parameters.where,
                "Tied: expression of x, y, z in the initial configuration that selects the glued "
                "part (not zero).");
  check_expression<3>(section, "Where", parameters.where, 1);
}
} // namespace

ContactLaw
tied_law()
{
  ContactLaw law;
  law.name        = "tied";
  law.description = "glued where the bodies touch at the start; elsewhere they do not interact";
  law.glues       = true;
  law.slides      = false;
  law.bound       = tied_bound;
  law.entries     = {"Tied gap", "Where"};
  law.declare     = declare_tied;
  return law;
}
} // namespace scree
