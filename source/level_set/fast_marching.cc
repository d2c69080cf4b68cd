#include <scree/level_set/closest_point.h>
#include <scree/level_set/fast_marching.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace scree
{
using namespace dealii;

namespace
{
// Second differences above this fraction of the first differences mark a kink (a smooth contour
// reaches it at a radius of curvature of 3 spacings).
constexpr double kink_threshold = 0.3;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The nodes of a lattice by their offset, with their neighbours along the axes.
template <int dim>
class Neighbours
{
public:
  explicit Neighbours(const Lattice<dim> &lattice);

  bool exists(const typename Lattice<dim>::Index &node, const unsigned int axis,
              const int step) const
  {
    const int position = node[axis] + step - lower[axis];
    return position >= 0 && position < n_nodes[axis];
  }

  std::array<std::ptrdiff_t, dim> stride;

private:
  typename Lattice<dim>::Index lower, n_nodes;
};

template <int dim>
Neighbours<dim>::Neighbours(const Lattice<dim> &lattice)
    : lower(lattice.lower())
    , n_nodes(lattice.n_nodes())
{
  std::ptrdiff_t step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      step *= n_nodes[d];
    }
}

bool
opposite(const double a, const double b)
{
  return (a < 0) != (b < 0);
}

// Whether a second difference at a node is large against the gradient there.
template <int dim>
bool
is_kink(const Lattice<dim> &lattice, const Neighbours<dim> &neighbours, const std::size_t offset)
{
  const auto    node         = lattice.index(offset);
  const double *value        = lattice.values().data() + offset;
  double        first_square = 0, second = 0;
  for (unsigned int d = 0; d < dim; ++d)
    if (neighbours.exists(node, d, -1) && neighbours.exists(node, d, 1))
      {
        const double backward = value[0] - value[-neighbours.stride[d]];
        const double forward  = value[neighbours.stride[d]] - value[0];
        first_square += std::max(backward * backward, forward * forward);
        second = std::max(second, std::abs(forward - backward));
      }
  return second > kink_threshold * std::sqrt(first_square);
}

// The nodes with a cut edge, and their neighbours along the axes.
template <int dim>
std::vector<std::size_t>
nodes_near_contour(const Lattice<dim> &lattice, const Neighbours<dim> &neighbours)
{
  const std::vector<double> &values = lattice.values();
  std::vector<char>          cut(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
    {
      const auto node = lattice.index(i);
      for (unsigned int d = 0; d < dim; ++d)
        if (neighbours.exists(node, d, 1) && opposite(values[i], values[i + neighbours.stride[d]]))
          cut[i] = cut[i + neighbours.stride[d]] = 1;
    }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < values.size(); ++i)
    {
      bool       near = cut[i];
      const auto node = lattice.index(i);
      for (unsigned int d = 0; d < dim && !near; ++d)
        for (const int side : {-1, 1})
          near = near || (neighbours.exists(node, d, side) && cut[i + side * neighbours.stride[d]]);
      if (near)
        result.push_back(i);
    }
  return result;
}

// Where the interpolant of `degree` vanishes between a and b, by the Illinois method.
template <int dim>
Point<dim>
cut_of_edge(const Lattice<dim> &lattice, const unsigned int degree, const Point<dim> &a,
            const Point<dim> &b)
{
  double ta = 0, tb = 1, fa = lattice.value(a, degree), fb = lattice.value(b, degree);
  double t = fa / (fa - fb);
  for (unsigned int iteration = 0; iteration < 30; ++iteration)
    {
      const double f = lattice.value(a + t * (b - a), degree);
      if (std::abs(f) <= 1e-12 * std::abs(fa - fb) || tb - ta < 1e-12)
        break;
      if (opposite(f, fa))
        {
          tb = t;
          fb = f;
          fa *= 0.5;
        }
      else
        {
          ta = t;
          fa = f;
          fb *= 0.5;
        }
      t = (ta * fb - tb * fa) / (fb - fa);
    }
  return a + t * (b - a);
}

// The edges within 2 spacings of a node, along the axes, that the contour cuts.
template <int dim>
struct CutEdges
{
  struct Edge
  {
    unsigned int axis;
    int          side; // direction along the axis
    int          step; // 1 next to the node, 2 beyond
  };
  std::array<Edge, 2 * dim> edges;
  unsigned int              n_edges  = 0;
  double                    nearest  = infinity; // distance to the nearest cut, values linear
  double                    estimate = infinity; // distance to the plane through the cuts
};

// The distances of nodes next to the contour.
template <int dim>
class ContourDistance
{
public:
  ContourDistance(const Lattice<dim> &lattice, const Neighbours<dim> &neighbours)
      : lattice(lattice)
      , neighbours(neighbours)
      , kinks(lattice.values().size())
  {
    for (std::size_t i = 0; i < kinks.size(); ++i)
      kinks[i] = is_kink(lattice, neighbours, i);
  }

  // The unsigned distance of one node.
  double operator()(std::size_t offset) const;

private:
  // 1 if a kink is within `reach` nodes along every axis, else 3.
  unsigned int degree_around(const typename Lattice<dim>::Index &node, int reach) const;

  CutEdges<dim> cut_edges(std::size_t offset) const;

  // Distance to the closest point found from `start`, infinity if there is none nearby.
  double distance_to_foot(const Point<dim> &x, unsigned int degree, const Point<dim> &start) const;

  const Lattice<dim>    &lattice;
  const Neighbours<dim> &neighbours;
  std::vector<char>      kinks;
};

template <int dim>
unsigned int
ContourDistance<dim>::degree_around(const typename Lattice<dim>::Index &node, const int reach) const
{
  std::array<int, 3> first{}, last{};
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int lower = lattice.lower()[d];
      first[d]        = std::max(node[d] - reach, lower);
      last[d]         = std::min(node[d] + reach, lower + lattice.n_nodes()[d] - 1);
    }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        {
          typename Lattice<dim>::Index index;
          index[0] = i;
          index[1] = j;
          if constexpr (dim == 3)
            index[2] = k;
          if (kinks[lattice.offset(index)])
            return 1;
        }
  return 3;
}

