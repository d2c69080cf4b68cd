#include <scree/mechanics/prescribed_displacements.h>

#include <algorithm>

namespace scree
{
template <int dim>
PrescribedDisplacements<dim>::PrescribedDisplacements(const BoundarySetting<dim>      &setting,
                                                      const std::vector<unsigned int> &own_regions,
                                                      const bool stress_is_linear)
    : BoundaryTerm<dim>(setting, own_regions)
    , bodies(setting.bodies)
    , bulk(setting.kinematics.bulk())
    , stress_is_linear(stress_is_linear)
    , stiffness(setting)
    , prescribed_value(this->setting.regions, this->own_regions)
    , moments(setting, this->own_regions, stiffness, prescribed_value)
{
}

template <int dim>
double
PrescribedDisplacements<dim>::adjoint_factor(const BoundaryRegion<dim> &region,
                                             const BoundaryPoint<dim>  &point) const
{
  const auto method = region.condition->parameters.method;
  return (method == DisplacementMethod::nonsymmetric_nitsche ? 1. : -1.)
         * stiffness.flow_ratio(point.active_cell);
}

template <int dim>
void
PrescribedDisplacements<dim>::stress_vectors(const BoundaryRegion<dim>           &region,
                                             const BoundaryPoint<dim>            &point,
                                             ShapeValues<dim>                    &shape,
                                             std::vector<dealii::Tensor<1, dim>> &vectors) const
{
  const auto  &material = *bodies[region.body].material;
  const double lambda = material.lame_lambda(), mu = material.shear_modulus();
  const auto  &n = point.normal;
  space.evaluate_basis(point.active_cell, point.unit_point, shape);
  vectors.resize(space.basis.n_nodes * dim);
  std::vector<double> divergence;
  double              projected = 0.;
  if (bulk.is_projected(region.body))
    {
      divergence = bulk.projected_divergence().coefficients(point.in_cell());
      projected  = bulk.projected_lambda(region.body);
    }
  for (unsigned int a = 0; a < space.basis.n_nodes; ++a)
    {
      const dealii::Tensor<1, dim> g  = shape.gradient[a];
      const double                 gn = g * n;
      for (unsigned int i = 0; i < dim; ++i)
        {
          // sigma = lambda div I + mu (e_i g + g e_i)
          const double volumetric = (lambda - projected) * g[i]
                                    + (projected > 0. ? projected * divergence[a * dim + i] : 0.);
          dealii::Tensor<1, dim> vector = volumetric * n + mu * n[i] * g;
          vector[i] += mu * gn;
          vectors[a * dim + i] = vector;
        }
    }
}

template <int dim>
void
PrescribedDisplacements<dim>::add_to_matrix(Matrix &matrix) const
{
  const unsigned int                  n = space.basis.n_nodes;
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  dealii::FullMatrix<double>          block;
  for (const unsigned int r : own_regions)
    for (unsigned int q = 0; q < this->region(r).points.size(); ++q)
      {
        const auto &region = this->region(r);
        const auto &point  = region.points[q];
        block.reinit(n * dim, n * dim);
        stress_vectors(region, point, shape, stress);
        const double adjoint = adjoint_factor(region, point);
        const double beta    = stiffness.of_point(region, q);
        for (const unsigned int c : region.condition->components)
          {
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int b = 0; b < n; ++b)
                block(a * dim + c, b * dim + c)
                  += point.weight * beta * shape.value[a] * shape.value[b];
            for (unsigned int a = 0; is_nitsche(region) && a < n; ++a)
              for (unsigned int j = 0; j < n * dim; ++j)
                {
                  const double entry = point.weight * shape.value[a] * stress[j][c];
                  if (stress_is_linear)
                    block(a * dim + c, j) -= entry;
                  block(j, a * dim + c) += adjoint * entry;
                }
          }
        space.hanging_constraints().distribute_local_to_global(block, this->unknowns(point),
                                                               matrix);
      }
  moments.add_to_matrix(matrix);
}

