#include <scree/base/joint_sum.h>
#include <scree/base/log.h>
#include <scree/mechanics/free_bodies.h>
#include <scree/solver/null_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace scree
{
namespace
{
using DenseMatrix = dealii::FullMatrix<double>;

constexpr double negligible = 1e-6; // part of what resists

/** Sums the entries of all matrices over all processes at once. */
void
sum_over_processes(std::vector<DenseMatrix> &matrices, const MPI_Comm communicator)
{
  JointSum sum;
  for (auto &matrix : matrices)
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < matrix.n(); ++j)
        sum.add(matrix(i, j));
  sum.reduce(communicator);
}

} // namespace

template <int dim>
FreeBodies<dim>::FreeBodies(const DisplacementSpace<dim> &space,
                            const std::vector<Body<dim>> &bodies,
                            const StrongSupports<dim>    &supports,
                            const BoundaryTerms<dim>     &boundary_terms,
                            const ContactPoints<dim> &contact, const bool turns_finitely,
                            const bool has_inertia)
    : bodies(bodies)
    , supports(supports)
    , boundary_terms(boundary_terms)
    , contact(contact)
    , turns_finitely(turns_finitely)
    , communicator(space.grid.communicator())
    , number_of(bodies.size(), none)
{
  const std::vector<Motions> motions(bodies.begin(), bodies.end());
  const auto                 held = resistance_of_supports(motions);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const double trace = held[b].trace();
      is_unsupported.push_back(trace == 0.);
      if (has_inertia)
        continue;
      const DenseMatrix basis = trace == 0. ? DenseMatrix(dealii::IdentityMatrix(held[b].m()))
                                            : null_space(held[b], negligible * trace);
      if (basis.n() == 0)
        continue;
      number_of[b] = free_motions.size();
      free_motions.push_back({b, static_cast<unsigned int>(basis.n())});
      rigid_motions.push_back(motions[b]);
      bases.push_back(basis);
      first.push_back(n_coordinates);
      n_coordinates += basis.n();
    }
  find_unknowns(space);
  find_start_motions(space);
  find_couplings();
  for (const ContactPoint<dim> &point : contact.points())
    cell_size = std::max(cell_size, point.cell_size);
  cell_size = dealii::Utilities::MPI::max(cell_size, communicator);
}

template <int dim>
std::vector<DenseMatrix>
FreeBodies<dim>::resistance_of_supports(const std::vector<Motions> &motions) const
{
  std::vector<DenseMatrix> held;
  held.reserve(motions.size());
  for (const Motions &of_body : motions)
    held.push_back(of_body.no_resistance());
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (unsigned int m = 0; m < Motions::n_motions && bodies[b].is_rigid(); ++m)
        if (!bodies[b].rigid->is_free(m))
          motions[b].add_motion_resistance(m, held[b]);
  for (const auto &unknown : supports.unknowns())
    {
      const unsigned int b = supports.conditions()[unknown.support].first;
      motions[b].add_resistance(unknown.position, unknown.component, 1., held[b]);
    }
  for (const auto &region : boundary_terms.regions())
    {
      const unsigned int b = region.body;
      if (!region.condition->resists_motion())
        continue;
      for (const unsigned int component : region.condition->components)
        if (component >= dim)
          {
            if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
              motions[b].add_motion_resistance(Motions::n_motions - 1, held[b]);
          }
        else if (region.condition->n_multipliers() > 0)
          {
            // Only the mean is held, that of a rigid motion is the motion of the centre.
            if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
              motions[b].add_resistance(region.centre, component, 1., held[b]);
          }
        else
          for (const auto &point : region.points)
            motions[b].add_resistance(point.position, component, 1., held[b]);
    }
  sum_over_processes(held, communicator);
  return held;
}