template <int dim>
CutEdges<dim>
ContourDistance<dim>::cut_edges(const std::size_t offset) const
{
  const auto    node  = lattice.index(offset);
  const double *value = lattice.values().data() + offset;
  CutEdges<dim> result;
  double        inverse_square = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      double axis_distance = infinity;
      for (const int side : {-1, 1})
        for (int step = 1; step <= 2; ++step)
          if (neighbours.exists(node, d, side * step)
              && opposite(value[0], value[side * step * neighbours.stride[d]]))
            {
              const double near = value[side * (step - 1) * neighbours.stride[d]];
              const double far  = value[side * step * neighbours.stride[d]];
              axis_distance
                = std::min(axis_distance, lattice.spacing() * (step - 1 + near / (near - far)));
              result.edges[result.n_edges++] = {d, side, step};
              break;
            }
      inverse_square += 1 / (axis_distance * axis_distance);
      result.nearest = std::min(result.nearest, axis_distance);
    }
  result.estimate = inverse_square > 0 ? 1 / std::sqrt(inverse_square) : infinity;
  return result;
}

template <int dim>
double
ContourDistance<dim>::distance_to_foot(const Point<dim> &x, const unsigned int degree,
                                       const Point<dim> &start) const
{
  const ClosestPoint<dim> foot     = closest_point(lattice, x, degree, start);
  const double            distance = x.distance(foot.point);
  const bool              found    = foot.converged && lattice.box().point_inside(foot.point, 1e-9)
                     && distance < 4 * lattice.spacing();
  return found ? distance : infinity;
}

template <int dim>
double
ContourDistance<dim>::operator()(const std::size_t offset) const
{
  if (lattice.values()[offset] == 0)
    return 0;
  const auto          node = lattice.index(offset);
  const Point<dim>    x    = lattice.node(node);
  const CutEdges<dim> cuts = cut_edges(offset);

  // The interpolation stencils around the foot reach no further than this.
  const unsigned int degree   = degree_around(node, cuts.nearest <= lattice.spacing() ? 1 : 2);
  double             distance = distance_to_foot(x, degree, x);
  if (degree == 3 && distance <= cuts.nearest)
    return distance;

  // A nearer part of the contour, or a corner, may be found from where the edges are cut.
  double nearest = cuts.n_edges > 0 ? infinity : 4 * lattice.spacing();
  for (unsigned int i = 0; i < cuts.n_edges; ++i)
    {
      const auto &[axis, side, step] = cuts.edges[i];
      Point<dim> near = x, far = x;
      near[axis] += side * (step - 1) * lattice.spacing();
      far[axis] += side * step * lattice.spacing();
      const Point<dim> cut = cut_of_edge(lattice, degree, near, far);
      nearest              = std::min(nearest, x.distance(cut));
      distance             = std::min(distance, distance_to_foot(x, degree, cut));
    }
  return distance <= nearest * (1 + 1e-8) ? distance : cuts.estimate;
}

// The upwind difference along one axis: slope (T - base) with slope = 1/h or 3/(2h).
struct UpwindDifference
{
  double slope = 0, base = infinity, nearest = infinity;
};

// The largest T with sum_i slope_i^2 (T - base_i)^2 = 1 over as many axes, sorted by their nearest
// value, as influence T.
template <int dim>
double
solve_eikonal(std::array<UpwindDifference, dim> &axes)
{
  std::sort(axes.begin(), axes.end(),
            [](const auto &a, const auto &b) { return a.nearest < b.nearest; });
  double a = 0, b = 0, c = -1, result = infinity;
  for (const UpwindDifference &axis : axes)
    {
      if (!(axis.nearest < result))
        break;
      const double square = axis.slope * axis.slope;
      const double a_new = a + square, b_new = b + square * axis.base,
                   c_new        = c + square * axis.base * axis.base;
      const double discriminant = b_new * b_new - a_new * c_new;
      if (discriminant < 0)
        break;
      const double candidate = (b_new + std::sqrt(discriminant)) / a_new;
      if (candidate < axis.nearest)
        break;
      a      = a_new;
      b      = b_new;
      c      = c_new;
      result = candidate;
    }
  return result;
}

