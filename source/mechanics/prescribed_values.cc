#include <scree/mechanics/prescribed_values.h>

namespace scree
{
template <int dim>
PrescribedValues<dim>::PrescribedValues(const std::vector<BoundaryRegion<dim>> &regions,
                                        const std::vector<unsigned int>        &own_regions)
    : regions(regions)
    , own_regions(own_regions)
{
}

template <int dim>
double
PrescribedValues<dim>::operator()(const unsigned int region, const unsigned int q,
                                  const unsigned int k, const double time) const
{
  if (time_of_values != time)
    {
      values.assign(regions.size(), {});
      for (const unsigned int r : own_regions)
        for (const auto &point : regions[r].points)
          for (unsigned int i = 0; i < regions[r].condition->components.size(); ++i)
            values[r].push_back(regions[r].condition->value(i, point.reference_position, time));
      time_of_values = time;
    }
  return values[region][q * regions[region].condition->components.size() + k];
}

template class PrescribedValues<2>;
template class PrescribedValues<3>;
} // namespace scree
