// A fused HJ-WENO5 Euler stage written for one machine: no schemes to choose from, no Runge-Kutta
// weights, no halo to fill, free floating-point algebra. Its rate is what hj_stage() is measured
// by.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace
{
inline double
term(const double *p, const std::ptrdiff_t s, const double v, const double epsilon)
{
  const double e0 = p[-2 * s] - p[-3 * s], e1 = p[-s] - p[-2 * s], e2 = p[0] - p[-s],
               e3 = p[s] - p[0], e4 = p[2 * s] - p[s], e5 = p[3 * s] - p[2 * s];
  const bool   l = v > 0;
  const double a = l ? e1 - e0 : e5 - e4, b = l ? e2 - e1 : e4 - e3, c = e3 - e2,
               d  = l ? e4 - e3 : e2 - e1;
  const double s0 = epsilon + 13 * (a - b) * (a - b) + 3 * (a - 3 * b) * (a - 3 * b),
               s1 = epsilon + 13 * (b - c) * (b - c) + 3 * (b + c) * (b + c),
               s2 = epsilon + 13 * (c - d) * (c - d) + 3 * (3 * c - d) * (3 * c - d);
  const double w0 = s1 * s2 * (s1 * s2), w1 = 6 * (s0 * s2) * (s0 * s2),
               w2 = 3 * (s0 * s1) * (s0 * s1), sum = w0 + w1 + w2;
  return v * ((7 * (e2 + e3) - e1 - e4) / 12)
         - std::abs(v) * (w0 * (a - 2 * b + c) / 3 + (w2 - sum / 2) * (b - 2 * c + d) / 6) / sum;
}

template <int dim>
void
stage(const int n, const double dt_over_h, const double epsilon,
      const std::array<std::vector<double>, 3> &velocity, const double *phi, double *out)
{
  const std::ptrdiff_t sy = n + 6, sz = sy * sy;
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    for (int j = 0; j < n; ++j)
      {
        const std::size_t first = (dim == 3 ? (k + 3) * sz : 0) + (j + 3) * sy + 3;
        const std::size_t node  = (static_cast<std::size_t>(k) * n + j) * n;
        const double     *p     = phi + first;
        double           *q     = out + first;
        const double     *vx = velocity[0].data() + node, *vy = velocity[1].data() + node,
                     *vz = dim == 3 ? velocity[2].data() + node : nullptr;
#pragma GCC ivdep
        for (int i = 0; i < n; ++i)
          {
            double sum = term(p + i, 1, vx[i], epsilon) + term(p + i, sy, vy[i], epsilon);
            if constexpr (dim == 3)
              sum += term(p + i, sz, vz[i], epsilon);
            q[i] = p[i] - dt_over_h * sum;
          }
      }
}
} // namespace

void
limit_stage(const int dim, const int n, const double dt_over_h, const double epsilon,
            const std::array<std::vector<double>, 3> &velocity, const double *phi, double *out)
{
  if (dim == 2)
    stage<2>(n, dt_over_h, epsilon, velocity, phi, out);
  else
    stage<3>(n, dt_over_h, epsilon, velocity, phi, out);
}
