#include <scree/mechanics/prescribed_displacements.h>

// On a moving geometry: Nitsche's method with the stress vector of the law.
namespace scree
{
template <int dim>
struct PrescribedDisplacements<dim>::PointIncrement
{
  dealii::Tensor<2, dim> increment; //!< F_D
  dealii::Tensor<2, dim> piola;
  dealii::Tensor<4, dim> tangent;
  ShapeValues<dim>       shape; //!< gradients physical
  /** What the projected volume change of the cell adds to the derivative of P by its unknowns. */
  std::vector<dealii::Tensor<2, dim>> by_volume;
};

template <int dim>
void
PrescribedDisplacements<dim>::find_starts()
{
  std::vector<PointInCell<dim>> points;
  for (const unsigned int r : own_regions)
    if (is_nitsche(this->region(r)))
      for (const auto &point : this->region(r).points)
        points.push_back({point.active_cell, point.unit_point});
  const auto histories = start->histories(points);
  auto       history   = histories.begin();
  starts.resize(setting.regions.size());
  for (const unsigned int r : own_regions)
    if (is_nitsche(this->region(r)))
      for (unsigned int q = 0; q < this->region(r).points.size(); ++q)
        starts[r].push_back(bodies[this->region(r).body].law->start(*history++));
}

template <int dim>
typename PrescribedDisplacements<dim>::PointIncrement
PrescribedDisplacements<dim>::increment_at(const unsigned int region, const unsigned int q,
                                           const Vector &u, const bool with_tangent) const
{
  const auto    &point = this->region(region).points[q];
  const double   scale = 1. / fields.grid.cells()[fields.cells()[point.active_cell].grid_cell].size;
  PointIncrement result;
  fields.basis.evaluate(point.unit_point, result.shape);
  result.increment      = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  const DofIndex *nodes = fields.nodes(point.active_cell);
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    {
      result.shape.gradient[a] *= scale;
      for (unsigned int d = 0; d < dim; ++d)
        result.increment[d] += u(nodes[a] + d) * result.shape.gradient[a];
    }
  const auto             volume    = bulk.cell_volume(point.active_cell, u, with_tangent);
  dealii::Tensor<2, dim> projected = result.increment;
  VolumeChange<dim>      change;
  if (volume.is_projected)
    change = bulk.volume_change(point.active_cell, point.unit_point, volume, result.increment,
                                starts[region][q], projected);
  IncrementResponse<dim> response;
  bodies[this->region(region).body].law->respond(
    dealii::ArrayView<const dealii::Tensor<2, dim>>(&projected, 1),
    dealii::ArrayView<const IncrementStart>(&starts[region][q], 1),
    dealii::ArrayView<IncrementResponse<dim>>(&response, 1),
    dealii::ArrayView<dealii::Tensor<4, dim>>(&result.tangent, with_tangent ? 1 : 0));
  result.piola = response.piola;
  if (!volume.is_projected)
    return result;
  const auto stress = change.stress(response.piola);
  result.piola      = stress.scaled;
  if (with_tangent)
    {
      const auto tangent = change.tangent(stress, result.tangent);
      const auto psi     = bulk.volume_modes(point.active_cell)(point.unit_point);
      result.tangent     = tangent.scaled;
      result.by_volume.resize(fields.basis.n_nodes * dim);
      for (unsigned int m = 0; m < psi.size(); ++m)
        for (unsigned int i = 0; i < result.by_volume.size(); ++i)
          result.by_volume[i]
            += change.slope * psi[m] * volume.derivatives[m][i] * tangent.scaled_by_volume;
    }
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
PrescribedDisplacements<dim>::stress_vector(const unsigned int index, const unsigned int q,
                                            const Vector &u) const
{
  const auto &point = this->region(index).points[q];
  if (start)
    return increment_at(index, q, u, false).piola * point.normal;
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  stress_vectors(this->region(index), point, shape, stress);
  dealii::Tensor<1, dim> flux;
  const DofIndex        *nodes = fields.nodes(point.active_cell);
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      flux += u(nodes[a] + d) * stress[a * dim + d];
  return flux;
}

template <int dim>
void
PrescribedDisplacements<dim>::add_internal_forces(const Vector &u, const double /*time*/,
                                                  Vector       &forces) const
{
  if (!start)
    return;
  const unsigned int     n = fields.basis.n_nodes;
  dealii::Vector<double> cell_forces(n * dim);
  for (const unsigned int r : own_regions)
    {
      const auto &region    = this->region(r);
      const auto &condition = *region.condition;
      if (!is_nitsche(region))
        continue;
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto                  &point = region.points[q];
          const PointIncrement         here  = increment_at(r, q, u, false);
          dealii::Tensor<1, dim>       t;
          const dealii::Tensor<1, dim> flux = here.piola * point.normal;
          for (const unsigned int c : condition.components)
            t[c] = -flux[c];
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              cell_forces(a * dim + d) = point.weight * here.shape.value[a] * t[d];
          fields.hanging_constraints().distribute_local_to_global(cell_forces,
                                                                  this->unknowns(point), forces);
        }
    }
}

template <int dim>
void
PrescribedDisplacements<dim>::add_tangent(const Vector &u, const double /*time*/,
                                          Matrix       &matrix) const
{
  if (!start)
    return;
  const unsigned int         n = fields.basis.n_nodes;
  dealii::FullMatrix<double> block(n * dim, n * dim);
  for (const unsigned int r : own_regions)
    {
      const auto &region    = this->region(r);
      const auto &condition = *region.condition;
      if (!is_nitsche(region))
        continue;
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto          &point = region.points[q];
          const PointIncrement here  = increment_at(r, q, u, true);
          // dt[i][k][L]: derivative of t_i with respect to F_D,kL
          dealii::Tensor<3, dim> dt;
          for (const unsigned int c : condition.components)
            for (unsigned int j = 0; j < dim; ++j)
              dt[c] -= here.tangent[c][j] * point.normal[j];
          this->set_tangent(point, here.shape, dt, block);
          if (!here.by_volume.empty())
            for (const unsigned int c : condition.components)
              for (unsigned int j = 0; j < n * dim; ++j)
                {
                  const double change = (here.by_volume[j] * point.normal)[c];
                  for (unsigned int a = 0; a < n; ++a)
                    block(a * dim + c, j) -= point.weight * here.shape.value[a] * change;
                }
          fields.hanging_constraints().distribute_local_to_global(block, this->unknowns(point),
                                                                  matrix);
        }
    }
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template void                   PrescribedDisplacements<dim>::find_starts();                    \
  template dealii::Tensor<1, dim> PrescribedDisplacements<dim>::stress_vector(                    \
    const unsigned int, const unsigned int, const Vector &) const;                                \
  template void PrescribedDisplacements<dim>::add_internal_forces(const Vector &, const double,   \
                                                                  Vector &) const;                \
  template void PrescribedDisplacements<dim>::add_tangent(const Vector &, const double, Matrix &) \
    const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
