#include <scree/mechanics/incremental_nitsche.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace scree
{
template <int dim>
IncrementalNitsche<dim>::IncrementalNitsche(const BoundarySetting<dim>      &setting,
                                            const std::vector<unsigned int> &own_regions,
                                            const IncrementalBulk<dim>      &bulk,
                                            const BulkQuadrature<dim>       &quadrature)
    : PrescribedDisplacements<dim>(setting, own_regions, false)
    , bulk(bulk)
    , starts(setting.regions.size())
{
  std::copy_if(own_regions.begin(), own_regions.end(), std::back_inserter(nitsche_regions),
               [&](const unsigned int r) { return is_nitsche(this->region(r)); });
  find_starts(quadrature);
}

template <int dim>
void
IncrementalNitsche<dim>::find_starts(const BulkQuadrature<dim> &quadrature)
{
  std::vector<PointInCell<dim>> points;
  for (const unsigned int r : nitsche_regions)
    for (const auto &point : this->region(r).points)
      points.push_back(point.in_cell());
  const auto histories = quadrature.histories(points);
  auto       history   = histories.begin();
  for (const unsigned int r : nitsche_regions)
    for (unsigned int q = 0; q < this->region(r).points.size(); ++q)
      starts[r].push_back(bodies[this->region(r).body].law->start(*history++));
}

template <int dim>
const typename IncrementalNitsche<dim>::Answers &
IncrementalNitsche<dim>::answers(const PointEvaluator<dim> &u, const bool with_tangents) const
{
  if (!last.renew(u, with_tangents))
    return last;
  last.of_points.resize(starts.size());
  for (const unsigned int r : nitsche_regions)
    ask(r);
  return last;
}

template <int dim>
void
IncrementalNitsche<dim>::ask(const unsigned int index) const
{
  const auto                         &region  = this->region(index);
  const unsigned int                  n       = region.points.size();
  const auto                         &volumes = bulk.cell_volumes(*last.u);
  std::vector<dealii::Tensor<2, dim>> increments(n);
  std::vector<IncrementResponse<dim>> responses(n);
  std::vector<dealii::Tensor<4, dim>> tangents(last.has_tangents ? n : 0);
  std::vector<VolumeChange<dim>>      changes(n);
  const dealii::Tensor<2, dim>        identity(dealii::unit_symmetric_tensor<dim>());
  const auto                          is_projected
    = [&](const unsigned int q) { return volumes[region.points[q].active_cell].is_projected; };
  for (unsigned int q = 0; q < n; ++q)
    {
      const auto &[active_cell, unit_point] = region.points[q].in_cell();
      const dealii::Tensor<2, dim> F_D = identity + last.u->gradient({active_cell, unit_point});
      increments[q]                    = F_D;
      if (is_projected(q))
        changes[q] = bulk.volume_projection().change(active_cell, unit_point, volumes[active_cell],
                                                     F_D, starts[index][q], increments[q]);
    }
  bodies[region.body].law->respond(dealii::make_array_view(increments),
                                   dealii::ArrayView<const IncrementStart>(starts[index].data(), n),
                                   dealii::make_array_view(responses),
                                   dealii::make_array_view(tangents));
  auto &of_points = last.of_points[index];
  of_points.resize(n);
  for (unsigned int q = 0; q < n; ++q)
    {
      PointAnswer &answer = of_points[q];
      answer.piola        = responses[q].piola;
      if (last.has_tangents)
        answer.tangent = tangents[q];
      if (!is_projected(q))
        continue;
      const auto stress = changes[q].stress(responses[q].piola);
      answer.piola      = stress.scaled;
      if (!last.has_tangents)
        continue;
      const auto tangent = changes[q].tangent(stress, tangents[q]);
      answer.tangent     = tangent.scaled;
      answer.by_volume   = changes[q].slope * tangent.scaled_by_volume;
    }
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
IncrementalNitsche<dim>::fluxes(const unsigned int index, const PointEvaluator<dim> &u) const
{
  const auto                         &points    = this->region(index).points;
  const auto                         &of_points = answers(u, false).of_points[index];
  std::vector<dealii::Tensor<1, dim>> result;
  result.reserve(points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
    result.push_back(of_points[q].piola * points[q].normal);
  return result;
}

template <int dim>
void
IncrementalNitsche<dim>::add_internal_forces(const PointEvaluator<dim> &u, const double /*time*/,
                                             Vector                    &forces) const
{
  const auto        &of_points = answers(u, std::exchange(last.expects_tangent, false)).of_points;
  const unsigned int n         = space.basis.n_nodes;
  dealii::Vector<double> cell_forces(n * dim);
  std::vector<DofIndex>  unknowns;

  std::array<double, max_nodes_per_cell<dim>> shape;
  for (const unsigned int r : nitsche_regions)
    {
      const auto &region = this->region(r);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto                  &point = region.points[q];
          const dealii::Tensor<1, dim> flux  = of_points[r][q].piola * point.normal;
          space.basis.evaluate_values(point.unit_point, shape.data());
          cell_forces = 0.;
          for (const unsigned int c : region.condition->components)
            for (unsigned int a = 0; a < n; ++a)
              cell_forces(a * dim + c) = -point.weight * shape[a] * flux[c];
          this->set_unknowns(point, unknowns);
          space.hanging_constraints().distribute_local_to_global(cell_forces, unknowns, forces);
        }
    }
}

template <int dim>
void
IncrementalNitsche<dim>::set_point_tangent(const BoundaryRegion<dim>  &region,
                                           const BoundaryPoint<dim>   &point,
                                           const PointAnswer          &answer,
                                           const VolumeDerivatives    *volume,
                                           dealii::FullMatrix<double> &block) const
{
  const unsigned int n = space.basis.n_nodes;
  ShapeValues<dim>   shape;
  space.evaluate_basis(point.active_cell, point.unit_point, shape);
  // dt[i][k][L]: derivative of t_i with respect to F_D,kL
  dealii::Tensor<3, dim> dt;
  for (const unsigned int c : region.condition->components)
    for (unsigned int j = 0; j < dim; ++j)
      dt[c] -= answer.tangent[c][j] * point.normal[j];
  this->set_tangent(point, shape, dt, block);
  if (volume == nullptr)
    return;
  const dealii::Tensor<1, dim> by_volume = answer.by_volume * point.normal;
  const auto psi = bulk.volume_projection().modes(point.active_cell)(point.unit_point);
  for (unsigned int j = 0; j < n * dim; ++j)
    {
      double value = 0.; // derivative of the projected volume change
      for (unsigned int m = 0; m < psi.size(); ++m)
        value += psi[m] * (*volume)[m][j];
      for (const unsigned int c : region.condition->components)
        for (unsigned int a = 0; a < n; ++a)
          block(a * dim + c, j) -= point.weight * shape.value[a] * value * by_volume[c];
    }
}

template <int dim>
void
IncrementalNitsche<dim>::add_tangent(const PointEvaluator<dim> &u, const double /*time*/,
                                     Matrix                    &matrix) const
{
  const auto &of_points              = answers(u, true).of_points;
  const auto &volumes                = bulk.cell_volumes(u);
  last.expects_tangent               = true;
  const unsigned int         n       = space.basis.n_nodes;
  unsigned int               of_cell = dealii::numbers::invalid_unsigned_int;
  VolumeDerivatives          volume;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  std::vector<DofIndex>      unknowns;
  for (const unsigned int r : nitsche_regions)
    {
      const auto &region = this->region(r);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto &point        = region.points[q];
          const bool  is_projected = volumes[point.active_cell].is_projected;
          if (is_projected && of_cell != point.active_cell)
            {
              of_cell = point.active_cell;
              volume  = bulk.volume_projection().derivatives(of_cell, u);
            }
          set_point_tangent(region, point, of_points[r][q], is_projected ? &volume : nullptr,
                            block);
          this->set_unknowns(point, unknowns);
          space.hanging_constraints().distribute_local_to_global(block, unknowns, matrix);
        }
    }
}

template <int dim>
bool
IncrementalNitsche<dim>::is_linear() const
{
  return nitsche_regions.empty();
}

template <int dim>
bool
IncrementalNitsche<dim>::is_symmetric() const
{
  return nitsche_regions.empty();
}

template class IncrementalNitsche<2>;
template class IncrementalNitsche<3>;
} // namespace scree
