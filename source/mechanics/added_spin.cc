#include <scree/mechanics/added_spin.h>
#include <scree/mechanics/resultant.h>
#include <scree/mechanics/rigid_masses.h>

namespace scree
{
template <int dim>
void
AddedSpin<dim>::add(const double m, const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &d,
                    const dealii::Tensor<1, dim> &w)
{
  mass += m;
  centre += m * x;
  motion += m * d;
  momentum += m * w;
  second += m * dealii::outer_product(dealii::Tensor<1, dim>(x), dealii::Tensor<1, dim>(x));
  angular += m * moment_of<dim>(d, w);
}

template <int dim>
void
AddedSpin<dim>::add_to(JointSum &sum)
{
  sum.add(mass);
  for (auto *vector : {&centre, &motion, &momentum})
    sum.add(*vector);
  for (unsigned int d = 0; d < dim; ++d)
    sum.add(second[d]);
  sum.add(angular);
}

template <int dim>
void
AddedSpin<dim>::finish()
{
  if (mass == 0.)
    return;
  centre /= mass;
  second -= mass * dealii::outer_product(centre, centre);
  angular -= moment_of<dim>(motion, momentum) / mass;
  spin = spin_of<dim>(second, angular);
}

template <int dim>
dealii::Tensor<1, dim>
AddedSpin<dim>::velocity(const dealii::Point<dim> &x) const
{
  return turned<dim>(spin, x - centre);
}

template class AddedSpin<2>;
template class AddedSpin<3>;
} // namespace scree
