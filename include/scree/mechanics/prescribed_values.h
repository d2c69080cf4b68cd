#pragma once

#include <scree/mechanics/boundary_regions.h>

#include <limits>
#include <vector>

namespace scree
{
/** What conditions prescribe at the points of some regions; formulas are evaluated once per time.
 */
template <int dim>
class PrescribedValues
{
public:
  PrescribedValues(const std::vector<BoundaryRegion<dim>> &regions,
                   const std::vector<unsigned int>        &own_regions);

  /** Of component k of the condition at point q, since the start of the run [L]. */
  double operator()(const unsigned int region, const unsigned int q, const unsigned int k,
                    const double time) const;

private:
  const std::vector<BoundaryRegion<dim>> &regions;
  const std::vector<unsigned int>        &own_regions;
  mutable double                          time_of_values = std::numeric_limits<double>::quiet_NaN();
  mutable std::vector<std::vector<double>> values; //!< [region], component by component of points
};
} // namespace scree
