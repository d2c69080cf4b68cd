#include <scree/level_set/contour_distance.h>
#include <scree/level_set/fast_marching.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
constexpr double far_away = std::numeric_limits<double>::infinity();

// Node numbers by a value in spacings, from the smallest bucket on; 256 buckets per spacing, in a
// ring of 4 spacings.
class BucketQueue
{
public:
  static std::uint64_t bucket(const double value)
  {
    return static_cast<std::uint64_t>(256 * value);
  }

  void push(double value, std::uint32_t node);

  bool empty() const
  {
    return n_entries == 0;
  }

  // Takes a node of the first bucket that is not empty.
  std::uint32_t pop();

  // The bucket of the node that was taken last.
  std::uint64_t current = 0;

private:
  static constexpr std::uint32_t n_buckets = 1024, none = ~std::uint32_t(0);

  struct Entry
  {
    std::uint32_t node, next;
  };

  std::vector<Entry>         entries;
  std::vector<std::uint32_t> first     = std::vector<std::uint32_t>(n_buckets, none);
  std::uint32_t              free      = none;
  std::size_t                n_entries = 0;
};

void
BucketQueue::push(const double value, const std::uint32_t node)
{
  // What lies beyond the ring waits in its last bucket.
  const std::uint64_t number = std::clamp(bucket(value), current, current + n_buckets - 1);
  std::uint32_t      &head   = first[number % n_buckets];
  std::uint32_t       slot   = free;
  if (slot == none)
    {
      slot = entries.size();
      entries.push_back({node, head});
    }
  else
    {
      free          = entries[slot].next;
      entries[slot] = {node, head};
    }
  head = slot;
  ++n_entries;
}

std::uint32_t
BucketQueue::pop()
{
  while (first[current % n_buckets] == none)
    ++current;
  std::uint32_t      &head = first[current % n_buckets];
  const std::uint32_t slot = head;
  head                     = entries[slot].next;
  entries[slot].next       = free;
  free                     = slot;
  --n_entries;
  return entries[slot].node;
}

// The upwind difference along one axis, (T - base) slope with slope 1 or 3/2, over the spacing.
struct UpwindDifference
{
  double nearest, base, slope_square;
};

// The largest T with sum_i slope_i^2 (T - base_i)^2 = 1 over as many axes, sorted by their nearest
// value, as influence T.
template <int dim>
double
solve_eikonal(const std::array<UpwindDifference, dim> &axes, const int n_axes)
{
  const double origin = axes[0].nearest;
  double       a = 0, b = 0, c = -1, result = far_away;
  for (int i = 0; i < n_axes; ++i)
    {
      const double nearest = axes[i].nearest - origin, base = axes[i].base - origin,
                   square = axes[i].slope_square;
      if (nearest >= result)
        break;
      a += square;
      b += square * base;
      c += square * base * base;
      const double discriminant = b * b - a * c;
      if (discriminant < 0)
        break;
      const double candidate = (b + std::sqrt(discriminant)) / a;
      if (candidate < nearest)
        break;
      result = candidate;
    }
  return origin + result;
}

// Fast marching of distances in spacings on a grid with two nodes of halo, all in one array: what
// is known is positive (infinity in the halo), a tentative distance T is kept as -T (-infinity at
// the start).
template <int dim>
class March
{
public:
  March(const Lattice<dim> &lattice, const std::vector<char> &known_nodes);

  // Up to a distance of `band` spacings.
  void run(double band);

  // Puts the known distances into the lattice with the signs of its values.
  void copy_to(Lattice<dim> &lattice) const;

private:
  static constexpr int halo = 2;

  // Calls f(offset in the lattice, node here) for the first node of each line along x.
  template <typename F>
  void for_each_line(const F &f) const;

  // The distance of a node from what is known around it.
  double distance(const double *node) const;

  void update_neighbours(std::uint32_t node);

  std::array<int, dim>            n_nodes;
  std::array<std::ptrdiff_t, dim> stride;
  std::vector<double>             distances;
  BucketQueue                     queue;
};

template <int dim>
March<dim>::March(const Lattice<dim> &lattice, const std::vector<char> &known_nodes)
    : n_nodes(lattice.n_nodes())
{
  std::size_t size = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = size;
      size *= n_nodes[d] + 2 * halo;
    }
  AssertThrow(size < std::numeric_limits<std::uint32_t>::max(),
              ExcMessage("The lattice is too large for fast marching."));
  distances.assign(size, far_away);
  const double scale = 1 / lattice.spacing();
  for_each_line([&](const std::size_t from, const std::size_t to) {
    for (int i = 0; i < n_nodes[0]; ++i)
      distances[to + i]
        = known_nodes[from + i] ? std::abs(lattice.values()[from + i]) * scale : -far_away;
  });
}

