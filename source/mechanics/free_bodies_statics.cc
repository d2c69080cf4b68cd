#include <scree/mechanics/free_bodies.h>
#include <scree/solver/cone_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Statics of the free bodies as rigid ones.
namespace scree
{
namespace
{
/** Edges of the cone of tractions on b; in 3D a pyramid around that of friction. */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
edges_of_cone(const ContactPairParameters &law, const dealii::Tensor<1, dim> &n)
{
  constexpr unsigned int              n_edges = dim == 2 ? 2 : 8;
  const auto                          tangent = tangents_of<dim>(n);
  std::vector<dealii::Tensor<1, dim>> result;
  const double                        mu = law.friction();
  if (mu == 0.)
    return {n};
  for (unsigned int k = 0; k < n_edges; ++k)
    {
      const double           angle = 2. * dealii::numbers::PI * k / n_edges;
      dealii::Tensor<1, dim> t     = std::cos(angle) * tangent[0];
      if constexpr (dim == 3)
        t += std::sin(angle) * tangent[1];
      if (std::isfinite(mu))
        result.push_back(n + mu / (dim == 2 ? 1. : std::cos(dealii::numbers::PI / n_edges)) * t);
      else
        result.push_back(t);
    }
  result.push_back(n);
  if (law.kind->glues)
    result.push_back(-n);
  return result;
}

/** Whether the bodies face each other where they are apart, by more than the side of a box faces
 * the floor that it stands on. */
template <int dim>
bool
can_meet(const ContactPoint<dim> &point)
{
  constexpr double touching = 0.02, facing = 0.3; // cells, cosine
  const auto       from_a = point.position - point.feet[0], from_b = point.position - point.feet[1];
  return point.initial_gap < touching * point.cell_size
         || -(from_a * from_b) > facing * from_a.norm() * from_b.norm();
}
} // namespace

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::unbalanced(const Coordinates &resultants) const
{
  // Pairs that touch can press where they touch nearly, others wherever they may meet.
  constexpr double    nearly = 0.25; // cells
  std::vector<double> nearest(contact.pairs().size(), std::numeric_limits<double>::max());
  const auto          distance = [&](const unsigned int i) {
    const double h = contact.points()[i].cell_size;
    return std::min(contact.gap(i), contact.points()[i].initial_gap) / h;
  };
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    nearest[contact.points()[i].pair] = std::min(nearest[contact.points()[i].pair], distance(i));
  dealii::Utilities::MPI::min(nearest, communicator, nearest);
  // Columns: their pairs, and their entries one after the other.
  std::vector<unsigned int> pairs;
  Coordinates               entries, column;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    if (const auto &point = contact.points()[i];
        (nearest[point.pair] > nearly || distance(i) <= nearly) && can_meet(point))
      for (const auto &edge : edges_of_cone<dim>(contact.pairs()[point.pair].law, point.normal))
        {
          find_column(point, edge, column);
          pairs.push_back(point.pair);
          entries.insert(entries.end(), column.begin(), column.end());
        }
  const auto  all_pairs   = dealii::Utilities::MPI::gather(communicator, pairs);
  const auto  all_entries = dealii::Utilities::MPI::gather(communicator, entries);
  SparseRows  reactions;
  Coordinates result;
  for (unsigned int process = 0; process < all_pairs.size(); ++process)
    {
      for (const unsigned int pair : all_pairs[process])
        {
          reactions.columns.insert(reactions.columns.end(), coordinates_of_pair[pair].begin(),
                                   coordinates_of_pair[pair].end());
          reactions.begin.push_back(reactions.columns.size());
        }
      reactions.values.insert(reactions.values.end(), all_entries[process].begin(),
                              all_entries[process].end());
    }
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    result = unbalanced_part(resultants, reactions);
  return dealii::Utilities::MPI::broadcast(communicator, result);
}

template std::vector<double> FreeBodies<2>::unbalanced(const std::vector<double> &) const;
template std::vector<double> FreeBodies<3>::unbalanced(const std::vector<double> &) const;
} // namespace scree
