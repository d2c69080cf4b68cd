#include <scree/level_set/node_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
bool
contains(const NodeBox<dim> &box, const NodeBox<dim> &part)
{
  bool result = true;
  for (unsigned int d = 0; d < dim; ++d)
    result &= box.lower[d] <= part.lower[d]
              && part.lower[d] + part.n_nodes[d] <= box.lower[d] + box.n_nodes[d];
  return result;
}

template <int dim>
NodeBox<dim>
merged(const NodeBox<dim> &a, const NodeBox<dim> &b)
{
  NodeBox<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result.lower[d] = std::min(a.lower[d], b.lower[d]);
      result.n_nodes[d]
        = std::max(a.lower[d] + a.n_nodes[d], b.lower[d] + b.n_nodes[d]) - result.lower[d];
    }
  return result;
}

template <int dim>
NodeBox<dim>
all_nodes(const Lattice<dim> &lattice)
{
  return {lattice.lower(), lattice.n_nodes()};
}
} // namespace

template <int dim>
std::optional<NodeBox<dim>>
box_of_negative_nodes(const LatticeFrame<dim> &frame, const NodeBox<dim> &box,
                      const std::function<double(const Point<dim> &)> &phi)
{
  using Index = typename Lattice<dim>::Index;
  std::optional<NodeBox<dim>> result;
  search_nodes(box, [&](const NodeBox<dim> &part, const Index &centre, const double radius) {
    if (result && contains(*result, part))
      return false;
    Point<dim> x = frame.origin;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += frame.spacing * centre[d];
    const double value = phi(x), change = slope_bound * frame.spacing * radius;
    if (value + change < 0.)
      {
        result = result ? merged(*result, part) : part;
        return false;
      }
    return !(value >= change); // true where it is no number
  });
  return result;
}

template <int dim>
double
smallest_value(const Lattice<dim> &lattice)
{
  using Index = typename Lattice<dim>::Index;
  if (!lattice.is_tiled())
    return *std::min_element(lattice.values().begin(), lattice.values().end());
  double result = std::numeric_limits<double>::max();
  search_nodes(all_nodes(lattice),
               [&](const NodeBox<dim> &, const Index &centre, const double radius) {
                 const double value = lattice.passing_value(centre);
                 if (value - slope_bound * lattice.spacing() * radius > result)
                   return false;
                 result = std::min(result, value);
                 return true;
               });
  return result;
}

template <int dim>
std::vector<typename Lattice<dim>::Index>
nodes_below(const Lattice<dim> &lattice, const double level)
{
  using Index = typename Lattice<dim>::Index;
  std::vector<Index> result;
  for (std::size_t i = 0; i < lattice.values().size() && !lattice.is_tiled(); ++i)
    if (lattice.values()[i] < level)
      result.push_back(lattice.index(i));
  if (!lattice.is_tiled())
    return result;
  search_nodes(all_nodes(lattice),
               [&](const NodeBox<dim> &, const Index &centre, const double radius) {
                 const double value = lattice.passing_value(centre);
                 if (radius == 0. && value < level)
                   result.push_back(centre);
                 return value - slope_bound * lattice.spacing() * radius < level;
               });
  std::sort(result.begin(), result.end(), [](const Index &a, const Index &b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  });
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                             \
  template std::optional<NodeBox<dim>> box_of_negative_nodes(                              \
    const LatticeFrame<dim> &, const NodeBox<dim> &,                                       \
    const std::function<double(const Point<dim> &)> &);                                    \
  template double                                    smallest_value(const Lattice<dim> &); \
  template std::vector<typename Lattice<dim>::Index> nodes_below(const Lattice<dim> &, double);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
