#include <scree/contact/contact_normal.h>
#include <scree/contact/contact_surface.h>
#include <scree/contact/exact_distance.h>
#include <scree/contact/kinked_surface.h>
#include <scree/contact/least_gap.h>
#include <scree/grid/cell_bodies.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

namespace scree
{
namespace
{
/** Cuts the contact surface of one pair from cells. */
template <int dim>
class PairSurface
{
public:
  PairSurface(const LevelSetNodes<dim> &level_set_nodes, const std::vector<Body<dim>> &bodies,
              const ContactPair &pair, const ExactDistances<dim> &distances,
              const bool nodal_normals)
      : basis(level_set_nodes.basis())
      , level_set_nodes(level_set_nodes)
      , bodies(bodies)
      , pair(pair)
      , a(bodies[pair.a])
      , b(bodies[pair.b])
      , distances(distances)
      , nodal_normals(nodal_normals)
      , is_kinked(has_kinks(a) || has_kinks(b))
      , overshoots{{overshoots_in(a), overshoots_in(b)}}
      , rules(level_set_nodes.rules())
  {
  }

  /** The points in cell c of the grid. */
  std::vector<ContactPoint<dim>> points(const unsigned int c, const GridCell<dim> &cell,
                                        const unsigned int number);

private:
  using Values    = std::array<double, max_nodes_per_cell<dim>>;
  using Gradients = std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>>;

  static bool has_kinks(const Body<dim> &body)
  {
    return body.shape && !body.shape->is_smooth();
  }

  /** Whether interpolants of its level set are negative where a flat face begins to bend. */
  bool overshoots_in(const Body<dim> &body) const
  {
    return basis.degree > 1 && body.shape && body.shape->has_curvature_jumps();
  }

  /** grad (phi_a - phi_b) at the nodes of a cell, by cubic interpolation. */
  Gradients nodal_gradients(const GridCell<dim> &cell) const;

  /** The normal at x, where the nodal gradients have the mean `nodal`. */
  std::pair<dealii::Tensor<1, dim>, NormalOf> normal(const dealii::Point<dim> &x, const double size,
                                                     const dealii::Tensor<1, dim> &of_cut,
                                                     const dealii::Tensor<1, dim> &nodal) const;

