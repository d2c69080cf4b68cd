#include <scree/level_set/halo_grid.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
std::size_t
HaloGrid<dim>::stride(const int d) const
{
  std::size_t result = 1;
  for (int e = 0; e < d; ++e)
    result *= n_nodes[e] + 2 * width;
  return result;
}

template <int dim>
std::size_t
HaloGrid<dim>::first() const
{
  std::size_t result = 0;
  for (int d = 0; d < dim; ++d)
    result += width * stride(d);
  return result;
}

template <int dim>
std::size_t
HaloGrid<dim>::size() const
{
  return stride(dim);
}

namespace
{
// Calls f(row, offset without halo, offset with halo) for the first node of every row.
template <int dim, typename F>
void
for_each_row(const HaloGrid<dim> &grid, const F &f)
{
  const int         n_planes = dim == 3 ? grid.n_nodes[dim - 1] : 1;
  const std::size_t first = grid.first(), nx = grid.n_nodes[0];
  for (int k = 0; k < n_planes; ++k)
    for (int j = 0; j < grid.n_nodes[1]; ++j)
      f(std::array<int, 2>{{j, k}}, (static_cast<std::size_t>(k) * grid.n_nodes[1] + j) * nx,
        first + k * grid.stride(2) + j * grid.stride(1));
}
} // namespace

template <int dim>
void
HaloGrid<dim>::load(const std::vector<double> &values, double *with_halo) const
{
  for_each_row(*this,
               [&](const std::array<int, 2> &, const std::size_t from, const std::size_t to) {
                 std::copy_n(values.data() + from, n_nodes[0], with_halo + to);
               });
  extrapolate(with_halo);
}

template <int dim>
void
HaloGrid<dim>::extrapolate(double *const values) const
{
  // f(end + k outwards) = f(end) + k (f(end) - f(end inwards))
  const auto continue_from = [&](const std::size_t end, const std::ptrdiff_t outwards, const int n,
                                 const std::size_t along) {
    for (int k = 1; k <= width; ++k)
      for (int i = 0; i < n; ++i)
        {
          double *const node = values + end + i * along;
          node[k * outwards] = node[0] + k * (node[0] - node[-outwards]);
        }
  };
  const int n_planes = dim == 3 ? n_nodes[dim - 1] : 1;
  for (int k = 0; k < n_planes; ++k)
    {
      const std::size_t    plane = first() + k * stride(2), up = stride(1);
      const std::ptrdiff_t row = up;
      continue_from(plane, -1, n_nodes[1], up);
      continue_from(plane + n_nodes[0] - 1, 1, n_nodes[1], up);
      continue_from(plane, -row, n_nodes[0], 1);
      continue_from(plane + (n_nodes[1] - 1) * up, row, n_nodes[0], 1);
    }
  if constexpr (dim == 3)
    for (int j = 0; j < n_nodes[1]; ++j)
      {
        const std::size_t row = first() + j * stride(1);
        continue_from(row, -static_cast<std::ptrdiff_t>(stride(2)), n_nodes[0], 1);
        continue_from(row + (n_nodes[2] - 1) * stride(2), stride(2), n_nodes[0], 1);
      }
}

template <int dim>
void
NodeSet<dim>::load(const std::vector<double> &values, double *with_halo) const
{
  if (reaches_ends)
    {
      grid.load(values, with_halo);
      return;
    }
  std::array<std::size_t, 3> all{{1, 1, 1}}; // strides without halo
  for (int d = 1; d < dim; ++d)
    all[d] = all[d - 1] * grid.n_nodes[d - 1];
  for (const NodeRun &run : runs)
    {
      std::copy_n(values.data() + run.node - grid.width, run.n + 2 * grid.width,
                  with_halo + run.with_halo - grid.width);
      for (int d = 1; d < dim; ++d)
        for (int k = -grid.width; k <= grid.width; ++k)
          if (k != 0)
            std::copy_n(values.data() + run.node + k * static_cast<std::ptrdiff_t>(all[d]), run.n,
                        with_halo + run.with_halo
                          + k * static_cast<std::ptrdiff_t>(grid.stride(d)));
    }
}

template <int dim>
void
NodeSet<dim>::store(const double *with_halo, std::vector<double> &values) const
{
  for (const NodeRun &run : runs)
    std::copy_n(with_halo + run.with_halo, run.n, values.data() + run.node);
}

template <int dim>
void
NodeSet<dim>::pack(const std::vector<double> &values, std::vector<double> &packed) const
{
  packed.resize(n_nodes);
  for (const NodeRun &run : runs)
    std::copy_n(values.data() + run.node, run.n, packed.data() + run.packed);
}

template <int dim>
NodeSet<dim>
all_nodes(const HaloGrid<dim> &grid)
{
  NodeSet<dim> result{grid, {}, 0, true};
  for_each_row(
    grid, [&](const std::array<int, 2> &, const std::size_t node, const std::size_t with_halo) {
      result.runs.push_back({node, with_halo, node, grid.n_nodes[0]});
      result.n_nodes += grid.n_nodes[0];
    });
  return result;
}

template <int dim>
NodeSet<dim>
nodes_near_contour(const HaloGrid<dim> &grid, const std::vector<double> &phi,
                   const double half_width, const bool whole_blocks)
{
  if (!std::isfinite(half_width))
    return all_nodes(grid);
  constexpr int block = 8; // nodes, a register of the widest instructions
  NodeSet<dim>  result{grid, {}, 0, false};
  const int     nx = grid.n_nodes[0];
  for_each_row(
    grid, [&](const std::array<int, 2> &row, const std::size_t node, const std::size_t with_halo) {
      const std::size_t n_before = result.runs.size();
      int               begin = 0, end = 0; // of the open run
      const auto is_near = [&](const int i) { return std::abs(phi[node + i]) <= half_width; };
      const auto close   = [&]() {
        if (end > begin)
          {
            end = std::min(end, nx);
            while (!whole_blocks && !is_near(begin))
              ++begin;
            while (!whole_blocks && !is_near(end - 1))
              --end;
            result.runs.push_back({node + begin, with_halo + begin, result.n_nodes, end - begin});
            result.n_nodes += result.runs.back().n;
          }
      };
      for (int i = 0; i < nx; i += block)
        {
          bool near = false;
          for (int l = i; l < std::min(i + block, nx); ++l)
            near |= is_near(l);
          if (!near)
            continue;
          if (i > end)
            {
              close();
              begin = i;
            }
          end = i + block;
        }
      close();
      if (result.runs.size() == n_before)
        return;
      bool at_end = result.runs[n_before].node < node + grid.width
                    || result.runs.back().node + result.runs.back().n + grid.width > node + nx;
      for (int d = 1; d < dim; ++d)
        at_end |= row[d - 1] < grid.width || row[d - 1] >= grid.n_nodes[d] - grid.width;
      result.reaches_ends |= at_end;
    });
  return result;
}

template struct HaloGrid<2>;
template struct HaloGrid<3>;
template struct NodeSet<2>;
template struct NodeSet<3>;
template NodeSet<2> all_nodes(const HaloGrid<2> &);
template NodeSet<3> all_nodes(const HaloGrid<3> &);
template NodeSet<2> nodes_near_contour(const HaloGrid<2> &, const std::vector<double> &, double,
                                       bool);
template NodeSet<3> nodes_near_contour(const HaloGrid<3> &, const std::vector<double> &, double,
                                       bool);
} // namespace scree
