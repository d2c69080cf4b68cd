#include <scree/mechanics/surface_tractions.h>

#include <algorithm>

namespace scree
{
template <int dim>
std::vector<SurfaceTraction<dim>>
SurfaceTractions<dim>::evaluate(const unsigned int index, const PointEvaluator<dim> *u,
                                const double time) const
{
  const auto                           &region   = this->region(index);
  const dealii::SymmetricTensor<2, dim> identity = dealii::unit_symmetric_tensor<dim>();
  std::vector<SurfacePoint<dim>>        points;
  points.reserve(region.points.size());
  for (const auto &point : region.points)
    {
      points.push_back({point.reference_position, point.normal, point.area_ratio,
                        point.start_displacement, identity});
      if (u == nullptr)
        continue;
      const auto here = u->evaluate(point.in_cell());
      points.back().displacement += here.value;
      if (region.follows_surface)
        points.back().increment += here.gradient;
    }
  std::vector<SurfaceTraction<dim>> result(points.size());
  region.condition->kind().law.evaluate(
    *region.condition, dealii::ArrayView<const SurfacePoint<dim>>(points.data(), points.size()),
    time, dealii::ArrayView<SurfaceTraction<dim>>(result.data(), result.size()));
  return result;
}

template <int dim>
void
SurfaceTractions<dim>::add_integral(const unsigned int index, const double factor,
                                    const std::vector<SurfaceTraction<dim>> &tractions,
                                    Vector                                  &forces) const
{
  const unsigned int     n      = this->space.basis.n_nodes;
  const auto            &region = this->region(index);
  dealii::Vector<double> cell_forces(n * dim);
  std::vector<DofIndex>  unknowns;

  std::array<double, max_nodes_per_cell<dim>> shape;
  for (unsigned int q = 0; q < region.points.size(); ++q)
    {
      const auto &point = region.points[q];
      this->space.basis.evaluate_values(point.unit_point, shape.data());
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          cell_forces(a * dim + d) = factor * point.weight * shape[a] * tractions[q].traction[d];
      this->set_unknowns(point, unknowns);
      this->space.hanging_constraints().distribute_local_to_global(cell_forces, unknowns, forces);
    }
}

template <int dim>
void
SurfaceTractions<dim>::add_to_matrix(Matrix &matrix) const
{
  const unsigned int         n = this->space.basis.n_nodes;
  ShapeValues<dim>           shape;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  for (const unsigned int r : this->own_regions)
    {
      const auto &region = this->region(r);
      if (!region.condition->resists_motion())
        continue;
      const auto tractions = evaluate(r, nullptr, 0.);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto &point = region.points[q];
          this->space.basis.evaluate_gradients(point.unit_point, shape);
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  block(a * dim + c, b * dim + d) = -point.weight
                                                    * tractions[q].by_displacement[c][d]
                                                    * shape.value[a] * shape.value[b];
          this->space.hanging_constraints().distribute_local_to_global(block, this->unknowns(point),
                                                                       matrix);
        }
    }
}

template <int dim>
void
SurfaceTractions<dim>::add_loads(Vector &loads, const double time, const bool dead_loads,
                                 const bool prescribed) const
{
  for (const unsigned int r : this->own_regions)
    if (!this->region(r).follows_surface
        && (this->region(r).condition->resists_motion() ? prescribed : dead_loads))
      add_integral(r, 1., evaluate(r, nullptr, time), loads);
}

template <int dim>
void
SurfaceTractions<dim>::add_internal_forces(const PointEvaluator<dim> &u, const double time,
                                           Vector &forces) const
{
  for (const unsigned int r : this->own_regions)
    if (this->region(r).follows_surface)
      add_integral(r, -1., evaluate(r, &u, time), forces);
}

template <int dim>
void
SurfaceTractions<dim>::add_tangent(const PointEvaluator<dim> &u, const double time,
                                   Matrix &matrix) const
{
  const unsigned int         n = this->space.basis.n_nodes;
  ShapeValues<dim>           shape;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  std::vector<DofIndex>      unknowns;
  for (const unsigned int r : this->own_regions)
    {
      if (!this->region(r).follows_surface)
        continue;
      const auto tractions = evaluate(r, &u, time);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        {
          const auto &point = this->region(r).points[q];
          this->space.evaluate_basis(point.active_cell, point.unit_point, shape);
          this->set_tangent(point, shape, -tractions[q].by_increment, block);
          this->set_unknowns(point, unknowns);
          this->space.hanging_constraints().distribute_local_to_global(block, unknowns, matrix);
        }
    }
}

template <int dim>
bool
SurfaceTractions<dim>::is_linear() const
{
  return std::none_of(this->own_regions.begin(), this->own_regions.end(),
                      [&](const unsigned int r) { return this->region(r).follows_surface; });
}

template <int dim>
bool
SurfaceTractions<dim>::is_symmetric() const
{
  return is_linear();
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
SurfaceTractions<dim>::tractions(const unsigned int index, const PointEvaluator<dim> &u,
                                 const double time) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  for (const auto &point : evaluate(index, &u, time))
    result.push_back(point.traction);
  return result;
}

template <int dim>
double
SurfaceTractions<dim>::energy(const PointEvaluator<dim> &u, const double time) const
{
  double sum = 0.;
  for (const unsigned int r : this->own_regions)
    {
      if (!this->region(r).condition->resists_motion())
        continue;
      const auto tractions = evaluate(r, &u, time);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        sum += this->region(r).points[q].weight * tractions[q].energy;
    }
  return sum;
}

template class SurfaceTractions<2>;
template class SurfaceTractions<3>;
} // namespace scree
