#include <scree/material/logarithmic_strain.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
/**
 * Rotates in the plane (p, q) such that `m[p][q]` vanishes, unless it is negligible; r is the third
 * direction. Only the upper triangle of `m` is used. Returns whether it rotated.
 */
template <unsigned int p, unsigned int q>
bool
eliminate(Tensor<2, 3> &m, Tensor<2, 3> &vectors)
{
  constexpr unsigned int r       = 3 - p - q;
  constexpr double       epsilon = 0.25 * std::numeric_limits<double>::epsilon();
  constexpr double       tiny    = 1e-150; // its square is not zero
  const double           m_pq    = m[p][q];
  if (!(std::abs(m_pq) > epsilon * (std::abs(m[p][p]) + std::abs(m[q][q])) + tiny))
    return false;
  const double d = m[q][q] - m[p][p];
  const double t = std::copysign(2., d) * m_pq / (std::abs(d) + std::sqrt(d * d + 4 * m_pq * m_pq));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  m[p][p] -= t * m_pq;
  m[q][q] += t * m_pq;
  m[p][q]           = 0;
  double      &m_pr = m[std::min(p, r)][std::max(p, r)], &m_qr = m[std::min(q, r)][std::max(q, r)];
  const double old_pr = m_pr, old_qr = m_qr;
  m_pr = c * old_pr - s * old_qr;
  m_qr = s * old_pr + c * old_qr;
  for (unsigned int i = 0; i < 3; ++i)
    {
      const double v_p = vectors[i][p], v_q = vectors[i][q];
      vectors[i][p] = c * v_p - s * v_q;
      vectors[i][q] = s * v_p + c * v_q;
    }
  return true;
}

/** `(ln a - ln b)/(a - b)` of two positive numbers. */
double
divided_logarithm(const double a, const double b)
{
  const double x = (a - b) / b;
  return (x == 0 ? 1. : std::log1p(x) / x) / b;
}
} // namespace

Tensor<2, 3>
Eigensystem::rotate(const Tensor<2, 3> &principal) const
{
  return vectors * principal * transpose(vectors);
}

Eigensystem
eigensystem(const Tensor<2, 3> &symmetric)
{
  Tensor<2, 3> m      = symmetric;
  Eigensystem  result = {{{0, 0, 0}}, Tensor<2, 3>()};
  for (unsigned int i = 0; i < 3; ++i)
    result.vectors[i][i] = 1;
  // Jacobi's method converges quadratically: five sweeps are much, the bound only ends NaN.
  for (unsigned int sweep = 0; sweep < 20; ++sweep)
    {
      const bool first  = eliminate<0, 1>(m, result.vectors);
      const bool second = eliminate<0, 2>(m, result.vectors);
      const bool third  = eliminate<1, 2>(m, result.vectors);
      if (!first && !second && !third)
        break;
    }
  for (unsigned int i = 0; i < 3; ++i)
    result.values[i] = m[i][i];
  return result;
}

Tensor<2, 3>
exponential(const Tensor<2, 3> &symmetric)
{
  const Eigensystem system = eigensystem(symmetric);
  Tensor<2, 3>      principal;
  for (unsigned int a = 0; a < 3; ++a)
    principal[a][a] = std::exp(system.values[a]);
  return system.rotate(principal);
}

LogarithmicStrain::LogarithmicStrain(const Eigensystem &system)
    : system(system)
{
  for (unsigned int a = 0; a < 3; ++a)
    {
      weights[a][a] = 0.5 / system.values[a];
      for (unsigned int b = 0; b < a; ++b)
        weights[a][b] = weights[b][a] = 0.5 * divided_logarithm(system.values[a], system.values[b]);
    }
}

Tensor<2, 3>
LogarithmicStrain::value() const
{
  Tensor<2, 3> principal;
  for (unsigned int a = 0; a < 3; ++a)
    principal[a][a] = 0.5 * std::log(system.values[a]);
  return system.rotate(principal);
}

Tensor<2, 3>
LogarithmicStrain::derivative(const unsigned int k, const Tensor<1, 3> &f) const
{
  Tensor<1, 3> g; // b f in the principal axes
  for (unsigned int a = 0; a < 3; ++a)
    g[a]
      = system.values[a]
        * (system.vectors[0][a] * f[0] + system.vectors[1][a] * f[1] + system.vectors[2][a] * f[2]);
  const Tensor<1, 3> &e = system.vectors[k];
  Tensor<2, 3>        principal;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b <= a; ++b)
      principal[a][b] = principal[b][a] = weights[a][b] * (e[a] * g[b] + e[b] * g[a]);
  return system.rotate(principal);
}

PolarRotation::PolarRotation(const Tensor<2, 3> &F, const Eigensystem &system)
    : system(system)
{
  Tensor<2, 3> inverse_stretch;
  for (unsigned int a = 0; a < 3; ++a)
    {
      stretches[a]          = std::sqrt(system.values[a]);
      inverse_stretch[a][a] = 1 / stretches[a];
    }
  rotation = system.rotate(inverse_stretch) * F;
}

const Tensor<2, 3> &
PolarRotation::value() const
{
  return rotation;
}

Tensor<2, 3>
PolarRotation::spin(const unsigned int k, const Tensor<1, 3> &f) const
{
  const Tensor<1, 3> &e = system.vectors[k];
  const Tensor<1, 3>  g = transpose(system.vectors) * f;
  Tensor<2, 3>        principal;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < a; ++b)
      {
        principal[a][b] = (e[a] * g[b] * stretches[b] - e[b] * g[a] * stretches[a])
                          / (stretches[a] + stretches[b]);
        principal[b][a] = -principal[a][b];
      }
  return system.rotate(principal);
}
} // namespace scree
