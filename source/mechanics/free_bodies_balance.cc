#include <scree/mechanics/free_bodies.h>
#include <scree/solver/line_search.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

// How free bodies move as rigid ones until contact balances their loads.
namespace scree
{
namespace
{
constexpr double       balanced         = 1e-3; // of what acts on a body
constexpr unsigned int max_iterations   = 100;
constexpr double       lightest         = 1e-3; // body, of the heaviest one
constexpr double       first_damping    = 1e-2;
constexpr double       smallest_damping = 1e-10;
constexpr double       overshoot        = 0.5;
constexpr double       lost             = 0.5;
constexpr double       search_reduction = 0.1;
constexpr unsigned int max_trials       = 30;
} // namespace

/** Forces on the coordinates, and what resists them, after a motion q. */
template <int dim>
struct FreeBodies<dim>::Balance
{
  /** Points of a pair, by their gaps. */
  struct Range
  {
    unsigned int pair, begin, end;
    Coordinates  fastest; //!< bounds on the motion of any point, by coordinates
    /** Of the first points, by coordinates: as many as have been near. */
    std::vector<dealii::Tensor<1, dim>> columns = {};
  };

  Balance(const FreeBodies &free, const Coordinates &loads, const ContactHistory<dim> &history,
          const bool is_falling);

  void evaluate(const Coordinates &q);

  /** Sorts the points of each pair by their gaps, closed ones first. */
  void find_points();

  /** Where a point lies on one of its bodies, -1: a, 1: b. */
  dealii::Point<dim> place(const unsigned int i, const double sign) const;

  /** Bounds on what the coordinates of a pair do to its points [begin, end) of contact. */
  Coordinates largest_motions(const unsigned int pair, const unsigned int begin,
                              const unsigned int end) const;

  /** Adds the columns of a point. */
  void add_columns(const unsigned int i, std::vector<dealii::Tensor<1, dim>> &columns) const;

  /** The points that may be closed after a motion q, in 3D one of a hundred, and their jumps. */
  void find_near(const Coordinates &q);

  /** Whether no body misses its balance by more than a part of what acts on it. */
  bool is_balanced() const;

  /** Whether contact carries less than half of what acts on some body. */
  bool has_lost_contact() const;

  /** Calls act(pair, entries of its block) for the pairs that resist. */
  template <typename F>
  void for_each_resisting(const F &act) const;

  /** The entries of K: without those of open pairs its factors stay sparse. */
  dealii::SparsityPattern pattern() const;

  /**
   * dq of (K + s M) dq = F, not longer than `length`, with the smallest s in steps of 10 that
   * allows that. It is sought from the last one on.
   */
  Coordinates direction(const double length, const double damping);

  const FreeBodies          &free;
  const Coordinates         &loads;
  const ContactHistory<dim> &history;
  const bool                 is_falling; // till forces balance; else a step goes on from there

  std::vector<std::size_t>                    first_of_pair; // entry of the pair's block
  std::vector<Range>                          ranges;
  std::vector<unsigned int>                   points;       // of contact, with a free body
  std::vector<double>                         gaps;         // of these points at the start, if open
  std::vector<unsigned int>                   near;         // what may be closed now
  std::vector<const dealii::Tensor<1, dim> *> near_columns; // of what is near
  std::vector<dealii::Tensor<1, dim>>         jumps;        // of what is near
  Coordinates                                 mass;         // M
  std::size_t                                 n_entries = 0; // of all blocks

