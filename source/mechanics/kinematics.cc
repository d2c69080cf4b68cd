#include <scree/mechanics/kinematics.h>

namespace scree
{
template <int dim>
Kinematics<dim>::Kinematics(const double start_time)
    : time_of_start(start_time)
{
}

template class Kinematics<2>;
template class Kinematics<3>;
} // namespace scree