template <int dim>
void
FreeBodies<dim>::find_unknowns(const DisplacementSpace<dim> &space)
{
  free_unknowns.resize(free_motions.size());
  positions.resize(free_motions.size());
  free_components.resize(free_motions.size());
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      const unsigned int b = free_motions[i].body;
      for (unsigned int m = 0; bodies[b].is_rigid() && m < Motions::n_motions; ++m)
        if (space.owned().is_element(space.rigid_unknown(b) + m))
          {
            free_unknowns[i].push_back(space.rigid_unknown(b) + m);
            free_components[i].push_back(m);
          }
    }
  std::vector<bool> is_known(space.owned().n_elements(), false);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      const ActiveCell  &cell = space.cells()[a];
      const unsigned int i    = number_of[cell.body];
      if (i == none)
        continue;
      const auto &geometry = space.grid.cells()[cell.grid_cell];
      for (unsigned int k = 0; k < space.basis.n_nodes; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const DofIndex unknown = space.nodes(a)[k] + d;
            if (!space.owned().is_element(unknown)
                || space.hanging_constraints().is_constrained(unknown)
                || is_known[space.owned().index_within_set(unknown)])
              continue;
            is_known[space.owned().index_within_set(unknown)] = true;
            free_unknowns[i].push_back(unknown);
            free_components[i].push_back(d);
            positions[i].push_back(geometry.lower
                                   + geometry.size * dealii::Tensor<1, dim>(space.basis.node(k)));
          }
    }
}

template <int dim>
void
FreeBodies<dim>::find_start_motions(const DisplacementSpace<dim> &space)
{
  places.resize(free_motions.size());
  start_motions.resize(free_motions.size());
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      const bool is_rigid = bodies[free_motions[i].body].is_rigid();
      for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
        {
          places[i].push_back(space.owned().index_within_set(free_unknowns[i][j]));
          for (unsigned int k = 0; k < bases[i].n(); ++k)
            start_motions[i].push_back(is_rigid
                                         ? bases[i](free_components[i][j], k)
                                         : motion(i, k, positions[i][j])[free_components[i][j]]);
        }
    }
}

template <int dim>
void
FreeBodies<dim>::find_couplings()
{
  coordinates_of_pair.resize(contact.pairs().size());
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    for (const unsigned int body : {contact.pairs()[p].a, contact.pairs()[p].b})
      if (const unsigned int i = number_of[body]; i != none)
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          coordinates_of_pair[p].push_back(first[i] + k);
}

template <int dim>
dealii::Tensor<1, dim>
FreeBodies<dim>::motion(const unsigned int i, const unsigned int k,
                        const dealii::Point<dim> &x) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int m = 0; m < Motions::n_motions; ++m)
    result += bases[i](m, k) * rigid_motions[i].motion(m, x);
  return result;
}

template <int dim>
void
FreeBodies<dim>::find_column(const ContactPoint<dim>      &point,
                             const dealii::Tensor<1, dim> &direction, Coordinates &column) const
{
  const ContactPair &pair = contact.pairs()[point.pair];
  column.clear();
  for (const auto &[body, sign] : {std::make_pair(pair.a, -1.), std::make_pair(pair.b, 1.)})
    if (const unsigned int i = number_of[body]; i != none)
      for (unsigned int k = 0; k < bases[i].n(); ++k)
        column.push_back(sign * (motion(i, k, point.position) * direction));
}

template <int dim>
std::vector<DenseMatrix>
FreeBodies<dim>::resistance_of_contact() const
{
  std::vector<DenseMatrix> of_pair;
  for (const auto &coordinates : coordinates_of_pair)
    of_pair.emplace_back(coordinates.size(), coordinates.size());
  std::vector<dealii::Tensor<1, dim>> directions;
  Coordinates                         column;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const auto &point    = contact.points()[i];
      const auto &response = contact.responses()[i];
      const auto &law      = *contact.pairs()[point.pair].law.kind;
      if (response.pressure == 0. && !law.glues)
        continue;
      directions.assign(1, point.normal);
      if (response.status == ContactStatus::stick)
        for (const auto &tangent : tangents_of<dim>(point.normal))
          directions.push_back(tangent);
      for (const auto &direction : directions)
        {
          find_column(point, direction, column);
          for (unsigned int k = 0; k < column.size(); ++k)
            for (unsigned int l = 0; l < column.size(); ++l)
              of_pair[point.pair](k, l) += column[k] * column[l];
        }
    }
  sum_over_processes(of_pair, communicator);
  for (DenseMatrix &matrix : of_pair)
    if (const double trace = matrix.m() == 0 ? 0. : matrix.trace(); trace > 0.)
      matrix /= trace;
    else
      matrix.reinit(0, 0);
  return of_pair;
}

/** What acts together. */
template <int dim>
struct FreeBodies<dim>::Group
{
  std::vector<unsigned int> coordinates;
  std::vector<unsigned int> pairs;          //!< the closed ones
  unsigned int              most_pairs = 0; //!< of them on a body
};

