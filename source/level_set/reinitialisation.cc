#include <scree/level_set/closest_point.h>
#include <scree/level_set/contour_distance.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/halo_grid.h>
#include <scree/level_set/reinitialisation.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
constexpr signed char full_weight = 6;
constexpr int         kink_reach  = 2; // nodes
constexpr int         strip_width = 2; // nodes beyond those of cut cells
constexpr double      near_reach  = 4; // spacings; up to there values may stay when others do not

template <int dim>
class Reinitialisation
{
public:
  Reinitialisation(Lattice<dim> &lattice, const ReinitialisationOptions &options);

  ReinitialisationCount run();

private:
  using Index = typename Lattice<dim>::Index;

  void find_strip();

  // Writes what slopes deviate into `count`, and the weights of nodes beyond the tolerance. The
  // strip has one weight.
  void measure_slopes();

  // The weights of the rebuilt values: 1 up to 2 steps from nodes beyond the tolerance, falling to
  // 0 over 6 more.
  void spread_weights();

  void rebuild_strip();

  void rebuild_rest();

  // Nodes of the strip near kinks, whose factors are unknown (0), take those of the others.
  void spread_factors(std::vector<double> &factors) const;

  // The points of the contour at its cuts of edges.
  std::vector<Point<dim>> contour_points() const;

  // Calls `f(node, with_halo)` for all nodes up to the width of the band.
  template <typename F>
  void for_each_node(const F &f) const;

  Lattice<dim>                  &lattice;
  const ReinitialisationOptions &options;
  std::array<std::size_t, dim>   stride;
  NodeSet<dim>                   nodes;    // that are watched
  std::vector<unsigned char>     in_strip; // with halo
  std::vector<signed char>       weight;   // with halo, times 6
  std::vector<std::size_t>       strip;    // in order
  ContourDistance<dim>           contour_distance;
  ReinitialisationCount          count{0, 0, 0, 0, 0};
};

template <int dim>
Reinitialisation<dim>::Reinitialisation(Lattice<dim>                  &lattice,
                                        const ReinitialisationOptions &options)
    : lattice(lattice)
    , options(options)
    , nodes(nodes_near_contour(HaloGrid<dim>{lattice.n_nodes(), lattice.spacing()},
                               lattice.values(), options.band * lattice.spacing()))
    , contour_distance(lattice)
{
  Assert(options.band >= 2 * near_reach, ExcMessage("A band of at least 8 spacings."));
  std::size_t step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      step *= lattice.n_nodes()[d];
    }
  find_strip();
}

template <int dim>
template <typename F>
void
Reinitialisation<dim>::for_each_node(const F &f) const
{
  for (const NodeRun &run : nodes.runs)
    for (int i = 0; i < run.n; ++i)
      f(run.node + i, run.with_halo + i);
}

template <int dim>
void
Reinitialisation<dim>::find_strip()
{
  // Where both signs are within n + 1 nodes there is a cut cell within n.
  constexpr int width = strip_width + 1;
  static_assert(width <= HaloGrid<dim>::width, "The halo is too narrow.");
  in_strip.assign(nodes.grid.size(), 0);
  for_each_node([&](const std::size_t node, const std::size_t at) {
    in_strip[at] = lattice.values()[node] < 0 ? 1 : 2;
  });
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<unsigned char> signs = in_strip;
      const std::ptrdiff_t             step  = nodes.grid.stride(d);
      for (const NodeRun &run : nodes.runs)
        for (int k = -width; k <= width; ++k)
          for (int i = 0; i < run.n; ++i)
            in_strip[run.with_halo + i] |= signs[run.with_halo + i + k * step];
    }
  for_each_node([&](const std::size_t node, const std::size_t at) {
    in_strip[at] = in_strip[at] == 3;
    if (in_strip[at])
      strip.push_back(node);
  });
}

template <int dim>
void
Reinitialisation<dim>::measure_slopes()
{
  const double *values = lattice.values().data();
  const Index  &n      = lattice.n_nodes();
  weight.assign(nodes.grid.size(), 0);
  for (const NodeRun &run : nodes.runs)
    {
      bool at_end = false;
      for (unsigned int d = 1; d < dim; ++d)
        {
          const int row = run.node / stride[d] % n[d];
          at_end |= row == 0 || row == n[d] - 1;
        }
      if (at_end)
        continue;
      const int x = run.node % n[0];
      for (int i = std::max(1 - x, 0); i < std::min(n[0] - 1 - x, run.n); ++i)
        {
          const std::size_t node   = run.node + i;
          double            square = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double difference = values[node + stride[d]] - values[node - stride[d]];
              square += difference * difference;
            }
          const double deviation = std::abs(std::sqrt(square) / (2 * lattice.spacing()) - 1);
          const bool   is_near   = in_strip[run.with_halo + i];
          double      &largest   = is_near ? count.deviation_near : count.deviation_far;
          if (deviation > options.tolerance)
            {
              if (contour_distance.kink_near(lattice.index(node), kink_reach))
                continue;
              weight[run.with_halo + i] = full_weight + 2;
            }
          largest = std::max(largest, deviation);
        }
    }
}

