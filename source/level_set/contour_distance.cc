#include <scree/level_set/closest_point.h>
#include <scree/level_set/contour_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
// Second differences above this fraction of the first differences mark a kink (a smooth contour
// reaches it at a radius of curvature of 3 spacings).
constexpr double kink_threshold = 0.3;

// Where closest points are looked for, in spacings.
constexpr double reach = 6;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool
opposite(const double a, const double b)
{
  return (a < 0) != (b < 0);
}

template <int dim>
std::array<std::ptrdiff_t, dim>
strides(const Lattice<dim> &lattice)
{
  std::array<std::ptrdiff_t, dim> result;
  std::ptrdiff_t                  step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result[d] = step;
      step *= lattice.n_nodes()[d];
    }
  return result;
}

// Calls `f(i, i + s)` for all edges of the lattice, s the stride of their axis.
template <int dim, typename F>
void
for_each_edge(const Lattice<dim> &lattice, const F &f)
{
  const std::ptrdiff_t n_values = lattice.values().size();
  const auto           stride   = strides(lattice);
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::ptrdiff_t s = stride[d], block = s * lattice.n_nodes()[d];
      for (std::ptrdiff_t start = 0; start < n_values; start += block)
        for (std::ptrdiff_t i = start; i < start + block - s; ++i)
          f(i, i + s);
    }
}
} // namespace

template <int dim>
std::vector<std::size_t>
nodes_at_cut_edges(const Lattice<dim> &lattice)
{
  const std::vector<double> &values = lattice.values();
  std::vector<char>          cut(values.size(), 0);
  for_each_edge(lattice, [&](const std::ptrdiff_t i, const std::ptrdiff_t j) {
    const char is_cut = opposite(values[i], values[j]);
    cut[i] |= is_cut;
    cut[j] |= is_cut;
  });
  std::vector<char> near = cut;
  for_each_edge(lattice, [&](const std::ptrdiff_t i, const std::ptrdiff_t j) {
    near[i] |= cut[j];
    near[j] |= cut[i];
  });
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (near[i])
      result.push_back(i);
  return result;
}

// The edges within 2 spacings of a node, along the axes, that the contour cuts.
template <int dim>
struct ContourDistance<dim>::CutEdges
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

template <int dim>
ContourDistance<dim>::ContourDistance(const Lattice<dim> &lattice)
    : lattice(lattice)
    , stride(strides(lattice))
    , kinks(lattice.values().size(), 0)
{
}

template <int dim>
bool
ContourDistance<dim>::exists(const Index &node, const unsigned int axis, const int step) const
{
  const int position = node[axis] + step - lattice.lower()[axis];
  return position >= 0 && position < lattice.n_nodes()[axis];
}

template <int dim>
bool
ContourDistance<dim>::is_kink(const std::size_t offset) const
{
  const Index   node         = lattice.index(offset);
  const double *value        = lattice.values().data() + offset;
  double        first_square = 0, second = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      // at an end of the lattice the only difference counts twice
      const bool   below = exists(node, d, -1), above = exists(node, d, 1);
      const double backward = below ? value[0] - value[-stride[d]] : value[stride[d]] - value[0];
      const double forward  = above ? value[stride[d]] - value[0] : backward;
      first_square += std::max(backward * backward, forward * forward);
      second = std::max(second, std::abs(forward - backward));
    }
  return second > kink_threshold * std::sqrt(first_square);
}

template <int dim>
bool
ContourDistance<dim>::kink_near(const Index &node, const int reach)
{
  std::array<int, 3> first{}, last{};
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int position = node[d] - lattice.lower()[d];
      first[d]           = std::max(position - reach, 0);
      last[d]            = std::min(position + reach, lattice.n_nodes()[d] - 1);
    }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        {
          const std::size_t at   = i + j * stride[1] + (dim == 3 ? k * stride[dim - 1] : 0);
          char             &kink = kinks[at];
          if (kink == 0)
            kink = is_kink(at) ? 2 : 1;
          if (kink == 2)
            return true;
        }
  return false;
}

template <int dim>
typename ContourDistance<dim>::CutEdges
ContourDistance<dim>::cut_edges(const Index &node, const std::size_t offset) const
{
  const double *value = lattice.values().data() + offset;
  CutEdges      result;
  double        inverse_square = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      double axis_distance = infinity;
      for (const int side : {-1, 1})
        for (int step = 1; step <= 2; ++step)
          if (exists(node, d, side * step) && opposite(value[0], value[side * step * stride[d]]))
            {
              const double near = value[side * (step - 1) * stride[d]];
              const double far  = value[side * step * stride[d]];
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
Point<dim>
ContourDistance<dim>::cut_of_edge(const unsigned int degree, const Point<dim> &a,
                                  const Point<dim> &b) const
{
  // the Illinois method
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

template <int dim>
double
ContourDistance<dim>::distance_to_foot(const Point<dim> &x, const unsigned int degree,
                                       const Point<dim> &start) const
{
  const ClosestPoint<dim> foot     = closest_point(lattice, x, degree, start);
  const double            distance = x.distance(foot.point);
  const bool              found    = foot.converged && lattice.box().point_inside(foot.point, 1e-9)
                     && distance < reach * lattice.spacing();
  return found ? distance : infinity;
}

template <int dim>
double
ContourDistance<dim>::unsigned_distance(const std::size_t offset)
{
  const Index      node = lattice.index(offset);
  const Point<dim> x    = lattice.node(node);
  const CutEdges   cuts = cut_edges(node, offset);

  // The interpolation stencils around the foot reach no further than this.
  const int          stencil  = cuts.nearest <= lattice.spacing() ? 1 : 2;
  const unsigned int degree   = kink_near(node, stencil) ? 1 : 3;
  double             distance = distance_to_foot(x, degree, x);
  if (degree == 3 && distance <= cuts.nearest)
    return distance;

  // A nearer part of the contour, or a corner, may be found from where the edges are cut.
  double nearest = cuts.n_edges > 0 ? infinity : reach * lattice.spacing();
  for (unsigned int i = 0; i < cuts.n_edges; ++i)
    {
      const auto &[axis, side, step] = cuts.edges[i];
      Point<dim> near = x, far = x;
      near[axis] += side * (step - 1) * lattice.spacing();
      far[axis] += side * step * lattice.spacing();
      const Point<dim> cut = cut_of_edge(degree, near, far);
      nearest              = std::min(nearest, x.distance(cut));
      distance             = std::min(distance, distance_to_foot(x, degree, cut));
    }
  return distance <= nearest * (1 + 1e-8) ? distance : cuts.estimate;
}

template <int dim>
double
ContourDistance<dim>::operator()(const std::size_t offset)
{
  const double value = lattice.values()[offset];
  return value == 0 ? 0 : std::copysign(unsigned_distance(offset), value);
}

#define INSTANTIATE(dim)                                                      \
  template std::vector<std::size_t> nodes_at_cut_edges(const Lattice<dim> &); \
  template class ContourDistance<dim>;

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
