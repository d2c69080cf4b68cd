#include <scree/mechanics/normal_moments.h>

#include <algorithm>

namespace scree
{
template <int dim>
NormalMoments<dim>::NormalMoments(const BoundarySetting<dim>      &setting,
                                  const std::vector<unsigned int> &own_regions,
                                  const NitscheStiffness<dim>     &stiffness,
                                  const PrescribedValues<dim>     &prescribed)
    : space(setting.space)
    , regions(setting.regions)
    , prescribed(prescribed)
    , moments_of_point(setting.regions.size())
{
  std::vector<dealii::Point<dim>> points;
  std::vector<double>             weights;
  for (const unsigned int r : own_regions)
    {
      const auto &region = regions[r];
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
          const double of_moments = stiffness.of_moments(region, begin);
          if (of_moments == 0.)
            continue;
          std::fill(moments_of_point[r].begin() + begin, moments_of_point[r].begin() + end,
                    of_cells.size());
          of_cells.push_back(
            {r,
             begin,
             end,
             of_moments,
             VolumeModes<dim>(points.data(), weights.data(), points.size(), space.volume_degree()),
             {}});
          for (unsigned int m = 0; m < of_cells.back().modes.n; ++m)
            of_cells.back().rows.push_back(row(of_cells.back(), m));
        }
    }
}

template <int dim>
std::vector<double>
NormalMoments<dim>::row(const CellMoments &moments, const unsigned int m) const
{
  const auto         &region = regions[moments.region];
  const unsigned int  n      = space.basis.n_nodes;
  std::vector<double> result(n * dim, 0.), shape(n);
  for (unsigned int q = moments.begin; q < moments.end; ++q)
    {
      const auto &point = region.points[q];
      space.basis.evaluate_values(point.unit_point, shape.data());
      const double weight = point.weight * moments.modes(point.unit_point)[m];
      for (const unsigned int c : region.condition->components)
        for (unsigned int a = 0; a < n; ++a)
          result[a * dim + c] += weight * point.normal[c] * shape[a];
    }
  return result;
}

template <int dim>
double
NormalMoments<dim>::prescribed_moment(const CellMoments &moments, const unsigned int m,
                                      const double time) const
{
  const auto &region = regions[moments.region];
  double      sum    = 0.;
  for (unsigned int q = moments.begin; q < moments.end; ++q)
    {
      const auto  &point  = region.points[q];
      const double weight = point.weight * moments.modes(point.unit_point)[m];
      for (unsigned int k = 0; k < region.condition->components.size(); ++k)
        {
          const unsigned int c = region.condition->components[k];
          sum += weight * point.normal[c]
                 * (prescribed(moments.region, q, k, time) - point.start_displacement[c]);
        }
    }
  return sum;
}

template <int dim>
std::vector<DofIndex>
NormalMoments<dim>::unknowns(const CellMoments &moments) const
{
  const unsigned int cell = regions[moments.region].points[moments.begin].active_cell;
  return unknowns_of_nodes<dim>(space.nodes(cell), space.basis.n_nodes);
}

template <int dim>
void
NormalMoments<dim>::add_to_matrix(Matrix &matrix) const
{
  const unsigned int         n = space.basis.n_nodes * dim;
  dealii::FullMatrix<double> block(n, n);
  for (const CellMoments &moments : of_cells)
    {
      block = 0.;
      for (unsigned int m = 0; m < moments.modes.n; ++m)
        {
          const auto &row = moments.rows[m];
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              block(i, j) += moments.stiffness * row[i] * row[j];
        }
      space.hanging_constraints().distribute_local_to_global(block, unknowns(moments), matrix);
    }
}

template <int dim>
void
NormalMoments<dim>::add_loads(Vector &loads, const double time) const
{
  const unsigned int     n = space.basis.n_nodes * dim;
  dealii::Vector<double> load(n);
  for (const CellMoments &moments : of_cells)
    {
      load = 0.;
      for (unsigned int m = 0; m < moments.modes.n; ++m)
        {
          const auto  &row   = moments.rows[m];
          const double value = moments.stiffness * prescribed_moment(moments, m, time);
          for (unsigned int i = 0; i < n; ++i)
            load(i) += value * row[i];
        }
      space.hanging_constraints().distribute_local_to_global(load, unknowns(moments), loads);
    }
}

template <int dim>
dealii::Tensor<1, dim>
NormalMoments<dim>::traction(const unsigned int index, const unsigned int q,
                             const PointEvaluator<dim> &u, const double time) const
{
  dealii::Tensor<1, dim> result;
  const int              of_point = moments_of_point[index][q];
  if (of_point < 0)
    return result;
  const CellMoments &moments = of_cells[of_point];
  const auto        &region  = regions[index];
  const auto        &point   = region.points[q];
  const double      *nodal   = u.nodal_values(point.active_cell);
  const auto         psi     = moments.modes(point.unit_point);
  double             density = 0.;
  for (unsigned int m = 0; m < moments.modes.n; ++m)
    {
      const auto &row    = moments.rows[m];
      double      moment = -prescribed_moment(moments, m, time);
      for (unsigned int i = 0; i < row.size(); ++i)
        moment += row[i] * nodal[i];
      density += moments.stiffness * psi[m] * moment;
    }
  for (const unsigned int c : region.condition->components)
    result[c] = -density * point.normal[c];
  return result;
}

template class NormalMoments<2>;
template class NormalMoments<3>;
} // namespace scree
