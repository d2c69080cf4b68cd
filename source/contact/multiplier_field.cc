#include <scree/base/sort_and_unite.h>
#include <scree/contact/multiplier_field.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace scree
{
namespace
{
/** Pair, size of the cell, direction, and the place of a node in the lattice. */
template <int dim>
using NodeKey = std::array<std::int64_t, dim + 3>;

template <int dim>
unsigned int
main_direction(const dealii::Tensor<1, dim> &normal)
{
  unsigned int d = 0;
  for (unsigned int e = 1; e < dim; ++e)
    if (std::abs(normal[e]) > std::abs(normal[d]))
      d = e;
  return 2 * d + (normal[d] > 0. ? 1 : 0);
}

template <int dim>
NodeKey<dim>
key_of(const ContactPoint<dim> &point, const dealii::Point<dim> &corner, const unsigned int vertex)
{
  NodeKey<dim> key{
    {point.pair, std::llround(1000. * std::log2(point.cell_size)), main_direction(point.normal)}};
  for (unsigned int d = 0; d < dim; ++d)
    key[3 + d] = static_cast<std::int64_t>(corner[d]) + ((vertex >> d) & 1);
  return key;
}

/** Of the one node of a contact point that is a node of the grid itself. */
template <int dim>
NodeKey<dim>
key_of_own(const ContactPoint<dim> &point, const unsigned int rank, const unsigned int number)
{
  constexpr std::int64_t no_direction = -1;
  NodeKey<dim>           key{{point.pair, 0, no_direction}};
  key[3] = rank;
  key[4] = number;
  return key;
}
} // namespace

template <int dim>
MultiplierField<dim>::MultiplierField(const std::vector<ContactPoint<dim>> &points,
                                      const MPI_Comm                        communicator)
    : communicator(communicator)
{
  const unsigned int        rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  std::vector<NodeKey<dim>> keys;
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const ContactPoint<dim> &point = points[p];
      weights.push_back(point.weight / std::pow(point.cell_size, dim - 1));
      if (point.is_node)
        {
          keys.insert(keys.end(), n_corners, key_of_own(point, rank, p));
          supports.emplace_back();
          supports.back().values[0] = 1.;
          continue;
        }
      dealii::Point<dim> corner, place;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double x = point.position[d] / point.cell_size;
          corner[d]      = std::floor(x);
          place[d]       = x - corner[d];
        }
      Support support;
      for (unsigned int v = 0; v < n_corners; ++v)
        {
          keys.push_back(key_of(point, corner, v));
          support.values[v] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            support.values[v] *= (v >> d) & 1 ? place[d] : 1. - place[d];
        }
      supports.push_back(support);
    }
  std::vector<NodeKey<dim>> all_keys;
  for (const auto &of_process : dealii::Utilities::MPI::all_gather(communicator, keys))
    all_keys.insert(all_keys.end(), of_process.begin(), of_process.end());
  sort_and_unite(all_keys);
  for (unsigned int i = 0; i < keys.size(); ++i)
    supports[i / n_corners].nodes[i % n_corners]
      = std::lower_bound(all_keys.begin(), all_keys.end(), keys[i]) - all_keys.begin();
  nodal.resize(all_keys.size());
}

template <int dim>
void
MultiplierField<dim>::clear()
{
  std::fill(nodal.begin(), nodal.end(), dealii::Tensor<1, dim>());
}

template <int dim>
typename MultiplierField<dim>::Value
MultiplierField<dim>::at(const std::vector<Value> &of_nodes, const Support &support) const
{
  dealii::Tensor<1, dim> value;
  for (unsigned int v = 0; v < n_corners; ++v)
    value += support.values[v] * of_nodes[support.nodes[v]];
  return value;
}

template <int dim>
dealii::Tensor<1, dim>
MultiplierField<dim>::operator()(const unsigned int point) const
{
  return at(nodal, supports[point]);
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
MultiplierField<dim>::moments(const std::vector<dealii::Tensor<1, dim>> &values,
                              const std::vector<bool>                   &closed) const
{
  std::vector<double> sums(dim * nodal.size());
  for (unsigned int p = 0; p < supports.size(); ++p)
    if (closed[p])
      for (unsigned int v = 0; v < n_corners; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          sums[dim * supports[p].nodes[v] + d] += weights[p] * supports[p].values[v] * values[p][d];
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  std::vector<dealii::Tensor<1, dim>> result(nodal.size());
  for (unsigned int i = 0; i < result.size(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      result[i][d] = sums[dim * i + d];
  return result;
}

template <int dim>
template <typename Function>
std::vector<double>
MultiplierField<dim>::sums(const std::vector<bool> &closed, const Function &of_point) const
{
  std::vector<double> result(nodal.size());
  for (unsigned int p = 0; p < supports.size(); ++p)
    if (closed[p])
      for (unsigned int v = 0; v < n_corners; ++v)
        result[supports[p].nodes[v]] += of_point(p, supports[p].values[v]);
  dealii::Utilities::MPI::sum(result, communicator, result);
  return result;
}

template <int dim>
void
MultiplierField<dim>::add_fit(const std::vector<Value> &values, const std::vector<bool> &closed)
{
  constexpr unsigned int most_iterations = 200;
  constexpr double       tolerance       = 1e-20; // squared
  const auto             diagonal
    = sums(closed, [&](const unsigned int p, const double N) { return weights[p] * N * N; });
  const auto at_points = [&](const std::vector<Value> &of_nodes) {
    std::vector<Value> result;
    for (const Support &support : supports)
      result.push_back(at(of_nodes, support));
    return result;
  };
  std::vector<Value> fit(nodal.size()), direction(nodal.size()), r = moments(values, closed);
  double             r_z = 0., first_r_z = 0.;
  for (unsigned int n = 0; n < most_iterations; ++n)
    {
      const double       last_r_z = r_z;
      std::vector<Value> z(r.size());
      r_z = 0.;
      for (unsigned int i = 0; i < r.size(); ++i)
        if (diagonal[i] > 0.)
          {
            z[i] = r[i] / diagonal[i];
            r_z += r[i] * z[i];
          }
      if (n == 0)
        first_r_z = r_z;
      if (r_z <= tolerance * first_r_z)
        break;
      for (unsigned int i = 0; i < r.size(); ++i)
        direction[i] = n == 0 ? z[i] : z[i] + (r_z / last_r_z) * direction[i];
      const auto product = moments(at_points(direction), closed);
      double     energy  = 0.;
      for (unsigned int i = 0; i < r.size(); ++i)
        energy += direction[i] * product[i];
      for (unsigned int i = 0; i < r.size(); ++i)
        {
          fit[i] += (r_z / energy) * direction[i];
          r[i] -= (r_z / energy) * product[i];
        }
    }
  for (unsigned int i = 0; i < nodal.size(); ++i)
    if (diagonal[i] > 0.)
      nodal[i] += fit[i];
    else
      nodal[i] = 0.;
}

template <int dim>
double
MultiplierField<dim>::largest_mean(const std::vector<dealii::Tensor<1, dim>> &values,
                                   const std::vector<bool>                   &closed) const
{
  const auto area
    = sums(closed, [&](const unsigned int p, const double N) { return weights[p] * N; });
  const auto moment = moments(values, closed);
  double     result = 0.;
  for (unsigned int i = 0; i < area.size(); ++i)
    if (area[i] >= smallest_part)
      result = std::max(result, moment[i].norm() / area[i]);
  return result;
}

template class MultiplierField<2>;
template class MultiplierField<3>;
} // namespace scree