template <int dim>
template <typename F>
void
March<dim>::for_each_line(const F &f) const
{
  std::size_t offset = 0;
  for (int k = 0; k < (dim == 3 ? n_nodes[dim - 1] : 1); ++k)
    for (int j = 0; j < n_nodes[1]; ++j, offset += n_nodes[0])
      f(offset, halo + (j + halo) * stride[1] + (dim == 3 ? (k + halo) * stride[dim - 1] : 0));
}

template <int dim>
inline double
March<dim>::distance(const double *node) const
{
  std::array<UpwindDifference, dim> axes;
  int                               n_axes = 0;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double below   = node[-stride[d]] >= 0 ? node[-stride[d]] : far_away,
                   above   = node[stride[d]] >= 0 ? node[stride[d]] : far_away;
      const double nearest = std::min(below, above);
      if (nearest == far_away)
        continue;
      const double           over = below < above ? node[-2 * stride[d]] : node[2 * stride[d]];
      const UpwindDifference axis = over >= 0 && over <= nearest
                                      ? UpwindDifference{nearest, (4 * nearest - over) / 3, 2.25}
                                      : UpwindDifference{nearest, nearest, 1.};
      int                    i    = n_axes++;
      for (; i > 0 && axes[i - 1].nearest > nearest; --i)
        axes[i] = axes[i - 1];
      axes[i] = axis;
    }
  return solve_eikonal<dim>(axes, n_axes);
}

template <int dim>
inline void
March<dim>::update_neighbours(const std::uint32_t node)
{
  for (unsigned int d = 0; d < dim; ++d)
    for (const std::ptrdiff_t s : {-stride[d], stride[d]})
      {
        const std::uint32_t next = node + s;
        const double        old  = -distances[next];
        if (old <= 0)
          continue;
        const double candidate = distance(distances.data() + next);
        if (!(candidate < old))
          continue;
        if (old == far_away || BucketQueue::bucket(candidate) != BucketQueue::bucket(old))
          queue.push(candidate, next);
        distances[next] = -candidate;
      }
}

template <int dim>
void
March<dim>::run(const double band)
{
  for_each_line([&](const std::size_t, const std::size_t first) {
    for (std::size_t node = first; node < first + n_nodes[0]; ++node)
      if (distances[node] >= 0)
        update_neighbours(node);
  });
  while (!queue.empty())
    {
      const std::uint32_t node  = queue.pop();
      const double        value = -distances[node];
      if (value <= 0 || value > band) // known by an entry in an earlier bucket, or too far
        continue;
      if (BucketQueue::bucket(value) > queue.current)
        {
          queue.push(value, node);
          continue;
        }
      distances[node] = value;
      update_neighbours(node);
    }
}

template <int dim>
void
March<dim>::copy_to(Lattice<dim> &lattice) const
{
  std::vector<double> &values = lattice.values();
  for_each_line([&](const std::size_t to, const std::size_t from) {
    for (int i = 0; i < n_nodes[0]; ++i)
      if (distances[from + i] >= 0)
        {
          const double distance = distances[from + i] * lattice.spacing();
          values[to + i]        = values[to + i] < 0 ? -distance : distance;
        }
  });
}
} // namespace

template <int dim>
bool
has_contour(const Lattice<dim> &lattice)
{
  const std::vector<double> &values = lattice.values();
  return std::any_of(values.begin(), values.end(),
                     [&](const double value) { return (value < 0) != (values[0] < 0); });
}

template <int dim>
void
march_distances(Lattice<dim> &lattice, const std::vector<char> &known, const double band)
{
  AssertDimension(known.size(), lattice.values().size());
  March<dim> march(lattice, known);
  march.run(band);
  march.copy_to(lattice);
}

template <int dim>
void
compute_distances(Lattice<dim> &lattice)
{
  AssertThrow(has_contour(lattice),
              ExcMessage("The level set has no zero contour on its lattice."));
  const std::vector<std::size_t> near = nodes_at_cut_edges(lattice);
  ContourDistance<dim>           contour_distance(lattice);
  std::vector<double>            distances;
  distances.reserve(near.size());
  for (const std::size_t i : near)
    distances.push_back(contour_distance(i));

  std::vector<char> known(lattice.values().size(), 0);
  for (std::size_t n = 0; n < near.size(); ++n)
    if (std::isfinite(distances[n]))
      {
        known[near[n]]            = 1;
        lattice.values()[near[n]] = distances[n];
      }
  march_distances(lattice, known);
}

#define INSTANTIATE(dim)                           \
  template bool has_contour(const Lattice<dim> &); \
  template void compute_distances(Lattice<dim> &); \
  template void march_distances(Lattice<dim> &, const std::vector<char> &, double);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