template <int dim>
std::vector<typename FreeBodies<dim>::Group>
FreeBodies<dim>::groups(const std::vector<DenseMatrix> &of_pairs) const
{
  const unsigned int        n = free_motions.size();
  std::vector<unsigned int> rank(n), parent(n), n_pairs(n, 0), number(n, none);
  boost::disjoint_sets<unsigned int *, unsigned int *> sets(rank.data(), parent.data());
  for (unsigned int i = 0; i < n; ++i)
    sets.make_set(i);
  const auto for_each_closed = [&](const auto &act) {
    for (unsigned int p = 0; p < of_pairs.size(); ++p)
      if (!of_pairs[p].empty())
        act(p, number_of[contact.pairs()[p].a], number_of[contact.pairs()[p].b]);
  };
  for_each_closed([&](const unsigned int, const unsigned int a, const unsigned int b) {
    if (a != none && b != none)
      sets.union_set(a, b);
    for (const unsigned int i : {a, b})
      if (i != none)
        ++n_pairs[i];
  });
  std::vector<Group> result;
  for (unsigned int i = 0; i < n; ++i)
    {
      unsigned int &place = number[sets.find_set(i)];
      if (place == none)
        {
          place = result.size();
          result.emplace_back();
        }
      for (unsigned int k = first[i]; k < first[i] + bases[i].n(); ++k)
        result[place].coordinates.push_back(k);
      result[place].most_pairs = std::max(result[place].most_pairs, n_pairs[i]);
    }
  for_each_closed([&](const unsigned int p, const unsigned int a, const unsigned int b) {
    result[number[sets.find_set(a == none ? b : a)]].pairs.push_back(p);
  });
  return result;
}

template <int dim>
std::vector<typename FreeBodies<dim>::JointMotions>
FreeBodies<dim>::not_resisted(const double negligible_part) const
{
  const auto                of_pairs = resistance_of_contact();
  std::vector<unsigned int> row(n_coordinates);
  std::vector<JointMotions> result;
  for (const Group &group : groups(of_pairs))
    {
      const unsigned int n = group.coordinates.size();
      for (unsigned int k = 0; k < n; ++k)
        row[group.coordinates[k]] = k;
      std::vector<std::vector<unsigned int>> rows;
      dealii::DynamicSparsityPattern         entries(n, n);
      for (unsigned int k = 0; k < n; ++k)
        entries.add(k, k);
      for (const unsigned int p : group.pairs)
        {
          rows.emplace_back();
          for (const unsigned int coordinate : coordinates_of_pair[p])
            rows.back().push_back(row[coordinate]);
          for (const unsigned int k : rows.back())
            entries.add_entries(k, rows.back().begin(), rows.back().end());
        }
      dealii::SparsityPattern pattern;
      pattern.copy_from(entries);
      dealii::SparseMatrix<double> resistance(pattern);
      for (unsigned int i = 0; i < group.pairs.size(); ++i)
        resistance.add(rows[i], of_pairs[group.pairs[i]]);
      result.push_back(
        {group.coordinates, null_space(resistance, negligible_part * group.most_pairs)});
    }
  return result;
}

template <int dim>
std::vector<unsigned int>
FreeBodies<dim>::not_held() const
{
  constexpr double takes_part = 1e-3;
  Coordinates      parts(n_coordinates, 0.);
  for (const auto &[coordinates, vectors] : not_resisted(negligible))
    for (unsigned int k = 0; k < coordinates.size(); ++k)
      for (unsigned int j = 0; j < vectors.n(); ++j)
        parts[coordinates[k]] += vectors(k, j) * vectors(k, j);
  std::vector<unsigned int> result;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    if (std::accumulate(parts.begin() + first[i], parts.begin() + first[i] + bases[i].n(), 0.)
        > takes_part)
      result.push_back(free_motions[i].body);
  return result;
}

template <int dim>
std::vector<double>
FreeBodies<dim>::largest_components(const Vector &u) const
{
  std::vector<double> result(free_motions.size(), 0.);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (const DofIndex unknown : free_unknowns[i])
      result[i] = std::max(result[i], std::abs(u(unknown)));
  dealii::Utilities::MPI::max(result, communicator, result);
  return result;
}

