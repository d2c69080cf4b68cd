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

double
dot(const SparseRows &rows, const std::size_t row, const double *b)
{
  double sum = 0.;
  for (std::size_t i = rows.begin[row]; i < rows.begin[row + 1]; ++i)
    sum += rows.values[i] * b[rows.columns[i]];
  return sum;
}

/** b += factor a */
void
add(const double factor, const SparseRows &rows, const std::size_t row, double *b)
{
  for (std::size_t i = rows.begin[row]; i < rows.begin[row + 1]; ++i)
    b[rows.columns[i]] += factor * rows.values[i];
}

/** Directions of unit length; rows without length vanish. */
SparseRows
normalised(SparseRows rows)
{
  for (std::size_t j = 0; j < rows.n_rows(); ++j)
    {
      const double *row    = rows.values.data() + rows.begin[j];
      const double  length = std::sqrt(dot(row, row, rows.begin[j + 1] - rows.begin[j]));
      for (std::size_t i = rows.begin[j]; i < rows.begin[j + 1]; ++i)
        rows.values[i] /= length > 0. ? length : 1.;
    }
  return rows;
}

/** Active columns with their x, between the moves of Lawson and Hanson. */
class ActiveSet
{
public:
  /** Columns have unit length. */
  ActiveSet(const SparseRows &columns, const std::vector<double> &f)
      : columns(columns)
      , f(f)
      , residual(f)
      , is_tried(columns.n_rows(), 0)
  {
  }

  /** Takes the column along which |r| falls fastest; false: it falls along none. */
  bool grow(const double tolerance)
  {
    const std::size_t none     = is_tried.size();
    std::size_t       best     = none;
    double            steepest = -tolerance;
    for (std::size_t j = 0; j < none; ++j)
      {
        const double slope = is_tried[j] ? 0. : dot(columns, j, residual.data());
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
              {
                is_feasible      = false;
                n_orthogonalised = std::min(n_orthogonalised, n_kept);
              }
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
  /** Q R of the active columns by Gram and Schmidt, twice, from the first that is new on; columns
   * without a new direction get Q = 0. */
  void orthogonalise()
  {
    const std::size_t n = f.size(), m = active.size();
    Q.resize(m * n);
    R.resize(m);
    for (std::size_t k = n_orthogonalised; k < m; ++k)
      {
        double *q = &Q[k * n];
        std::fill_n(q, n, 0.);
        add(1., columns, active[k], q);
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
    n_orthogonalised = m;
  }

  /** Of sum_k x_k a_k = -f; columns without a new direction get 0. */
  std::vector<double> least_squares()
  {
    orthogonalise();
    const std::size_t   n = f.size(), m = active.size();
    std::vector<double> solution(m);
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
      add(x[k], columns, active[k], residual.data());
    // A column that brought nothing is not tried again before another one did.
    if (dot(residual.data(), residual.data(), f.size()) < before * (1. - 1e-12))
      std::fill(is_tried.begin(), is_tried.end(), 0);
    for (const std::size_t column : active)
      is_tried[column] = 1;
  }

  const SparseRows                &columns;
  const std::vector<double>       &f;
  std::vector<double>              residual, x;
  std::vector<std::size_t>         active;
  std::vector<char>                is_tried;
  std::vector<double>              Q; //!< of the active columns, one after the other
  std::vector<std::vector<double>> R; //!< its columns, to the diagonal
  std::size_t                      n_orthogonalised = 0;
};
} // namespace

std::vector<double>
unbalanced_part(const std::vector<double> &f, const SparseRows &reactions)
{
  const double tolerance = 1e-10 * std::sqrt(dot(f.data(), f.data(), f.size()));
  if (tolerance == 0.)
    return f;
  const SparseRows directions = normalised(reactions);
  ActiveSet        set(directions, f);
  for (std::size_t change = 0; change < 20 * (f.size() + 10) && set.grow(tolerance); ++change)
    set.solve(tolerance);
  return set.r();
}
} // namespace scree