template <int dim>
void
PrescribedDisplacements<dim>::add_loads(Vector &loads, const double time, const bool /*dead_loads*/,
                                        const bool prescribed) const
{
  if (!prescribed)
    return;
  const unsigned int                  n = space.basis.n_nodes;
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  dealii::Vector<double>              cell_load(n * dim);
  for (const unsigned int r : own_regions)
    for (unsigned int q = 0; q < this->region(r).points.size(); ++q)
      {
        const auto &region    = this->region(r);
        const auto &condition = *region.condition;
        const auto &point     = region.points[q];
        cell_load             = 0.;
        stress_vectors(region, point, shape, stress);
        const double adjoint = is_nitsche(region) ? adjoint_factor(region, point) : 0.;
        for (unsigned int k = 0; k < condition.components.size(); ++k)
          {
            const unsigned int c = condition.components[k];
            const double value   = prescribed_value(r, q, k, time) - point.start_displacement[c];
            for (unsigned int a = 0; a < n; ++a)
              cell_load(a * dim + c)
                += point.weight * stiffness.of_point(region, q) * shape.value[a] * value;
            for (unsigned int j = 0; j < n * dim; ++j)
              cell_load(j) += adjoint * point.weight * stress[j][c] * value;
          }
        space.hanging_constraints().distribute_local_to_global(cell_load, this->unknowns(point),
                                                               loads);
      }
  moments.add_loads(loads, time);
}

template <int dim>
bool
PrescribedDisplacements<dim>::is_symmetric() const
{
  return std::none_of(own_regions.begin(), own_regions.end(), [&](const unsigned int r) {
    return this->region(r).condition->parameters.method == DisplacementMethod::nonsymmetric_nitsche;
  });
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
PrescribedDisplacements<dim>::tractions(const unsigned int index, const PointEvaluator<dim> &u,
                                        const double time) const
{
  const auto                               &region = this->region(index);
  std::vector<dealii::Tensor<1, dim>>       result(region.points.size());
  const std::vector<dealii::Tensor<1, dim>> of_stress
    = is_nitsche(region) ? fluxes(index, u)
                         : std::vector<dealii::Tensor<1, dim>>(region.points.size());
  for (unsigned int q = 0; q < region.points.size(); ++q)
    {
      const auto                  &point = region.points[q];
      const dealii::Tensor<1, dim> displacement
        = point.start_displacement + u.value(point.in_cell());
      for (unsigned int k = 0; k < region.condition->components.size(); ++k)
        {
          const unsigned int c = region.condition->components[k];
          result[q][c]         = of_stress[q][c]
                         - stiffness.of_point(region, q)
                             * (displacement[c] - prescribed_value(index, q, k, time));
        }
      result[q] += moments.traction(index, q, u, time);
    }
  return result;
}

template <int dim>
double
PrescribedDisplacements<dim>::energy(const PointEvaluator<dim> &u, const double time) const
{
  double sum = 0.;
  for (const unsigned int r : own_regions)
    {
      const auto &region    = this->region(r);
      const auto &condition = *region.condition;
      const auto  t         = tractions(r, u, time);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto                  &point = region.points[q];
          const dealii::Tensor<1, dim> displacement
            = point.start_displacement + u.value(point.in_cell());
          const dealii::Tensor<1, dim> of_moments = moments.traction(r, q, u, time);
          for (unsigned int k = 0; k < condition.components.size(); ++k)
            {
              // -(sigma n) e + beta e^2/2 with e = u - ubar and t = sigma n - beta e, and half the
              // work of the moments
              const unsigned int c = condition.components[k];
              const double       e = displacement[c] - prescribed_value(r, q, k, time);
              sum -= point.weight
                     * ((t[q][c] - 0.5 * of_moments[c]) * e
                        + 0.5 * stiffness.of_point(region, q) * e * e);
            }
        }
    }
  return sum;
}

template class PrescribedDisplacements<2>;
template class PrescribedDisplacements<3>;
} // namespace scree
