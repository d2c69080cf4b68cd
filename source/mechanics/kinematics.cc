#include <scree/mechanics/kinematics.h>

namespace scree
{
template <int dim>
Kinematics<dim>::Kinematics(const double start_time)
    : time_of_start(start_time)
{
}

template <int dim>
PointEvaluator<dim>
Kinematics<dim>::whole_displacement(const PointEvaluator<dim> &u) const
{
  PointEvaluator<dim> result = start_displacement_field();
  result += u;
  return result;
}

template class Kinematics<2>;
template class Kinematics<3>;
} // namespace scree
