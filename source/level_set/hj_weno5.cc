#include <scree/level_set/hj_weno5.h>

#include <algorithm>
#include <cmath>

// The default level does not vectorise loops of unknown length.
#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC optimize("O3")
#endif

// One version of the row kernels per instruction set, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define SCREE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#  define SCREE_INLINE inline __attribute__((always_inline))
#else
#  define SCREE_CLONES
#  define SCREE_INLINE inline
#endif

namespace scree
{
/** One row of a stage: pointers to its first node. */
struct HjRow
{
  int            n;
  std::ptrdiff_t stride[3];
  const double  *velocity[3];
  const double  *phi;
  const double  *start;
  double        *out;
  double         start_weight;
  double         dt_over_h;
  double         epsilon; // length^2
};

namespace
{
// h v dphi/dx with x along `s`: with the undivided second differences a, b, c, d from the upwind
// to the downwind side, dphi/dx = central -/+ Phi for v >/< 0 (Jiang & Peng, equations 2.6 to 2.9),
//   h central = (-D_{-3/2} + 7 D_{-1/2} + 7 D_{1/2} - D_{3/2}) / 12,
//   h Phi     = w0 (a - 2 b + c) / 3 + (w2 - 1/2) (b - 2 c + d) / 6,
// w_k = alpha_k / sum alpha, alpha = 1 / s0^2, 6 / s1^2, 3 / s2^2, s_k = epsilon + IS_k.
// Multiplying all alpha by (s0 s1 s2)^2 leaves one division.
SCREE_INLINE double
weno5_term(const double *phi, const std::ptrdiff_t s, const double v, const double epsilon)
{
  const double d0 = phi[-2 * s] - phi[-3 * s], d1 = phi[-s] - phi[-2 * s], d2 = phi[0] - phi[-s],
               d3 = phi[s] - phi[0], d4 = phi[2 * s] - phi[s], d5 = phi[3 * s] - phi[2 * s];
  const double central = (7. / 12.) * (d2 + d3) - (1. / 12.) * (d1 + d4);
  const double left2 = d1 - d0, left = d2 - d1, c = d3 - d2, right = d4 - d3, right2 = d5 - d4;
  // 1 or 0, and sums instead of three selections: those become branches without AVX-512
  const double forward = v > 0 ? 1. : 0.;
  const double a = right2 + forward * (left2 - right2), b = right + forward * (left - right),
               d  = left + forward * (right - left);
  const double s0 = epsilon + 13 * (a - b) * (a - b) + 3 * (a - 3 * b) * (a - 3 * b);
  const double s1 = epsilon + 13 * (b - c) * (b - c) + 3 * (b + c) * (b + c);
  const double s2 = epsilon + 13 * (c - d) * (c - d) + 3 * (3 * c - d) * (3 * c - d);
  const double r0 = s1 * s2, r1 = s0 * s2, r2 = s0 * s1;
  const double w0 = r0 * r0, w2 = 3 * (r2 * r2), sum = w0 + 6 * (r1 * r1) + w2;
  const double correction
    = ((1. / 3.) * w0 * (a - 2 * b + c) + (1. / 6.) * (w2 - 0.5 * sum) * (b - 2 * c + d)) / sum;
  return v * central - std::abs(v) * correction;
}

// h v dphi/dx with the difference to the upwind neighbour, v central - |v| (second difference)/2.
SCREE_INLINE double
first_order_term(const double *phi, const std::ptrdiff_t s, const double v)
{
  const double left = phi[0] - phi[-s], right = phi[s] - phi[0];
  return v * 0.5 * (left + right) - std::abs(v) * 0.5 * (right - left);
}

template <int dim, bool weno>
SCREE_INLINE void
stage_row(const HjRow &row)
{
  const int            n   = row.n;
  const double        *phi = row.phi, *start = row.start;
  const double        *vx = row.velocity[0], *vy = row.velocity[1], *vz = row.velocity[2];
  double              *out = row.out;
  const std::ptrdiff_t sy = row.stride[1], sz = row.stride[2];
  const double         w = row.start_weight, dt = row.dt_over_h, eps = row.epsilon;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    {
      double change;
      if constexpr (weno)
        {
          change = weno5_term(phi + i, 1, vx[i], eps) + weno5_term(phi + i, sy, vy[i], eps);
          if constexpr (dim == 3)
            change += weno5_term(phi + i, sz, vz[i], eps);
        }
      else
        {
          change = first_order_term(phi + i, 1, vx[i]) + first_order_term(phi + i, sy, vy[i]);
          if constexpr (dim == 3)
            change += first_order_term(phi + i, sz, vz[i]);
        }
      out[i] = w * start[i] + (1 - w) * (phi[i] - dt * change);
    }
}
} // namespace

SCREE_CLONES void
hj_row_weno5_2d(const HjRow &row)
{
  stage_row<2, true>(row);
}

SCREE_CLONES void
hj_row_weno5_3d(const HjRow &row)
{
  stage_row<3, true>(row);
}

SCREE_CLONES void
hj_row_first_order_2d(const HjRow &row)
{
  stage_row<2, false>(row);
}

SCREE_CLONES void
hj_row_first_order_3d(const HjRow &row)
{
  stage_row<3, false>(row);
}

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
// Calls f(offset without halo, offset with halo) for the first node of every row.
template <int dim, typename F>
void
for_each_row(const HaloGrid<dim> &grid, const F &f)
{
  const int         n_planes = dim == 3 ? grid.n_nodes[dim - 1] : 1;
  const std::size_t first = grid.first(), nx = grid.n_nodes[0], ny = grid.n_nodes[1];
  for (int k = 0; k < n_planes; ++k)
    for (std::size_t j = 0; j < ny; ++j)
      f((k * ny + j) * nx, first + k * grid.stride(2) + j * grid.stride(1));
}
} // namespace