  Coordinates         forces;      // F
  std::vector<double> acting;      // on each free body
  std::vector<double> blocks;      // K, by pairs
  double              last_s = 0.; // of direction()
};

template <int dim>
FreeBodies<dim>::Balance::Balance(const FreeBodies &free, const Coordinates &loads,
                                  const ContactHistory<dim> &history, const bool is_falling)
    : free(free)
    , loads(loads)
    , history(history)
    , is_falling(is_falling)
{
  for (const auto &coordinates : free.coordinates_of_pair)
    {
      first_of_pair.push_back(n_entries);
      n_entries += coordinates.size() * coordinates.size();
    }
  find_points();
  std::vector<double> load;
  for (unsigned int i = 0; i < free.free_motions.size(); ++i)
    load.push_back(free.magnitude(loads, i));
  const double heaviest = *std::max_element(load.begin(), load.end());
  for (unsigned int i = 0; i < load.size(); ++i)
    mass.insert(mass.end(), free.bases[i].n(),
                heaviest == 0. || !is_falling ? 1. : std::max(lightest, load[i] / heaviest));
}

template <int dim>
void
FreeBodies<dim>::Balance::find_points()
{
  const auto &contact = free.contact;
  const auto  gap_of  = [&](const unsigned int i) {
    return contact.responses()[i].status == ContactStatus::open
               ? contact.gap(i)
               : std::numeric_limits<double>::lowest();
  };
  std::vector<std::pair<double, unsigned int>> of_pair;
  for (unsigned int i = 0, end = 0; i < contact.points().size(); i = end)
    {
      const unsigned int pair = contact.points()[i].pair;
      of_pair.clear();
      for (; end < contact.points().size() && contact.points()[end].pair == pair; ++end)
        of_pair.emplace_back(gap_of(end), end);
      if (free.coordinates_of_pair[pair].empty())
        continue;
      std::sort(of_pair.begin(), of_pair.end());
      const auto begin = static_cast<unsigned int>(points.size());
      Range      range{pair, begin, begin, largest_motions(pair, i, end)};
      // What stays open in all motions that balancing() allows is left out.
      double approach = std::numeric_limits<double>::max();
      if (free.turns_finitely)
        approach = 1.01 * free.longest_motion()
                   * std::accumulate(range.fastest.begin(), range.fastest.end(), 0.);
      for (const auto &[gap, number] : of_pair)
        if (gap <= approach)
          {
            points.push_back(number);
            gaps.push_back(gap);
          }
      range.end = points.size();
      ranges.push_back(range);
    }
}

template <int dim>
dealii::Point<dim>
FreeBodies<dim>::Balance::place(const unsigned int i, const double sign) const
{
  dealii::Point<dim> x = free.contact.points()[i].feet[sign < 0. ? 0 : 1];
  if (free.turns_finitely)
    x += free.contact.mean_displacements()[i] + 0.5 * sign * free.contact.jumps()[i];
  return x;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::Balance::largest_motions(const unsigned int pair, const unsigned int begin,
                                          const unsigned int end) const
{
  const ContactPair &bodies = free.contact.pairs()[pair];
  Coordinates        result;
  for (const auto &[body, sign] : {std::make_pair(bodies.a, -1.), std::make_pair(bodies.b, 1.)})
    if (const unsigned int number = free.number_of[body]; number != none)
      {
        std::pair<dealii::Point<dim>, dealii::Point<dim>> corners(place(begin, sign),
                                                                  place(begin, sign));
        for (unsigned int i = begin; i < end; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double x    = place(i, sign)[d];
              corners.first[d]  = std::min(corners.first[d], x);
              corners.second[d] = std::max(corners.second[d], x);
            }
        // The length of a motion, linear in x, is largest at a corner of their box.
        const dealii::BoundingBox<dim> box(corners);
        for (unsigned int k = 0; k < free.bases[number].n(); ++k)
          {
            result.push_back(0.);
            for (unsigned int v = 0; v < 1u << dim; ++v)
              result.back() = std::max(result.back(), free.motion(number, k, box.vertex(v)).norm());
          }
      }
  return result;
}

template <int dim>
void
FreeBodies<dim>::Balance::add_columns(const unsigned int                   i,
                                      std::vector<dealii::Tensor<1, dim>> &columns) const
{
  const ContactPair &pair = free.contact.pairs()[free.contact.points()[i].pair];
  for (const auto &[body, sign] : {std::make_pair(pair.a, -1.), std::make_pair(pair.b, 1.)})
    if (const unsigned int number = free.number_of[body]; number != none)
      for (unsigned int k = 0; k < free.bases[number].n(); ++k)
        columns.push_back(sign * free.motion(number, k, place(i, sign)));
}

template <int dim>
void
FreeBodies<dim>::Balance::find_near(const Coordinates &q)
{
  near.clear();
  near_columns.clear();
  jumps.clear();
  for (Range &range : ranges)
    {
      const auto &coordinates = free.coordinates_of_pair[range.pair];
      double      approach    = ContactLaws<dim>::surely_open * free.cell_size;
      for (unsigned int k = 0; k < coordinates.size(); ++k)
        approach += std::abs(q[coordinates[k]]) * range.fastest[k];
      const auto end_of_near
        = std::upper_bound(gaps.begin() + range.begin, gaps.begin() + range.end, approach);
      const unsigned int end = end_of_near - gaps.begin();
      for (unsigned int j = range.begin + range.columns.size() / coordinates.size(); j < end; ++j)
        add_columns(points[j], range.columns);
      const auto *column = range.columns.data();
      for (unsigned int j = range.begin; j < end; ++j)
        {
          near.push_back(points[j]);
          near_columns.push_back(column);
          jumps.push_back(free.contact.jumps()[points[j]]);
          for (const unsigned int k : coordinates)
            jumps.back() += q[k] * *column++;
        }
    }
}

template <int dim>
void
FreeBodies<dim>::Balance::evaluate(const Coordinates &q)
{
  const auto         &contact  = free.contact;
  const unsigned int  n        = free.n_coordinates;
  const unsigned int  n_bodies = free.free_motions.size();
  std::vector<double> all(n + n_bodies + n_entries, 0.);
  find_near(q);
  const auto responses = contact.responses_to(near, jumps, history);
  for (unsigned int j = 0; j < near.size(); ++j)
    {
      const ContactPoint<dim> &point       = contact.points()[near[j]];
      const ContactPair       &pair        = contact.pairs()[point.pair];
      const auto              &coordinates = free.coordinates_of_pair[point.pair];
      const auto              *column      = near_columns[j];
      const auto              &response    = responses[j];
      const auto               traction    = point.weight * response.traction(point.normal);
      if (response.status != ContactStatus::open)
        {
          double *block = all.data() + n + n_bodies + first_of_pair[point.pair];
          for (unsigned int k = 0; k < coordinates.size(); ++k)
            {
              all[coordinates[k]] += column[k] * traction;
              const auto stiffness = point.weight * (column[k] * response.tangent);
              for (unsigned int l = 0; l < coordinates.size(); ++l)
                block[k * coordinates.size() + l] += stiffness * column[l];
            }
          for (const unsigned int body : {pair.a, pair.b})
            if (free.number_of[body] != none)
              all[n + free.number_of[body]] += traction.norm();
        }
    }
  dealii::Utilities::MPI::sum(all, free.communicator, all);
  forces.assign(all.begin(), all.begin() + n);
  acting.assign(all.begin() + n, all.begin() + n + n_bodies);
  blocks.assign(all.begin() + n + n_bodies, all.end());
  for (unsigned int k = 0; k < n; ++k)
    forces[k] += loads[k];
  for (unsigned int i = 0; i < n_bodies; ++i)
    acting[i] += free.magnitude(loads, i);
}

template <int dim>
bool
FreeBodies<dim>::Balance::is_balanced() const
{
  const Coordinates moments = free.rotations(forces);
  for (unsigned int i = 0; i < acting.size(); ++i)
    for (unsigned int k = free.first[i]; k < free.first[i] + free.bases[i].n(); ++k)
      if (std::abs(forces[k] - moments[k]) > (is_falling ? balanced : free.tolerance(i)) * acting[i]
          || std::abs(moments[k]) > free.tolerance(i) * acting[i])
        return false;
  return true;
}

template <int dim>
bool
FreeBodies<dim>::Balance::has_lost_contact() const
{
  for (unsigned int i = 0; i < acting.size(); ++i)
    if (free.magnitude(forces, i) > lost * acting[i])
      return true;
  return false;
}

template <int dim>
template <typename F>
void
FreeBodies<dim>::Balance::for_each_resisting(const F &act) const
{
  for (unsigned int p = 0; p < first_of_pair.size(); ++p)
    {
      const auto        n     = free.coordinates_of_pair[p].size();
      const auto *const block = blocks.data() + first_of_pair[p];
      if (std::any_of(block, block + n * n, [](const double entry) { return entry != 0.; }))
        act(p, block);
    }
}

template <int dim>
dealii::SparsityPattern
FreeBodies<dim>::Balance::pattern() const
{
  dealii::DynamicSparsityPattern entries(free.n_coordinates, free.n_coordinates);
  for (unsigned int k = 0; k < free.n_coordinates; ++k)
    entries.add(k, k);
  for_each_resisting([&](const unsigned int p, const double *) {
    const auto &coordinates = free.coordinates_of_pair[p];
    for (const unsigned int k : coordinates)
      entries.add_entries(k, coordinates.begin(), coordinates.end());
  });
  dealii::SparsityPattern result;
  result.copy_from(entries);
  return result;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::Balance::direction(const double length, const double damping)
{
  const dealii::SparsityPattern couplings = pattern();
  dealii::SparseMatrix<double>  K(couplings);
  for_each_resisting([&](const unsigned int p, const double *block) {
    const auto &coordinates = free.coordinates_of_pair[p];
    for (const unsigned int k : coordinates)
      for (const unsigned int l : coordinates)
        K.add(k, l, *block++);
  });
  // Alone, M would allow `length` with this s.
  double alone = 0., stiffest = 0.;
  for (unsigned int k = 0; k < mass.size(); ++k)
    {
      alone    = std::max(alone, std::abs(forces[k]) / (mass[k] * length));
      stiffest = std::max(stiffest, K.diag_element(k));
    }
  // KLU gives the same bits in every run: BLAS rounds by the alignment of its arrays, and which
  // contact closes first may hang on that.
  dealii::SolverControl                  control;
  dealii::TrilinosWrappers::SolverDirect solver(
    control, dealii::TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Klu"));
  dealii::TrilinosWrappers::SparseMatrix damped;
  damped.reinit(K, 0.);
  const dealii::Vector<double> right_side(forces.begin(), forces.end());
  dealii::Vector<double>       dq(forces.size());
  const auto                   fits = [&](const double s, dealii::Vector<double> &solution) {
    for (unsigned int k = 0; k < mass.size(); ++k)
      damped.set(k, k, K.diag_element(k) + s * mass[k]);
    damped.compress(dealii::VectorOperation::insert);
    solver.solve(damped, solution, right_side);
    return solution.linfty_norm() <= length;
  };
  std::vector<double> s = {std::max(damping * stiffest, 1e-6 * alone)};
  while (s.size() < max_trials)
    s.push_back(10. * s.back());
  // The s of the last direction is near.
  std::size_t i = std::upper_bound(s.begin() + 1, s.end(), 1.1 * last_s) - s.begin() - 1;
  if (fits(s[i], dq))
    for (auto smaller = dq; i > 0 && fits(s[i - 1], smaller); --i)
      dq = smaller;
  else
    while (i + 1 < s.size() && !fits(s[++i], dq))
      ;
  last_s = s[i];
  if (const double largest = dq.linfty_norm(); largest > length)
    dq *= length / largest;
  return Coordinates(dq.begin(), dq.end());
}

template <int dim>
double
FreeBodies<dim>::longest_motion() const
{
  return turns_finitely ? 0.5 * cell_size : cell_size;
}

template <int dim>
double
FreeBodies<dim>::tolerance(const unsigned int i) const
{
  return turns_finitely ? std::max(balanced, 0.25 * cell_size / rigid_motions[i].length())
                        : balanced;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::balancing(const Coordinates &loads, const ContactHistory<dim> &history,
                           const double negligible, const bool is_settling) const
{
  const double length     = longest_motion();
  const bool   is_falling = is_settling || !turns_finitely;
  const double least      = is_falling ? smallest_damping : first_damping;
  double       damping    = first_damping;
  Balance      balance(*this, loads, history, is_falling);
  Coordinates  q(n_coordinates, 0.);
  balance.evaluate(q);
  const auto is_negligible = [&]() {
    return std::inner_product(balance.forces.begin(), balance.forces.end(), balance.forces.begin(),
                              0.)
           <= negligible * negligible;
  };
  if (is_negligible() || (is_settling ? balance.is_balanced() : !balance.has_lost_contact()))
    return {};
  // Contact points stay where they are in a step: a moving geometry follows after a cell.
  const auto room = [&]() {
    double moved = 0.;
    for (const double part : q)
      moved = std::max(moved, std::abs(part));
    return turns_finitely ? length - moved : length;
  };
  for (unsigned int iteration = 0; iteration < max_iterations && !balance.is_balanced()
                                   && !is_negligible() && room() > 1e-3 * length;
       ++iteration)
    {
      const Coordinates dq    = balance.direction(room(), damping);
      const Coordinates start = q;
      const auto        along
        = [&]() { return std::inner_product(dq.begin(), dq.end(), balance.forces.begin(), 0.); };
      const auto go = [&](const double alpha) {
        for (unsigned int k = 0; k < q.size(); ++k)
          q[k] = start[k] + alpha * dq[k];
        balance.evaluate(q);
        return along();
      };
      const double before = along();
      const double after  = go(1.);
      damping             = std::max(least, 0.1 * damping);
      if (before > 0. && after < -overshoot * before)
        find_zero(go, before, 1., after, search_reduction * before, max_trials);
    }
  return q;
}

template <int dim>
double
FreeBodies<dim>::magnitude(const Coordinates &forces, const unsigned int i) const
{
  return std::sqrt(std::inner_product(forces.begin() + first[i],
                                      forces.begin() + first[i] + bases[i].n(),
                                      forces.begin() + first[i], 0.));
}

template <int dim>
double
FreeBodies<dim>::work(const Coordinates &forces, const Coordinates &motion) const
{
  double all = 0.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    all += magnitude(forces, i) * cell_size;
  return all == 0. ? 0.
                   : std::inner_product(forces.begin(), forces.end(), motion.begin(), 0.) / all;
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template std::vector<double> FreeBodies<dim>::balancing(                                        \
    const std::vector<double> &, const ContactHistory<dim> &, const double, const bool) const;    \
  template double FreeBodies<dim>::magnitude(const std::vector<double> &, const unsigned int)     \
    const;                                                                                        \
  template double FreeBodies<dim>::tolerance(const unsigned int) const;                           \
  template double FreeBodies<dim>::work(const std::vector<double> &, const std::vector<double> &) \
    const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