// Fast marching over the nodes of one side; the nodes `accepted` at the start are its seeds.
template <int dim>
class Marching
{
public:
  // `side` is 1 (positive nodes) or -1; `values` are signed distances where `accepted`.
  Marching(const Lattice<dim> &lattice, const Neighbours<dim> &neighbours,
           const std::vector<char> &positive, const double side, std::vector<double> &values,
           std::vector<char> &accepted);

  void run();

private:
  using Entry = std::pair<double, std::size_t>;

  void update_neighbours(std::size_t offset);

  double distance(const typename Lattice<dim>::Index &node, std::size_t offset) const;

  const Lattice<dim>      &lattice;
  const Neighbours<dim>   &neighbours;
  const std::vector<char> &positive;
  const double             side;
  std::vector<double>     &values;
  std::vector<char>       &accepted;
  std::vector<double>      tentative;

  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> heap;
};

template <int dim>
Marching<dim>::Marching(const Lattice<dim> &lattice, const Neighbours<dim> &neighbours,
                        const std::vector<char> &positive, const double side,
                        std::vector<double> &values, std::vector<char> &accepted)
    : lattice(lattice)
    , neighbours(neighbours)
    , positive(positive)
    , side(side)
    , values(values)
    , accepted(accepted)
    , tentative(values.size(), infinity)
{
}

template <int dim>
double
Marching<dim>::distance(const typename Lattice<dim>::Index &node, const std::size_t offset) const
{
  const double                      h = lattice.spacing();
  std::array<UpwindDifference, dim> axes;
  for (unsigned int d = 0; d < dim; ++d)
    for (const int step : {-1, 1})
      {
        const std::size_t next = offset + step * neighbours.stride[d];
        if (!neighbours.exists(node, d, step) || !accepted[next])
          continue;
        const double nearest = side * values[next];
        if (nearest >= axes[d].nearest)
          continue;
        axes[d]                = {1 / h, nearest, nearest};
        const std::size_t over = next + step * neighbours.stride[d];
        if (neighbours.exists(node, d, 2 * step) && accepted[over]
            && side * values[over] <= nearest)
          axes[d] = {1.5 / h, (4 * nearest - side * values[over]) / 3, nearest};
      }
  return solve_eikonal<dim>(axes);
}

template <int dim>
void
Marching<dim>::update_neighbours(const std::size_t offset)
{
  const auto node = lattice.index(offset);
  for (unsigned int d = 0; d < dim; ++d)
    for (const int step : {-1, 1})
      {
        const std::size_t next = offset + step * neighbours.stride[d];
        if (!neighbours.exists(node, d, step) || accepted[next]
            || (side > 0) != bool(positive[next]))
          continue;
        auto next_node = node;
        next_node[d] += step;
        const double candidate = distance(next_node, next);
        if (candidate < tentative[next])
          {
            tentative[next] = candidate;
            heap.emplace(candidate, next);
          }
      }
}

template <int dim>
void
Marching<dim>::run()
{
  for (std::size_t i = 0; i < accepted.size(); ++i)
    if (accepted[i] && (side > 0) == bool(positive[i]))
      update_neighbours(i);
  while (!heap.empty())
    {
      const auto [value, offset] = heap.top();
      heap.pop();
      if (accepted[offset])
        continue;
      accepted[offset] = 1;
      values[offset]   = side * value;
      update_neighbours(offset);
    }
}
} // namespace

template <int dim>
bool
has_contour(const Lattice<dim> &lattice)
{
  const auto is_negative = [](const double value) { return value < 0; };
  const auto n_negative
    = std::count_if(lattice.values().begin(), lattice.values().end(), is_negative);
  return n_negative > 0 && n_negative < static_cast<std::ptrdiff_t>(lattice.values().size());
}

template <int dim>
void
compute_distances(Lattice<dim> &lattice)
{
  AssertThrow(has_contour(lattice),
              ExcMessage("The level set has no zero contour on its lattice."));
  const Neighbours<dim>      neighbours(lattice);
  const ContourDistance<dim> contour_distance(lattice, neighbours);
  const std::size_t          n_values = lattice.values().size();

  std::vector<char> positive(n_values), accepted(n_values, 0);
  for (std::size_t i = 0; i < n_values; ++i)
    positive[i] = !(lattice.values()[i] < 0);

  std::vector<double> distances(n_values, infinity);
  for (const std::size_t i : nodes_near_contour(lattice, neighbours))
    {
      const double distance = contour_distance(i);
      accepted[i]           = distance < infinity;
      distances[i]          = positive[i] ? distance : -distance;
    }
  for (const double side : {1., -1.})
    Marching<dim>(lattice, neighbours, positive, side, distances, accepted).run();
  lattice.values() = std::move(distances);
}

#define INSTANTIATE(dim)                           \
  template bool has_contour(const Lattice<dim> &); \
  template void compute_distances(Lattice<dim> &);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
