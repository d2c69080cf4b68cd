#include <scree/mechanics/quasi_static.h>

namespace scree
{
template <int dim>
std::unique_ptr<const TimeScheme<dim>>
make_time_scheme()
{
  return std::make_unique<const QuasiStatic<dim>>();
}

template std::unique_ptr<const TimeScheme<2>> make_time_scheme();
template std::unique_ptr<const TimeScheme<3>> make_time_scheme();
} // namespace scree
