#include <scree/solver/cone_projection.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scree
{
namespace
{
double
dot(const double *a, const double *b, const std::size_t n)
{
  double sum = 0.;
  for (std::size_t i = 0; i < n; ++i)
    sum += a[i] * b[i];
  return sum;
}

/** Directions of unit length; columns without length vanish. */
std::vector<double>
normalised(std::vector<double> columns, const std::size_t n)
{
  for (std::size_t j = 0; j + n <= columns.size(); j += n)
    {
      const double length = std::sqrt(dot(&columns[j], &columns[j], n));
      for (std::size_t i = j; i < j + n; ++i)
        columns[i] /= length > 0. ? length : 1.;
    }
  return columns;
}

/** Active columns with their x, between the moves of Lawson and Hanson. */
class ActiveSet
{
public:
  /** Columns have unit length. */
  ActiveSet(const std::vector<double> &columns, const std::vector<double> &f)
      : columns(columns)
      , f(f)
      , residual(f)
      , is_tried(columns.size() / f.size(), 0)
  {
  }

  /** Takes the column along which |r| falls fastest; false: it falls along none. */
  bool grow(const double tolerance)
  {
    const std::size_t n = f.size(), none = is_tried.size();
    std::size_t       best     = none;
    double            steepest = -tolerance;
    for (std::size_t j = 0; j < none; ++j)
      {
        const double slope = is_tried[j] ? 0. : dot(&columns[j * n], residual.data(), n);
        if (slope < steepest)
          {
            best     = j;
            steepest = slope;
          }
      }
    if (best == none)
      return false;
    is_tried[best] = 1;
    active.push_back(best);
    x.push_back(0.);
    return true;
  }

  /** Goes towards the least squares solution on the active columns until it is feasible. */
  void solve(const double tolerance)
  {
    for (bool is_feasible = false; !is_feasible;)
      {
        const std::vector<double> wanted = least_squares();
        double                    step   = 1.;
        for (std::size_t k = 0; k < wanted.size(); ++k)
          if (wanted[k] <= 0.)
            step = std::min(step, x[k] <= 0. ? 0. : x[k] / (x[k] - wanted[k]));
        is_feasible        = true;
        std::size_t n_kept = 0;
        for (std::size_t k = 0; k < wanted.size(); ++k)
          {
            const double value = x[k] + step * (wanted[k] - x[k]);
            if (wanted[k] <= 0. && value <= tolerance)
              is_feasible = false;
            else
              {
                active[n_kept] = active[k];
                x[n_kept++]    = value;
              }
          }
        active.resize(n_kept);
        x.resize(n_kept);
      }
    update_residual();
  }

  const std::vector<double> &r() const
  {
    return residual;
  }

private:
  /** Of sum_k x_k a_k = -f by Gram and Schmidt, twice; columns without a new direction get 0. */
  std::vector<double> least_squares() const
  {
    const std::size_t                n = f.size(), m = active.size();
    std::vector<double>              Q(m * n), solution(m);
    std::vector<std::vector<double>> R(m);
    for (std::size_t k = 0; k < m; ++k)
      {
        double *q = &Q[k * n];
        std::copy_n(&columns[active[k] * n], n, q);
        R[k].assign(k + 1, 0.);
        for (std::size_t l = 0; l < 2 * k; ++l)
          {
            const double part = dot(&Q[l % k * n], q, n);
            R[k][l % k] += part;
            for (std::size_t i = 0; i < n; ++i)
              q[i] -= part * Q[l % k * n + i];
          }
        R[k][k] = std::sqrt(dot(q, q, n));
        if (R[k][k] < 1e-9)
          std::fill_n(q, n, 0.);
        else
          for (std::size_t i = 0; i < n; ++i)
            q[i] /= R[k][k];
      }
    for (std::size_t k = m; k-- > 0;)
      if (R[k][k] >= 1e-9)
        {
          solution[k] = -dot(&Q[k * n], f.data(), n);
          for (std::size_t l = k + 1; l < m; ++l)
            solution[k] -= R[l][k] * solution[l];
          solution[k] /= R[k][k];
        }
    return solution;
  }

  void update_residual()
  {
    const double before = dot(residual.data(), residual.data(), f.size());
    residual            = f;
    for (std::size_t k = 0; k < active.size(); ++k)
      for (std::size_t i = 0; i < f.size(); ++i)
        residual[i] += x[k] * columns[active[k] * f.size() + i];
    // A column that brought nothing is not tried again before another one did.
    if (dot(residual.data(), residual.data(), f.size()) < before * (1. - 1e-12))
      std::fill(is_tried.begin(), is_tried.end(), 0);
    for (const std::size_t column : active)
      is_tried[column] = 1;
  }

  const std::vector<double> &columns, &f;
  std::vector<double>        residual, x;
  std::vector<std::size_t>   active;
  std::vector<char>          is_tried;
};
} // namespace

std::vector<double>
unbalanced_part(const std::vector<double> &f, const std::vector<double> &columns)
{
  const double tolerance = 1e-10 * std::sqrt(dot(f.data(), f.data(), f.size()));
  if (tolerance == 0.)
    return f;
  const std::vector<double> directions = normalised(columns, f.size());
  ActiveSet                 set(directions, f);
  for (std::size_t change = 0; change < 20 * (f.size() + 10) && set.grow(tolerance); ++change)
    set.solve(tolerance);
  return set.r();
}
} // namespace scree
