#include <scree/mechanics/linear_nitsche.h>

namespace scree
{
template <int dim>
LinearNitsche<dim>::LinearNitsche(const BoundarySetting<dim>      &setting,
                                  const std::vector<unsigned int> &own_regions)
    : PrescribedDisplacements<dim>(setting, own_regions, true)
{
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
LinearNitsche<dim>::fluxes(const unsigned int index, const PointEvaluator<dim> &u) const
{
  const auto                         &region    = this->region(index);
  const auto                         &material  = *this->bodies[region.body].material;
  const double                        projected = this->bulk.projected_lambda(region.body);
  const double                        lambda    = material.lame_lambda() - projected;
  const double                        mu        = material.shear_modulus();
  std::vector<dealii::Tensor<1, dim>> result;
  result.reserve(region.points.size());
  for (const auto &point : region.points)
    {
      const dealii::Tensor<2, dim> gradient = u.gradient(point.in_cell());
      double                       pressure = lambda * trace(gradient);
      if (projected > 0.)
        pressure += projected * this->bulk.projected_divergence().value(point.in_cell(), u);
      result.push_back(pressure * point.normal
                       + mu * (gradient + transpose(gradient)) * point.normal);
    }
  return result;
}

template class LinearNitsche<2>;
template class LinearNitsche<3>;
} // namespace scree
