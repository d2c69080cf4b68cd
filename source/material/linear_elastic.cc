#include <scree/material/linear_elastic.h>

#include <deal.II/base/exceptions.h>

namespace scree
{
using namespace dealii;

template <int dim>
LinearElastic<dim>::LinearElastic(const MaterialParameters &parameters)
    : Material<dim>(parameters.density)
    , lambda(parameters.young * parameters.poisson
             / ((1 + parameters.poisson) * (1 - 2 * parameters.poisson)))
    , mu(parameters.young / (2 * (1 + parameters.poisson)))
{
}

template <int dim>
SymmetricTensor<2, dim>
LinearElastic<dim>::stress(const SymmetricTensor<2, dim> &strain) const
{
  return lambda * trace(strain) * unit_symmetric_tensor<dim>() + 2 * mu * strain;
}

template <int dim>
SymmetricTensor<4, dim>
LinearElastic<dim>::tangent(const SymmetricTensor<2, dim> &) const
{
  return lambda * outer_product(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>())
         + 2 * mu * identity_tensor<dim>();
}

template <int dim>
double
LinearElastic<dim>::energy_density(const SymmetricTensor<2, dim> &strain) const
{
  return 0.5 * lambda * trace(strain) * trace(strain) + mu * (strain * strain);
}

template <int dim>
double
LinearElastic<dim>::out_of_plane_stress(const SymmetricTensor<2, dim> &strain) const
{
  Assert(dim == 2, ExcMessage("There is no out-of-plane direction in three dimensions."));
  return lambda * trace(strain);
}

template <int dim>
bool
LinearElastic<dim>::is_linear() const
{
  return true;
}

template <int dim>
double
LinearElastic<dim>::lame_lambda() const
{
  return lambda;
}

template <int dim>
double
LinearElastic<dim>::shear_modulus() const
{
  return mu;
}

template class LinearElastic<2>;
template class LinearElastic<3>;
} // namespace scree
