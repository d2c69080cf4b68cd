#include <scree/material/logarithmic_strain.h>

#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
/** Rotates in the plane (p, q) such that `m[p][q]` vanishes; r is the third direction. */
void
eliminate(Tensor<2, 3> &m, Tensor<2, 3> &vectors, const unsigned int p, const unsigned int q)
{
  const unsigned int r = 3 - p - q;
  const double       w = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double       t = std::copysign(1., w) / (std::abs(w) + std::sqrt(w * w + 1));
  const double       c = 1 / std::sqrt(t * t + 1), s = t * c;
  m[p][p] -= t * m[p][q];
  m[q][q] += t * m[p][q];
  m[p][q] = m[q][p] = 0;
  const double m_rp = m[r][p], m_rq = m[r][q];
  m[r][p] = m[p][r] = c * m_rp - s * m_rq;
  m[r][q] = m[q][r] = s * m_rp + c * m_rq;
  for (unsigned int i = 0; i < 3; ++i)
    {
      const double v_p = vectors[i][p], v_q = vectors[i][q];
      vectors[i][p] = c * v_p - s * v_q;
      vectors[i][q] = s * v_p + c * v_q;
    }
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
  Tensor<2, 3> m       = symmetric;
  Eigensystem  result  = {{{0, 0, 0}}, Tensor<2, 3>()};
  const double epsilon = 0.25 * std::numeric_limits<double>::epsilon();
  for (unsigned int i = 0; i < 3; ++i)
    result.vectors[i][i] = 1;
  bool rotated = true;
  // Jacobi's method converges quadratically: five sweeps are much, the bound only ends NaN.
  for (unsigned int sweep = 0; sweep < 20 && rotated; ++sweep)
    {
      rotated = false;
      for (unsigned int p = 0; p < 2; ++p)
        for (unsigned int q = p + 1; q < 3; ++q)
          if (std::abs(m[p][q]) > epsilon * (std::abs(m[p][p]) + std::abs(m[q][q])))
            {
              eliminate(m, result.vectors, p, q);
              rotated = true;
            }
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
