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
/** Edges of the cone of tractions on b; in 3D a pyramid around Coulomb's cone. */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
edges_of_cone(const ContactPairParameters &law, const dealii::Tensor<1, dim> &n)
{
  constexpr unsigned int              n_edges = dim == 2 ? 2 : 8;
  const auto                          tangent = tangents_of<dim>(n);
  std::vector<dealii::Tensor<1, dim>> result;
  if (law.law == ContactLaw::none)
    return result;
  if (law.law == ContactLaw::frictionless || law.friction_coefficient == 0.)
    return {n};
  for (unsigned int k = 0; k < n_edges; ++k)
    {
      const double           angle = 2. * dealii::numbers::PI * k / n_edges;
      dealii::Tensor<1, dim> t     = std::cos(angle) * tangent[0];
      if constexpr (dim == 3)
        t += std::sin(angle) * tangent[1];
      if (law.law == ContactLaw::coulomb)
        result.push_back(n
                         + law.friction_coefficient
                             / (dim == 2 ? 1. : std::cos(dealii::numbers::PI / n_edges)) * t);
      else
        result.push_back(t);
    }
  result.push_back(n);
  if (law.law == ContactLaw::tied)
    result.push_back(-n);
  return result;
}
} // namespace

template <int dim>
std::vector<double>
FreeBodies<dim>::gaps() const
{
  std::vector<double> result(free_motions.size(), std::numeric_limits<double>::max());
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPair &pair = contact.pairs()[contact.points()[i].pair];
      for (const unsigned int body : {pair.a, pair.b})
        if (number_of[body] != none)
          result[number_of[body]] = std::min(result[number_of[body]], contact.gap(i));
    }
  dealii::Utilities::MPI::min(result, communicator, result);
  for (double &gap : result)
    gap = gap == std::numeric_limits<double>::max() ? 0. : std::max(gap, 0.);
  return result;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::settling(const Coordinates                              &resultants,
                          const std::function<void(const Coordinates &)> &evaluate) const
{
  constexpr double    how_far = 3., lightest = 1e-3, of_held = 1e6, negligible_gap = 1e-6;
  const auto          loose    = not_held();
  const auto          gap_of   = gaps();
  double              distance = 0., heaviest = 0., size = 0.;
  std::vector<double> load(free_motions.size(), 0.);
  std::vector<bool>   is_loose(free_motions.size());
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      is_loose[i] = std::find(loose.begin(), loose.end(), free_motions[i].body) != loose.end();
      if (!is_loose[i])
        continue;
      for (unsigned int k = 0; k < bases[i].n(); ++k)
        load[i] = std::hypot(load[i], resultants[first[i] + k]);
      heaviest = std::max(heaviest, load[i]);
      size     = std::max(size, rigid_motions[i].length());
      distance += how_far * gap_of[i];
    }
  if (distance <= how_far * negligible_gap * size)
    return {};
  Coordinates weight, wanted;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int k = 0; k < bases[i].n(); ++k)
      {
        const double squared = heaviest == 0. ? 1. : std::max(lightest, load[i] / heaviest);
        weight.push_back(is_loose[i] ? std::sqrt(squared) : of_held);
        wanted.push_back(is_loose[i] && heaviest > 0.
                           ? distance * resultants[first[i] + k] / (heaviest * squared)
                           : 0.);
      }
  Coordinates columns, room, q(n_coordinates, 0.);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      append_column(contact.points()[i], contact.points()[i].normal, columns);
      room.push_back(std::max(0., contact.gap(i)));
    }
  // A second time with what the first motion did to the gaps: feet are not exactly along normals.
  for (unsigned int pass = 0; pass < 2 && !q.empty(); ++pass)
    {
      q = least_motion(columns, room, weight, wanted);
      if (q.empty() || pass == 1)
        break;
      evaluate(q);
      for (unsigned int i = 0; i < room.size(); ++i)
        {
          double change = 0.;
          for (unsigned int k = 0; k < n_coordinates; ++k)
            change += columns[i * n_coordinates + k] * q[k];
          if (room[i] > 0.)
            room[i] = contact.gap(i) - change;
        }
    }
  return q;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::least_motion(const Coordinates &columns, const Coordinates &room,
                              const std::vector<double> &weight, const Coordinates &wanted) const
{
  // z = weight (q - wanted)
  Coordinates rows, h;
  for (unsigned int i = 0; i < room.size(); ++i)
    {
      const ContactLaw law = contact.pairs()[contact.points()[i].pair].law.law;
      if (law == ContactLaw::none || law == ContactLaw::tied)
        continue;
      double left = room[i];
      for (unsigned int k = 0; k < n_coordinates; ++k)
        {
          const double column = columns[i * n_coordinates + k];
          left += column * wanted[k];
          rows.push_back(column / weight[k]);
        }
      h.push_back(-left);
    }
  const auto  all_rows = dealii::Utilities::MPI::gather(communicator, rows);
  const auto  all_h    = dealii::Utilities::MPI::gather(communicator, h);
  Coordinates q;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      rows.clear();
      h.clear();
      for (unsigned int process = 0; process < all_h.size(); ++process)
        {
          rows.insert(rows.end(), all_rows[process].begin(), all_rows[process].end());
          h.insert(h.end(), all_h[process].begin(), all_h[process].end());
        }
      q = shortest_feasible(rows, h, n_coordinates);
      for (unsigned int k = 0; k < q.size(); ++k)
        q[k] = q[k] / weight[k] + wanted[k];
    }
  return dealii::Utilities::MPI::broadcast(communicator, q);
}

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
  Coordinates columns;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    if (const auto &point = contact.points()[i];
        nearest[point.pair] > nearly || distance(i) <= nearly)
      for (const auto &edge : edges_of_cone<dim>(contact.pairs()[point.pair].law, point.normal))
        append_column(point, edge, columns);
  const auto gathered = dealii::Utilities::MPI::gather(communicator, columns);
  columns.clear();
  for (const Coordinates &of_process : gathered)
    columns.insert(columns.end(), of_process.begin(), of_process.end());
  Coordinates result;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    result = unbalanced_part(resultants, columns);
  return dealii::Utilities::MPI::broadcast(communicator, result);
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template std::vector<double> FreeBodies<dim>::gaps() const;                                     \
  template std::vector<double> FreeBodies<dim>::settling(                                         \
    const std::vector<double> &, const std::function<void(const std::vector<double> &)> &) const; \
  template std::vector<double> FreeBodies<dim>::least_motion(                                     \
    const std::vector<double> &, const std::vector<double> &, const std::vector<double> &,        \
    const std::vector<double> &) const;                                                           \
  template std::vector<double> FreeBodies<dim>::unbalanced(const std::vector<double> &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