  const LagrangeBasis<dim>     &basis;
  const LevelSetNodes<dim>     &level_set_nodes;
  const std::vector<Body<dim>> &bodies;
  const ContactPair            &pair;
  const Body<dim>              &a, &b;
  const ExactDistances<dim>    &distances;
  bool                          nodal_normals, is_kinked;
  std::array<bool, 2>           overshoots; //!< of a and b
  CutCellRules<dim>             rules;
};

template <int dim>
typename PairSurface<dim>::Gradients
PairSurface<dim>::nodal_gradients(const GridCell<dim> &cell) const
{
  Gradients result;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    {
      const dealii::Point<dim> x = cell.lower + cell.size * dealii::Tensor<1, dim>(basis.node(i));
      result[i]
        = a.level_set.value_and_gradient(x, 3).second - b.level_set.value_and_gradient(x, 3).second;
    }
  return result;
}

template <int dim>
std::pair<dealii::Tensor<1, dim>, NormalOf>
PairSurface<dim>::normal(const dealii::Point<dim> &x, const double size,
                         const dealii::Tensor<1, dim> &of_cut,
                         const dealii::Tensor<1, dim> &nodal) const
{
  const ContactNormal<dim> known
    = contact_normal(distances, bodies, pair.a, pair.b, x, size, of_cut);
  // For some cells beside edges nodal gradients are bent and deformed surfaces rough.
  const bool is_exact = (is_kinked && (known.of != NormalOf::both || known.is_undeformed))
                        || (known.of != NormalOf::both && known.is_flat);
  if (nodal_normals && !known.is_near_kink && !is_exact)
    return {nodal / nodal.norm(), NormalOf::both};
  return {known.normal, known.of};
}

template <int dim>
std::vector<ContactPoint<dim>>
PairSurface<dim>::points(const unsigned int c, const GridCell<dim> &cell, const unsigned int number)
{
  Values phi_a, phi_b, psi, scaled, shape;
  level_set_nodes.facing_values(c, a, -b.level_set.value_and_gradient(cell.centre(), 1).second,
                                phi_a.data());
  level_set_nodes.facing_values(c, b, -a.level_set.value_and_gradient(cell.centre(), 1).second,
                                phi_b.data());
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    psi[i] = phi_a[i] - phi_b[i];
  level_set_nodes.nudged(psi.data(), cell.size, scaled.data());
  const unsigned int n_negative = std::count_if(scaled.begin(), scaled.begin() + basis.n_nodes,
                                                [](const double value) { return value < 0.; });
  std::vector<ContactPoint<dim>> result;
  if (n_negative == 0 || n_negative == basis.n_nodes)
    return result;
  const double          negligible = 1e-8 * std::pow(cell.size, dim - 1);
  const CellPoints<dim> surface    = rules.rules(scaled.data(), cell.size).surface;
  const Gradients       gradients  = nodal_normals ? nodal_gradients(cell) : Gradients();
  for (unsigned int q = 0; q < surface.points.size(); ++q)
    {
      basis.evaluate_values(surface.points[q], shape.data());
      double                 distance_of_a = 0., distance_of_b = 0.;
      dealii::Tensor<1, dim> nodal;
      for (unsigned int i = 0; i < basis.n_nodes; ++i)
        {
          distance_of_a += shape[i] * phi_a[i];
          distance_of_b += shape[i] * phi_b[i];
          nodal += shape[i] * gradients[i];
        }
      // A contour through a vertex leaves points of no length in the cells that touch it.
      if (surface.weights[q] < negligible)
        continue;
      const dealii::Point<dim> x
        = cell.lower + cell.size * dealii::Tensor<1, dim>(surface.points[q]);
      if (overshoots[0] && distances.is_known(pair.a, x))
        distance_of_a = distances.value(pair.a, x);
      if (overshoots[1] && distances.is_known(pair.b, x))
        distance_of_b = distances.value(pair.b, x);
      const double gap          = distance_of_a + distance_of_b;
      const auto [n, normal_of] = normal(x, cell.size, surface.normals[q], nodal);
      result.push_back({number, x, n, surface.weights[q], gap, cell.size, n, gap});
      result.back().normal_of = normal_of;
      result.back().cell      = c;
    }
  return result;
}

/**
 * The pairs and the cells in which their surface may have points closer to both than `shift`, pair
 * by pair.
 */
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
cells_of_pairs(const BackgroundGrid<dim> &grid, const std::vector<Body<dim>> &bodies,
               const std::vector<ContactPair> &pairs, const double shift)
{
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> numbers;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    numbers[{pairs[p].a, pairs[p].b}] = p;
  const auto diagonal = [](const double size) { return std::sqrt(double(dim)) * size; };
  std::vector<std::pair<unsigned int, unsigned int>> result;
  std::vector<std::pair<unsigned int, double>>       here; // bodies, phi at the centre
  CellBodies<dim>(bodies).visit(
    grid.triangulation(), [&](const double size) { return shift + diagonal(size); },
    [&](const auto &iterator, const std::vector<unsigned int> &near) {
      const unsigned int   c     = grid.local_index(*iterator);
      const GridCell<dim> &cell  = grid.cells()[c];
      const double         reach = diagonal(cell.size);
      here.clear();
      for (const unsigned int b : near)
        {
          const double at_b = bodies[b].level_set.value(cell.centre(), 1);
          if (at_b > shift + reach)
            continue;
          for (const auto &[a, at_a] : here)
            if (std::abs(at_a - at_b) <= 2. * reach)
              if (const auto found = numbers.find({a, b}); found != numbers.end())
                result.emplace_back(found->second, c);
          here.emplace_back(b, at_b);
        }
    });
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

template <int dim>
std::vector<ContactPoint<dim>>
contact_surface(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                const double shift, const ExactDistances<dim> &distances, const bool nodal_normals)
{
  const BackgroundGrid<dim>     &grid = space.grid;
  KinkedSurface<dim>             kinked(distances, bodies, level_set_nodes);
  std::vector<ContactPoint<dim>> points;
  const auto                     of_pairs = cells_of_pairs(grid, bodies, pairs, shift);
  for (auto entry = of_pairs.begin(); entry != of_pairs.end();)
    {
      const unsigned int p = entry->first;
      PairSurface<dim>   surface(level_set_nodes, bodies, pairs[p], distances, nodal_normals);
      LeastGap<dim>      least_gap(distances, bodies, pairs[p]);
      for (; entry != of_pairs.end() && entry->first == p; ++entry)
        {
          const unsigned int   c         = entry->second;
          const GridCell<dim> &cell      = grid.cells()[c];
          const bool           is_kinked = kinked.concerns(pairs[p], cell);
          auto of_cell = is_kinked ? kinked.points(p, pairs[p], cell) : surface.points(c, cell, p);
          // An edge or corner has small points of its own.
          if (!is_kinked)
            least_gap.add_point(cell, of_cell);
          std::copy_if(of_cell.begin(), of_cell.end(), std::back_inserter(points),
                       [&](const auto &point) { return point.initial_gap <= 2. * shift; });
        }
    }
  return points;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template std::vector<ContactPoint<dim>> contact_surface(                                      \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &, \
    const std::vector<ContactPair> &, const double, const ExactDistances<dim> &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