template <int dim>
std::vector<double>
FreeBodies<dim>::of_not_held(std::vector<double> values, const double limit) const
{
  // What is not held is sought only if it matters.
  const bool matters
    = std::any_of(values.begin(), values.end(), [=](const double v) { return v > limit; });
  const std::vector<unsigned int> loose = matters ? not_held() : std::vector<unsigned int>();
  for (unsigned int i = 0; i < values.size(); ++i)
    if (values[i] <= limit
        || !std::binary_search(loose.begin(), loose.end(), free_motions[i].body)) // ascending
      values[i] = 0.;
  return values;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::resultants(const dealii::TrilinosWrappers::MPI::Vector &forces) const
{
  constexpr double round_off = 1e-10;
  // Sums, then sums of magnitudes.
  std::vector<double> sums(2 * n_coordinates, 0.);
  const double       *force = forces.begin();
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int j = 0; j < places[i].size(); ++j)
      {
        const auto modes = motions_of(i, j, nullptr);
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          {
            const double part = modes[k] * force[places[i][j]];
            sums[first[i] + k] += part;
            sums[n_coordinates + first[i] + k] += std::abs(part);
          }
      }
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  Coordinates result(sums.begin(), sums.begin() + n_coordinates);
  for (unsigned int k = 0; k < n_coordinates; ++k)
    if (std::abs(result[k]) <= round_off * sums[n_coordinates + k])
      result[k] = 0.;
  return result;
}

template <int dim>
bool
FreeBodies<dim>::has_neighbours(const unsigned int body) const
{
  const bool found = std::any_of(contact.points().begin(), contact.points().end(),
                                 [&](const ContactPoint<dim> &point) {
                                   const ContactPair &pair = contact.pairs()[point.pair];
                                   return pair.a == body || pair.b == body;
                                 });
  return dealii::Utilities::MPI::max(static_cast<unsigned int>(found), communicator) == 1;
}

template <int dim>
std::vector<LooseMotion<dim>>
FreeBodies<dim>::in_words(const Coordinates &motion) const
{
  constexpr double              small_part = 0.1, small_turn = 0.02;
  std::vector<LooseMotion<dim>> result;
  double                        largest = 0.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      std::array<double, Motions::n_motions> q = {};
      for (unsigned int m = 0; m < q.size(); ++m)
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          q[m] += bases[i](m, k) * motion[first[i] + k];
      dealii::Tensor<1, dim> v;
      dealii::Tensor<1, 3>   omega;
      for (unsigned int m = 0; m < q.size(); ++m)
        if (m < dim)
          v[m] = q[m];
        else
          omega[dim == 2 ? 2 : m - dim] = q[m] / rigid_motions[i].length();
      const double     turn = omega.norm() * rigid_motions[i].length();
      LooseMotion<dim> words{free_motions[i].body,
                             v.norm() + turn,
                             turn > small_turn * v.norm(),
                             rigid_motions[i].fixed_point(),
                             v,
                             omega[2] > 0. ? 1. : -1.};
      largest = std::max(largest, words.size);
      if (words.turns)
        {
          if constexpr (dim == 2)
            words.centre += dealii::Tensor<1, 2>({-v[1], v[0]}) / omega[2];
          else
            {
              words.centre += dealii::cross_product_3d(omega, v) / omega.norm_square();
              words.direction = omega;
            }
        }
      if (words.direction.norm() > 0.)
        words.direction /= words.direction.norm();
      result.push_back(words);
    }
  result.erase(
    std::remove_if(result.begin(), result.end(),
                   [&](const LooseMotion<dim> &body) { return body.size < small_part * largest; }),
    result.end());
  std::sort(result.begin(), result.end(),
            [](const auto &a, const auto &b) { return a.size > b.size; });
  return result;
}

template <int dim>
std::string
LooseMotion<dim>::in_words() const
{
  const auto rounded = [](const auto &vector, const double unit) {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = unit * std::round(vector[d] / unit) + 0.;
    return short_place(result);
  };
  if (!turns)
    return "moves along " + rounded(direction, 1e-3);
  if (dim == 3)
    return "turns about the axis through " + short_place(centre) + " along "
           + rounded(direction, 1e-3);
  return "turns about " + short_place(centre) + (sense > 0. ? " counter-clockwise" : " clockwise");
}

template struct LooseMotion<2>;
template struct LooseMotion<3>;
template class FreeBodies<2>;
template class FreeBodies<3>;
} // namespace scree
