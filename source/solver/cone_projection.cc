#include <scree/solver/cone_projection.h>
#include <scree/solver/mumps.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace scree
{
namespace
{
double
dot(const std::vector<double> &a, const std::vector<double> &b)
{
  double sum = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

/** A^T r for columns given as rows. */
std::vector<double>
transposed_times(const SparseRows &A, const std::vector<double> &r)
{
  std::vector<double> result(A.n_rows());
  for (std::size_t j = 0; j < A.n_rows(); ++j)
    for (std::size_t i = A.begin[j]; i < A.begin[j + 1]; ++i)
      result[j] += A.values[i] * r[A.columns[i]];
  return result;
}

/** r += A x */
void
add_product(const SparseRows &A, const std::vector<double> &x, std::vector<double> &r)
{
  for (std::size_t j = 0; j < A.n_rows(); ++j)
    for (std::size_t i = A.begin[j]; i < A.begin[j + 1]; ++i)
      r[A.columns[i]] += A.values[i] * x[j];
}

/** Columns of unit length; those without length are left out. */
SparseRows
directions(const SparseRows &reactions)
{
  SparseRows result;
  for (std::size_t j = 0; j < reactions.n_rows(); ++j)
    {
      double square = 0.;
      for (std::size_t i = reactions.begin[j]; i < reactions.begin[j + 1]; ++i)
        square += reactions.values[i] * reactions.values[i];
      if (square == 0.)
        continue;
      for (std::size_t i = reactions.begin[j]; i < reactions.begin[j + 1]; ++i)
        {
          result.columns.push_back(reactions.columns[i]);
          result.values.push_back(reactions.values[i] / std::sqrt(square));
        }
      result.begin.push_back(result.columns.size());
    }
  return result;
}

/** The matrix I + A D A^T with a diagonal D that changes. */
class WeightedNormalMatrix
{
public:
  WeightedNormalMatrix(const SparseRows &A, const std::size_t n)
      : A(A)
      , entries(pattern(A, n))
      , mumps(n, true, entries, {}, MPI_COMM_SELF)
  {
  }

  void factorise(const std::vector<double> &D)
  {
    std::size_t k = 0;
    for (std::size_t j = 0; j < A.n_rows(); ++j)
      for (std::size_t a = A.begin[j]; a < A.begin[j + 1]; ++a)
        for (std::size_t b = A.begin[j]; b < A.begin[j + 1]; ++b)
          if (A.columns[b] <= A.columns[a])
            entries.values[k++] = D[j] * A.values[a] * A.values[b];
    mumps.factorise(entries.values);
  }

  void solve(std::vector<double> &right) const
  {
    mumps.solve(right);
  }

private:
  /** Of the lower triangle, column by column of A, then the diagonal of I. */
  static MatrixEntries pattern(const SparseRows &A, const std::size_t n)
  {
    MatrixEntries result;
    for (std::size_t j = 0; j < A.n_rows(); ++j)
      for (std::size_t a = A.begin[j]; a < A.begin[j + 1]; ++a)
        for (std::size_t b = A.begin[j]; b < A.begin[j + 1]; ++b)
          if (A.columns[b] <= A.columns[a])
            {
              result.rows.push_back(A.columns[a]);
              result.columns.push_back(A.columns[b]);
            }
    result.values.assign(result.rows.size(), 0.);
    for (std::size_t i = 0; i < n; ++i)
      {
        result.rows.push_back(i);
        result.columns.push_back(i);
        result.values.push_back(1.);
      }
    return result;
  }

  const SparseRows &A;
  MatrixEntries     entries;
  Mumps             mumps;
};

/** Iterates x > 0 and z > 0 towards z = A^T r, r = f + A x and x_j z_j = 0 for all j. */
class InteriorPoint
{
public:
  /** Columns and f have unit length. */
  InteriorPoint(const SparseRows &A, const std::vector<double> &f)
      : A(A)
      , f(f)
      , normal_matrix(A, f.size())
      , x(A.n_rows(), 1. / A.n_rows())
      , z(A.n_rows(), 1.)
  {
    update();
  }

  /** What the largest of sqrt(x_j z_j), and of the difference of A^T r from z, is: a load of that
   * size may be taken for one that the columns balance, or the reverse. */
  double defect() const
  {
    double result = 0.;
    for (std::size_t j = 0; j < x.size(); ++j)
      result = std::max({result, std::sqrt(x[j] * z[j]), std::abs(dual_defect[j])});
    return result;
  }

  /** A step of Newton, predicted and corrected as by Mehrotra. */
  void iterate()
  {
    const std::size_t   m = x.size();
    std::vector<double> D(m);
    for (std::size_t j = 0; j < m; ++j)
      D[j] = std::min(x[j] / z[j], largest_weight);
    normal_matrix.factorise(D);
    std::vector<double> wanted(m), dx, dz; // of the changes of x_j z_j
    for (std::size_t j = 0; j < m; ++j)
      wanted[j] = -x[j] * z[j];
    find_step(D, wanted, dx, dz);
    const double predicted_x = std::min(1., largest_step(x, dx)),
                 predicted_z = std::min(1., largest_step(z, dz));
    double gap = 0., predicted_gap = 0.;
    for (std::size_t j = 0; j < m; ++j)
      {
        gap += x[j] * z[j];
        predicted_gap += (x[j] + predicted_x * dx[j]) * (z[j] + predicted_z * dz[j]);
      }
    const double centre = gap / m * std::pow(predicted_gap / gap, 3);
    for (std::size_t j = 0; j < m; ++j)
      wanted[j] = centre - x[j] * z[j] - dx[j] * dz[j];
    find_step(D, wanted, dx, dz);
    // One length for both, as their equations are coupled by A^T A.
    constexpr double to_boundary = 0.995;
    const double     length
      = std::min(1., to_boundary * std::min(largest_step(x, dx), largest_step(z, dz)));
    for (std::size_t j = 0; j < m; ++j)
      {
        x[j] += length * dx[j];
        z[j] += length * dz[j];
      }
    update();
  }

  /** r, with x and z taken for zero where they are the smaller one: what f has besides the columns
   * that press. */
  std::vector<double> finish()
  {
    // Each solution makes what the columns hold smaller by about this, and the last bits of the
    // rest worse.
    constexpr double       strength    = 1e6;
    constexpr unsigned int n_solutions = 8;
    std::vector<double>    diagonal(f.size()), D(x.size()); // of A_p A_p^T, the columns that press
    for (std::size_t j = 0; j < x.size(); ++j)
      if (x[j] > z[j])
        for (std::size_t i = A.begin[j]; i < A.begin[j + 1]; ++i)
          diagonal[A.columns[i]] += A.values[i] * A.values[i];
    const double largest = *std::max_element(diagonal.begin(), diagonal.end());
    for (std::size_t j = 0; j < x.size(); ++j)
      D[j] = x[j] > z[j] ? strength / largest : 0.;
    normal_matrix.factorise(D);
    std::vector<double> r = f;
    for (unsigned int i = 0; i < n_solutions; ++i)
      normal_matrix.solve(r);
    return r;
  }

private:
  /**
   * Solves dx_j / D_j + dz_j = wanted_j / x_j, dz = A^T A dx + dual_defect by w = A dx:
   * (I + A D A^T) w = A D (wanted / x - dual_defect).
   */
  void find_step(const std::vector<double> &D, const std::vector<double> &wanted,
                 std::vector<double> &dx, std::vector<double> &dz) const
  {
    const std::size_t m = x.size();
    dx.resize(m);
    for (std::size_t j = 0; j < m; ++j)
      dx[j] = D[j] * (wanted[j] / x[j] - dual_defect[j]);
    std::vector<double> w(f.size());
    add_product(A, dx, w);
    normal_matrix.solve(w);
    dz = transposed_times(A, w);
    for (std::size_t j = 0; j < m; ++j)
      {
        dx[j] -= D[j] * dz[j];
        dz[j] += dual_defect[j];
      }
  }

  /** The longest step that leaves all values positive or zero. */
  static double largest_step(const std::vector<double> &values, const std::vector<double> &changes)
  {
    double result = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < values.size(); ++j)
      if (changes[j] < 0.)
        result = std::min(result, -values[j] / changes[j]);
    return result;
  }

  void update()
  {
    residual = f;
    add_product(A, x, residual);
    dual_defect = transposed_times(A, residual);
    for (std::size_t j = 0; j < z.size(); ++j)
      dual_defect[j] -= z[j];
  }

  /** Of D_j = x_j / z_j: more of it would leave no digits of I in I + A D A^T. */
  static constexpr double largest_weight = 1e10;

  const SparseRows          &A;
  const std::vector<double> &f;
  WeightedNormalMatrix       normal_matrix;
  std::vector<double>        x, z, residual, dual_defect;
};
} // namespace

std::vector<double>
unbalanced_part(const std::vector<double> &f, const SparseRows &reactions)
{
  constexpr double       tolerance = 1e-11, nearly = 1e-8;
  constexpr unsigned int max_iterations = 50;
  const double           length         = std::sqrt(dot(f, f));
  const SparseRows       A              = directions(reactions);
  if (length == 0. || A.n_rows() == 0)
    return f;
  std::vector<double> unit = f;
  for (double &value : unit)
    value /= length;
  InteriorPoint point(A, unit);
  double        defect = point.defect(), before = 2. * defect;
  for (unsigned int i = 0; i < max_iterations && defect > tolerance; ++i)
    {
      if (defect < nearly && defect > before)
        break; // round-off
      point.iterate();
      before = std::exchange(defect, point.defect());
    }
  std::vector<double> result = point.finish();
  for (double &value : result)
    value *= length;
  return result;
}
} // namespace scree
