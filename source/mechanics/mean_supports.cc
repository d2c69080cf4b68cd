#include <scree/mechanics/mean_supports.h>

#include <cmath>

namespace scree
{
template <int dim>
double
MeanSupports<dim>::multiplier_scale(const BoundaryRegion<dim> &region) const
{
  return this->setting.bodies[region.body].material->young()
         * std::pow(this->space.grid.finest_size(), dim - 2) / region.area;
}

template <int dim>
void
MeanSupports<dim>::mean_row(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                            const unsigned int m, std::vector<double> &row) const
{
  std::vector<double> shape(this->space.basis.n_nodes);
  this->space.basis.evaluate_values(point.unit_point, shape.data());
  const unsigned int           component = region.condition->components[m];
  const dealii::Tensor<1, dim> arm       = point.position - region.centre;
  row.assign(this->space.basis.n_nodes * dim, 0.);
  for (unsigned int a = 0; a < this->space.basis.n_nodes; ++a)
    if (component < dim)
      row[a * dim + component] = shape[a] * point.weight;
    else
      {
        row[a * dim]     = -arm[1] * shape[a] * point.weight;
        row[a * dim + 1] = arm[0] * shape[a] * point.weight;
      }
  const double scale = multiplier_scale(region);
  for (double &entry : row)
    entry *= scale;
}

template <int dim>
void
MeanSupports<dim>::add_to_matrix(Matrix &matrix) const
{
  const unsigned int         n = this->space.basis.n_nodes;
  dealii::FullMatrix<double> block;
  std::vector<double>        row;
  for (const unsigned int r : this->own_regions)
    {
      const auto        &region = this->region(r);
      const unsigned int n_rows = region.condition->components.size();
      for (const auto &point : region.points)
        {
          auto indices = this->unknowns(point);
          block.reinit(n * dim + n_rows, n * dim + n_rows);
          for (unsigned int m = 0; m < n_rows; ++m)
            {
              mean_row(region, point, m, row);
              indices.push_back(this->space.multiplier(region.first_multiplier + m));
              for (unsigned int i = 0; i < n * dim; ++i)
                block(i, n * dim + m) = block(n * dim + m, i) = row[i];
            }
          this->space.hanging_constraints().distribute_local_to_global(block, indices, matrix);
        }
    }
}

template <int dim>
void
MeanSupports<dim>::add_loads(Vector &loads, const double time, const bool /*dead_loads*/,
                             const bool prescribed) const
{
  if (!prescribed)
    return;
  for (const unsigned int r : this->own_regions)
    {
      const auto &region    = this->region(r);
      const auto &condition = *region.condition;
      for (const auto &point : region.points)
        {
          const dealii::Tensor<1, dim> arm = point.position - region.centre;
          const auto                  &u_n = point.start_displacement;
          for (unsigned int m = 0; m < condition.components.size(); ++m)
            {
              const unsigned int c     = condition.components[m];
              const double       value = condition.value(m, point.reference_position, time);
              loads(this->space.multiplier(region.first_multiplier + m))
                += multiplier_scale(region) * point.weight
                   * (c < dim
                        ? value - u_n[c]
                        : value * squared_arm(region, point) - (arm[0] * u_n[1] - arm[1] * u_n[0]));
            }
        }
    }
}

template <int dim>
std::vector<std::vector<DofIndex>>
MeanSupports<dim>::couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const unsigned int r : this->own_regions)
    {
      const auto &region    = this->region(r);
      int         last_cell = -1;
      for (const auto &point : region.points)
        {
          if (last_cell == int(point.active_cell))
            continue;
          last_cell    = point.active_cell;
          auto indices = this->unknowns(point);
          for (unsigned int m = 0; m < region.condition->components.size(); ++m)
            indices.push_back(this->space.multiplier(region.first_multiplier + m));
          result.push_back(indices);
        }
    }
  return result;
}

template <int dim>
Resultant<dim>
MeanSupports<dim>::resultant_of_multipliers(const unsigned int         index,
                                            const PointEvaluator<dim> &u) const
{
  const auto    &region = this->region(index);
  Resultant<dim> resultant;
  for (unsigned int m = 0; m < region.condition->components.size(); ++m)
    {
      // The multiplier spreads -scale * (component, or arm turned by 90 degrees) over the region.
      const DofIndex index = this->space.multiplier(region.first_multiplier + m);
      if (!this->space.owned().is_element(index))
        continue;
      const unsigned int component = region.condition->components[m];
      const double       density   = -u.trailing_value(index) * multiplier_scale(region);
      if (component < dim)
        {
          dealii::Tensor<1, dim> force;
          force[component] = density * region.area;
          resultant.force += force;
          resultant.moment += moment_of<dim>(region.centre, force);
        }
      else
        resultant.moment[2] += density * region.polar_moment;
    }
  return resultant;
}

template class MeanSupports<2>;
template class MeanSupports<3>;
} // namespace scree