template <int dim>
void
Reinitialisation<dim>::spread_weights()
{
  if (count.n_changed_near > 0)
    for_each_node([&](const std::size_t, const std::size_t at) {
      if (in_strip[at])
        weight[at] = full_weight + 2;
    });
  // to neighbours less 1, axis by axis
  const auto raise = [&](const std::size_t at, const std::size_t neighbour) {
    weight[at] = std::max(weight[at], static_cast<signed char>(weight[neighbour] - 1));
  };
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::size_t step = nodes.grid.stride(d);
      for_each_node([&](const std::size_t, const std::size_t at) { raise(at, at - step); });
      for (auto run = nodes.runs.rbegin(); run != nodes.runs.rend(); ++run)
        for (int i = run->n - 1; i >= 0; --i)
          raise(run->with_halo + i, run->with_halo + i + step);
    }
}

template <int dim>
void
Reinitialisation<dim>::spread_factors(std::vector<double> &factors) const
{
  const auto factor_of = [&](const std::size_t node) {
    const auto at = std::lower_bound(strip.begin(), strip.end(), node);
    return at != strip.end() && *at == node ? factors[at - strip.begin()] : 0.;
  };
  std::vector<std::size_t> open; // positions in the strip
  for (std::size_t b = 0; b < strip.size(); ++b)
    if (factors[b] == 0)
      open.push_back(b);
  while (!open.empty())
    {
      std::vector<std::pair<std::size_t, double>> found;
      std::vector<std::size_t>                    still_open;
      for (const std::size_t b : open)
        {
          const Index  node = lattice.index(strip[b]);
          double       sum  = 0;
          unsigned int n    = 0;
          for (unsigned int d = 0; d < dim; ++d)
            for (const int side : {-1, 1})
              {
                Index neighbour = node;
                neighbour[d] += side;
                if (!lattice.contains(neighbour))
                  continue;
                const double factor = factor_of(lattice.offset(neighbour));
                sum += factor;
                n += factor > 0;
              }
          if (n > 0)
            found.emplace_back(b, sum / n);
          else
            still_open.push_back(b);
        }
      if (found.empty())
        for (const std::size_t b : still_open)
          found.emplace_back(b, 1.);
      for (const auto &[b, factor] : found)
        factors[b] = factor;
      open.swap(still_open);
    }
}

template <int dim>
std::vector<Point<dim>>
Reinitialisation<dim>::contour_points() const
{
  std::vector<Point<dim>> result;
  const double           *values = lattice.values().data();
  for (const std::size_t i : strip)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Index node = lattice.index(i);
        if (node[d] + 1 == lattice.lower()[d] + lattice.n_nodes()[d])
          continue;
        const double a = values[i], b = values[i + stride[d]];
        if ((a < 0) == (b < 0))
          continue;
        Point<dim> cut = lattice.node(node);
        cut[d] += a / (a - b) * lattice.spacing();
        const ClosestPoint<dim> foot = project(lattice, cut, options.degree);
        if (foot.converged)
          result.push_back(foot.point);
      }
  return result;
}

template <int dim>
void
Reinitialisation<dim>::rebuild_strip()
{
  std::vector<double> &values = lattice.values();
  std::vector<double>  new_values(strip.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double>  factors(strip.size(), 0.);
  for (std::size_t b = 0; b < strip.size(); ++b)
    {
      if (contour_distance.kink_near(lattice.index(strip[b]), kink_reach))
        continue;
      const double distance = contour_distance(strip[b]);
      if (!std::isfinite(distance))
        continue;
      new_values[b] = distance;
      // a ratio of two small numbers says nothing about the slope
      if (std::abs(distance) > 0.05 * lattice.spacing())
        factors[b] = distance / values[strip[b]];
    }
  spread_factors(factors);
  const std::vector<Point<dim>> contour = contour_points();
  for (std::size_t b = 0; b < strip.size(); ++b)
    values[strip[b]] = std::isfinite(new_values[b]) ? new_values[b] : values[strip[b]] * factors[b];
  count.n_changed_near = strip.size();
  for (const Point<dim> &x : contour)
    {
      const auto [value, gradient] = lattice.value_and_gradient(x, options.degree);
      count.contour_motion = std::max(count.contour_motion, std::abs(value) / gradient.norm());
    }
}

template <int dim>
void
Reinitialisation<dim>::rebuild_rest()
{
  spread_weights();
  std::vector<double> before;
  nodes.pack(lattice.values(), before);
  std::vector<char> known(lattice.values().size(), 0);
  for (const std::size_t i : strip)
    known[i] = 1;
  march_distances(lattice, known, options.band);
  for (const NodeRun &run : nodes.runs)
    for (int i = 0; i < run.n; ++i)
      if (!in_strip[run.with_halo + i])
        {
          double      &value  = lattice.values()[run.node + i];
          const double old    = before[run.packed + i];
          const double remote = std::abs(value) / (near_reach * lattice.spacing()) - 1;
          const double full   = double(weight[run.with_halo + i]) / full_weight;
          const double w      = std::clamp(std::max(remote, full), 0., 1.);
          value               = old + (value - old) * w;
          count.n_changed_far += w > 0;
        }
}

template <int dim>
ReinitialisationCount
Reinitialisation<dim>::run()
{
  measure_slopes();
  const bool near = count.deviation_near > options.tolerance;
  if (near)
    rebuild_strip();
  if (near || count.deviation_far > options.tolerance)
    rebuild_rest();
  return count;
}
} // namespace

template <int dim>
ReinitialisationCount
reinitialise(Lattice<dim> &lattice, const ReinitialisationOptions &options)
{
  AssertThrow(has_contour(lattice),
              ExcMessage("The level set has no zero contour on its lattice."));
  return Reinitialisation<dim>(lattice, options).run();
}

#define INSTANTIATE(dim) \
  template ReinitialisationCount reinitialise(Lattice<dim> &, const ReinitialisationOptions &);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
