#include <scree/mechanics/boundary_coverage.h>
#include <scree/mechanics/prescribed_displacements.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Prescribed displacements of bodies that keep their volume: Nitsche's penalty on the moments of
// the normal displacement over the surface in each cell.
namespace scree
{
template <int dim>
double
PrescribedDisplacements<dim>::flow_ratio(const unsigned int active_cell) const
{
  // Enough for the flux of a body that is unloaded and elastic again.
  constexpr double smallest = 0.1;
  return std::max(smallest, bulk.secant_ratio(active_cell));
}

template <int dim>
double
PrescribedDisplacements<dim>::pointwise_share(const BoundaryRegion<dim> &region,
                                              const unsigned int         q) const
{
  if (region.condition->parameters.method == DisplacementMethod::penalty)
    return 1.;
  const auto  &material = *bodies[region.body].material;
  const double mu       = material.shear_modulus();
  return flow_ratio(region.points[q].active_cell)
         * (2. * mu + std::min(material.lame_lambda(), IsotropicModuli::largest_ratio * mu))
         / material.p_wave_modulus();
}

template <int dim>
void
PrescribedDisplacements<dim>::release_edges()
{
  constexpr double largest = 0.5; // plastic strain beyond the elastic
  const auto       flows   = [&](const BoundaryPoint<dim> &point) {
    return bulk.secant_ratio(point.active_cell) < largest;
  };
  auto                     &regions = setting.regions;
  std::vector<unsigned int> is_found(regions.size());
  for (const unsigned int r : own_regions)
    {
      const bool has_edges = regions[r].condition->parameters.where != "1";
      is_found[r]          = is_nitsche(regions[r]) && has_edges
                    && std::any_of(regions[r].points.begin(), regions[r].points.end(), flows);
    }
  dealii::Utilities::MPI::max(is_found, fields.grid.communicator(), is_found);
  // The first region of each body at once, then the second ones: bodies share no cells.
  std::vector<std::vector<unsigned int>> rounds;
  std::vector<unsigned int>              n_of_body(bodies.size());
  for (const unsigned int r : own_regions)
    if (is_found[r])
      {
        const unsigned int round = n_of_body[regions[r].body]++;
        rounds.resize(std::max<std::size_t>(rounds.size(), round + 1));
        rounds[round].push_back(r);
      }
  for (const auto &round : rounds)
    {
      std::vector<double> covered(fields.n_owned_cells(), 0.);
      for (const unsigned int r : round)
        set_coverage(fields, setting.level_set_nodes, bodies[regions[r].body], regions[r], *start,
                     covered);
      const auto is_outer = outer_edge(fields, covered);
      for (const unsigned int r : round)
        {
          auto &points = regions[r].points;
          points.erase(std::remove_if(points.begin(), points.end(),
                                      [&](const BoundaryPoint<dim> &point) {
                                        return is_outer[point.active_cell] && flows(point);
                                      }),
                       points.end());
        }
    }
}

template <int dim>
void
PrescribedDisplacements<dim>::forgive_flow()
{
  for (const unsigned int r : own_regions)
    {
      auto       &region    = setting.regions[r];
      const auto &condition = *region.condition;
      if (!is_nitsche(region))
        continue;
      for (auto &point : region.points)
        if (const double ratio = bulk.secant_ratio(point.active_cell); ratio < 1.)
          for (unsigned int k = 0; k < condition.components.size(); ++k)
            {
              double &u_n = point.start_displacement[condition.components[k]];
              u_n += (1. - ratio)
                     * (condition.value(k, point.reference_position, setting.start_time) - u_n);
            }
    }
}

template <int dim>
void
PrescribedDisplacements<dim>::find_moments()
{
  std::vector<dealii::Point<dim>> points;
  std::vector<double>             weights;
  moments_of_point.resize(setting.regions.size());
  for (const unsigned int r : own_regions)
    {
      const auto &region = this->region(r);
      moments_of_point[r].assign(region.points.size(), -1);
      for (unsigned int begin = 0, end = 0; begin < region.points.size(); begin = end)
        {
          const unsigned int cell = region.points[begin].active_cell;
          points.clear();
          weights.clear();
          for (; end < region.points.size() && region.points[end].active_cell == cell; ++end)
            {
              points.push_back(region.points[end].unit_point);
              weights.push_back(region.points[end].weight);
            }
          const double share = pointwise_share(region, begin);
          if (share >= 1.)
            continue;
          std::fill(moments_of_point[r].begin() + begin, moments_of_point[r].begin() + end,
                    normal_moments.size());
          normal_moments.push_back({r,
                                    begin,
                                    end,
                                    beta(region, begin) / share * (1. - share),
                                    VolumeModes<dim>(points.data(), weights.data(), points.size(),
                                                     fields.basis.degree - 1),
                                    {}});
          for (unsigned int m = 0; m < normal_moments.back().modes.n; ++m)
            normal_moments.back().rows.push_back(moment_row(normal_moments.back(), m));
        }
    }
}

template <int dim>
std::vector<double>
PrescribedDisplacements<dim>::moment_row(const NormalMoments &moments, const unsigned int m) const
{
  const auto         &region = this->region(moments.region);
  const unsigned int  n      = fields.basis.n_nodes;
  std::vector<double> row(n * dim, 0.), shape(n);
  for (unsigned int q = moments.begin; q < moments.end; ++q)
    {
      const auto &point = region.points[q];
      fields.basis.evaluate_values(point.unit_point, shape.data());
      const double weight = point.weight * moments.modes(point.unit_point)[m];
      for (const unsigned int c : region.condition->components)
        for (unsigned int a = 0; a < n; ++a)
          row[a * dim + c] += weight * point.normal[c] * shape[a];
    }
  return row;
}

template <int dim>
double
PrescribedDisplacements<dim>::prescribed_moment(const NormalMoments &moments, const unsigned int m,
                                                const double time) const
{
  const auto &region = this->region(moments.region);
  double      sum    = 0.;
  for (unsigned int q = moments.begin; q < moments.end; ++q)
    {
      const auto  &point  = region.points[q];
      const double weight = point.weight * moments.modes(point.unit_point)[m];
      for (unsigned int k = 0; k < region.condition->components.size(); ++k)
        {
          const unsigned int c = region.condition->components[k];
          sum += weight * point.normal[c]
                 * (prescribed_value(moments.region, q, k, time) - point.start_displacement[c]);
        }
    }
  return sum;
}

template <int dim>
void
PrescribedDisplacements<dim>::add_moments_to_matrix(
  dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  const unsigned int         n = fields.basis.n_nodes * dim;
  dealii::FullMatrix<double> block(n, n);
  for (const NormalMoments &moments : normal_moments)
    {
      block = 0.;
      for (unsigned int m = 0; m < moments.modes.n; ++m)
        {
          const auto &row = moments.rows[m];
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              block(i, j) += moments.stiffness * row[i] * row[j];
        }
      const unsigned int cell = this->region(moments.region).points[moments.begin].active_cell;
      fields.hanging_constraints().distribute_local_to_global(
        block, unknowns_of_nodes<dim>(fields.nodes(cell), fields.basis.n_nodes), matrix);
    }
}

template <int dim>
void
PrescribedDisplacements<dim>::add_moment_loads(Vector &loads, const double time) const
{
  const unsigned int     n = fields.basis.n_nodes * dim;
  dealii::Vector<double> load(n);
  for (const NormalMoments &moments : normal_moments)
    {
      load = 0.;
      for (unsigned int m = 0; m < moments.modes.n; ++m)
        {
          const auto  &row   = moments.rows[m];
          const double value = moments.stiffness * prescribed_moment(moments, m, time);
          for (unsigned int i = 0; i < n; ++i)
            load(i) += value * row[i];
        }
      const unsigned int cell = this->region(moments.region).points[moments.begin].active_cell;
      fields.hanging_constraints().distribute_local_to_global(
        load, unknowns_of_nodes<dim>(fields.nodes(cell), fields.basis.n_nodes), loads);
    }
}

template <int dim>
dealii::Tensor<1, dim>
PrescribedDisplacements<dim>::moment_traction(const unsigned int index, const unsigned int q,
                                              const PointEvaluator<dim> &u, const double time) const
{
  dealii::Tensor<1, dim> traction;
  const int              of_point = moments_of_point[index][q];
  if (of_point < 0)
    return traction;
  const NormalMoments &moments = normal_moments[of_point];
  const auto          &region  = this->region(index);
  const auto          &point   = region.points[q];
  const double        *nodal   = u.nodal_values(point.active_cell);
  const auto           psi     = moments.modes(point.unit_point);
  double               density = 0.;
  for (unsigned int m = 0; m < moments.modes.n; ++m)
    {
      const auto &row    = moments.rows[m];
      double      moment = -prescribed_moment(moments, m, time);
      for (unsigned int i = 0; i < row.size(); ++i)
        moment += row[i] * nodal[i];
      density += moments.stiffness * psi[m] * moment;
    }
  for (const unsigned int c : region.condition->components)
    traction[c] = -density * point.normal[c];
  return traction;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template double PrescribedDisplacements<dim>::flow_ratio(const unsigned int) const;         \
  template void   PrescribedDisplacements<dim>::release_edges();                              \
  template void   PrescribedDisplacements<dim>::forgive_flow();                               \
  template double PrescribedDisplacements<dim>::pointwise_share(const BoundaryRegion<dim> &,  \
                                                                const unsigned int) const;    \
  template void   PrescribedDisplacements<dim>::find_moments();                               \
  template void   PrescribedDisplacements<dim>::add_moments_to_matrix(                        \
      dealii::TrilinosWrappers::SparseMatrix &) const;                                        \
  template void PrescribedDisplacements<dim>::add_moment_loads(Vector &, const double) const; \
  template dealii::Tensor<1, dim> PrescribedDisplacements<dim>::moment_traction(              \
    const unsigned int, const unsigned int, const PointEvaluator<dim> &, const double) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
