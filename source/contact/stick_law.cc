#include <scree/contact/stick_law.h>

#include <limits>

namespace scree
{
namespace
{
void
stick_bound(const ContactPairParameters &, const dealii::ArrayView<const double> &pressures,
            const dealii::ArrayView<FrictionBound> &bounds)
{
  for (std::size_t i = 0; i < pressures.size(); ++i)
    bounds[i] = {pressures[i] > 0. ? std::numeric_limits<double>::infinity() : 0., 0.};
}
} // namespace

ContactLaw
stick_law()
{
  ContactLaw law;
  law.name        = "stick";
  law.description = "no sliding under pressure";
  law.slides      = false;
  law.bound       = stick_bound;
  return law;
}
} // namespace scree