template <int dim>
std::vector<double>
HaloGrid<dim>::with_halo(const std::vector<double> &values) const
{
  std::vector<double> result(size(), 0.);
  for_each_row(*this, [&](const std::size_t from, const std::size_t to) {
    std::copy_n(values.data() + from, n_nodes[0], result.data() + to);
  });
  extrapolate(result);
  return result;
}

template <int dim>
void
HaloGrid<dim>::copy_nodes(const std::vector<double> &with_halo, std::vector<double> &values) const
{
  for_each_row(*this, [&](const std::size_t to, const std::size_t from) {
    std::copy_n(with_halo.data() + from, n_nodes[0], values.data() + to);
  });
}

template <int dim>
void
HaloGrid<dim>::extrapolate(std::vector<double> &with_halo) const
{
  double *const values = with_halo.data();
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
hj_stage(const HaloGrid<dim> &grid, const Upwinding upwinding,
         const std::array<std::vector<double>, dim> &velocity, const StageWeights &weights,
         const std::array<const std::vector<double> *, 2> &phi_and_start, std::vector<double> &out)
{
  const auto kernel = upwinding == Upwinding::weno5
                        ? (dim == 3 ? hj_row_weno5_3d : hj_row_weno5_2d)
                        : (dim == 3 ? hj_row_first_order_3d : hj_row_first_order_2d);
  HjRow      row{};
  row.n            = grid.n_nodes[0];
  row.start_weight = weights.start_weight;
  row.dt_over_h    = weights.dt / grid.spacing;
  row.epsilon      = 0.1 * grid.spacing * grid.spacing;
  for (int d = 0; d < dim; ++d)
    row.stride[d] = grid.stride(d);
  for_each_row(grid, [&](const std::size_t node, const std::size_t with_halo) {
    for (int d = 0; d < dim; ++d)
      row.velocity[d] = velocity[d].data() + node;
    row.phi   = phi_and_start[0]->data() + with_halo;
    row.start = phi_and_start[1]->data() + with_halo;
    row.out   = out.data() + with_halo;
    kernel(row);
  });
  grid.extrapolate(out);
}

template struct HaloGrid<2>;
template struct HaloGrid<3>;
template void hj_stage<2>(const HaloGrid<2> &, Upwinding,
                          const std::array<std::vector<double>, 2> &, const StageWeights &,
                          const std::array<const std::vector<double> *, 2> &,
                          std::vector<double> &);
template void hj_stage<3>(const HaloGrid<3> &, Upwinding,
                          const std::array<std::vector<double>, 3> &, const StageWeights &,
                          const std::array<const std::vector<double> *, 2> &,
                          std::vector<double> &);
} // namespace scree
