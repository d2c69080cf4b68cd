#include <scree/level_set/hj_weno5.h>

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

namespace
{
// Asks for the memory that the stencils of a run reach along the last axis: short runs are over
// before the processor sees a pattern.
template <int dim>
void
prefetch_run(const NodeSet<dim> &nodes, const NodeRun &run,
             const std::array<const double *, 2> &phi_and_start, double *const out)
{
  constexpr int        line = 8; // doubles
  const std::ptrdiff_t step = nodes.grid.stride(dim - 1);
  for (int i = 0; i < run.n; i += line)
    {
      const double *const phi = phi_and_start[0] + run.with_halo + i;
      for (int k = -nodes.grid.width; k <= nodes.grid.width; ++k)
        __builtin_prefetch(phi + k * step);
      __builtin_prefetch(phi_and_start[1] + run.with_halo + i);
      __builtin_prefetch(out + run.with_halo + i, 1);
    }
}
} // namespace

template <int dim>
void
hj_stage(const NodeSet<dim> &nodes, const Upwinding upwinding,
         const std::array<std::vector<double>, dim> &velocity, const StageWeights &weights,
         const std::array<const double *, 2> &phi_and_start, double *const out)
{
  const auto           kernel   = upwinding == Upwinding::weno5
                                    ? (dim == 3 ? hj_row_weno5_3d : hj_row_weno5_2d)
                                    : (dim == 3 ? hj_row_first_order_3d : hj_row_first_order_2d);
  const HaloGrid<dim> &grid     = nodes.grid;
  const bool           is_dense = nodes.n_nodes == nodes.runs.size() * grid.n_nodes[0];
  HjRow                row{};
  row.start_weight = weights.start_weight;
  row.dt_over_h    = weights.dt / grid.spacing;
  row.epsilon      = 0.1 * grid.spacing * grid.spacing;
  for (int d = 0; d < dim; ++d)
    row.stride[d] = grid.stride(d);
  for (std::size_t r = 0; r < nodes.runs.size(); ++r)
    {
      const NodeRun &run = nodes.runs[r];
      if (!is_dense && r + 3 < nodes.runs.size())
        prefetch_run(nodes, nodes.runs[r + 3], phi_and_start, out);
      row.n = run.n;
      for (int d = 0; d < dim; ++d)
        row.velocity[d] = velocity[d].data() + run.packed;
      row.phi   = phi_and_start[0] + run.with_halo;
      row.start = phi_and_start[1] + run.with_halo;
      row.out   = out + run.with_halo;
      kernel(row);
    }
  if (nodes.reaches_ends)
    grid.extrapolate(out);
}

template void hj_stage<2>(const NodeSet<2> &, Upwinding, const std::array<std::vector<double>, 2> &,
                          const StageWeights &, const std::array<const double *, 2> &, double *);
template void hj_stage<3>(const NodeSet<3> &, Upwinding, const std::array<std::vector<double>, 3> &,
                          const StageWeights &, const std::array<const double *, 2> &, double *);
} // namespace scree
