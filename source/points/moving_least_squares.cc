#include <scree/points/moving_least_squares.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
// Neighbours are treated in groups of this many, which the compiler turns into vector instructions.
constexpr unsigned int n_lanes = 8;

// Weights that interpolate are those of the spline over s'^2: they stop growing at this s'^2.
constexpr double singularity = 1e-6;

constexpr unsigned int
n_monomials(const unsigned int dim, const unsigned int degree)
{
  return dim == 2 ? (degree + 1) * (degree + 2) / 2
                  : (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/**
 * The monomials of degree <= D by total degree: each is a former one times a coordinate; and for
 * those of degree <= D/2 (the basis) the number of the product of two.
 */
template <int dim, int D>
struct Monomials
{
  static constexpr unsigned int n         = n_monomials(dim, D);
  static constexpr unsigned int n_basis   = n_monomials(dim, D / 2);
  unsigned int                  factor[n] = {}, coordinate[n] = {};
  unsigned int                  product[n_basis][n_basis] = {};

  constexpr Monomials()
  {
    unsigned int powers[n][dim] = {}, end = 1, previous = 0;
    for (unsigned int total = 1; total <= D; ++total)
      {
        const unsigned int last = end;
        for (unsigned int m = previous; m < last; ++m)
          for (unsigned int d = 0; d < dim; ++d)
            {
              bool is_new = true; // coordinates multiply in ascending order
              for (unsigned int e = d + 1; e < dim; ++e)
                is_new = is_new && powers[m][e] == 0;
              if (!is_new)
                continue;
              for (unsigned int e = 0; e < dim; ++e)
                powers[end][e] = powers[m][e] + (e == d);
              factor[end]     = m;
              coordinate[end] = d;
              ++end;
            }
        previous = last;
      }
    for (unsigned int i = 0; i < n_basis; ++i)
      for (unsigned int j = 0; j < n_basis; ++j)
        for (unsigned int m = 0; m < n; ++m)
          {
            bool is_product = true;
            for (unsigned int e = 0; e < dim; ++e)
              is_product = is_product && powers[m][e] == powers[i][e] + powers[j][e];
            if (is_product)
              product[i][j] = m;
          }
  }
};

template <int dim, int D>
constexpr Monomials<dim, D> monomials;

/** A symmetric positive matrix scaled to unit diagonal, factorised: S = L L^T, with L^{-1}. */
template <int n>
class ScaledCholesky
{
public:
  /** Factorises; bounds the smallest eigenvalue of S from below, zero if not positive. */
  double factorise(const double (&matrix)[n][n])
  {
    for (int i = 0; i < n; ++i)
      {
        if (!(matrix[i][i] > 0.))
          return 0.;
        scale[i] = 1. / std::sqrt(matrix[i][i]);
      }
    double lower[n][n];
    double trace = 0.; // of S^{-1} = |L^{-1}|_F^2
    for (int i = 0; i < n; ++i)
      {
        double pivot = 1.;
        for (int j = 0; j < i; ++j)
          {
            double sum = matrix[i][j] * scale[i] * scale[j];
            for (int k = 0; k < j; ++k)
              sum -= lower[i][k] * lower[j][k];
            lower[i][j] = sum * inverse[j][j];
            pivot -= lower[i][j] * lower[i][j];
          }
        if (!(pivot > 1e-14))
          return 0.;
        inverse[i][i] = 1. / std::sqrt(pivot);
        for (int j = 0; j < i; ++j)
          {
            double sum = 0.;
            for (int k = j; k < i; ++k)
              sum -= lower[i][k] * inverse[k][j];
            inverse[i][j] = sum * inverse[i][i];
          }
        for (int j = 0; j <= i; ++j)
          trace += inverse[i][j] * inverse[i][j];
      }
    return 1. / trace;
  }

  /** Adds the solution of M x = right_side to x. */
  void add_solution(const double (&right_side)[n], double (&x)[n]) const
  {
    double y[n];
    for (int i = 0; i < n; ++i)
      {
        y[i] = 0.;
        for (int j = 0; j <= i; ++j)
          y[i] += inverse[i][j] * scale[j] * right_side[j];
      }
    for (int i = 0; i < n; ++i)
      {
        double sum = 0.;
        for (int j = i; j < n; ++j)
          sum += inverse[j][i] * y[j];
        x[i] += sum * scale[i];
      }
  }

private:
  double scale[n], inverse[n][n];
};
} // namespace

template <int dim>
struct MovingLeastSquares<dim>::Neighbours
{
  std::array<std::vector<double>, dim> offset; // (x_i - x)/r
  std::vector<double>                  spline; // weight function; zero for the lanes that fill up
  std::vector<double>                  weight; // the result
  std::vector<unsigned int>            place;  // in the sorted order
  unsigned int                         n = 0;  // neighbours

  unsigned int n_padded() const
  {
    return (n + n_lanes - 1) / n_lanes * n_lanes;
  }

  void reserve(const std::size_t size)
  {
    if (place.size() >= size)
      return;
    const std::size_t enlarged = 2 * size;
    for (auto &o : offset)
      o.resize(enlarged);
    spline.resize(enlarged);
    weight.resize(enlarged);
    place.resize(enlarged);
  }

  /** Sums of all monomials times `factor` over the neighbours. */
  template <int D>
  void moments(const std::vector<double> &factor, double *result) const
  {
    constexpr auto &table                  = monomials<dim, D>;
    double          sums[table.n][n_lanes] = {}, values[table.n][n_lanes];
    for (unsigned int first = 0; first < n_padded(); first += n_lanes)
      {
        for (unsigned int l = 0; l < n_lanes; ++l)
          sums[0][l] += values[0][l] = factor[first + l];
        for (unsigned int m = 1; m < table.n; ++m)
          {
            const double *x     = offset[table.coordinate[m]].data() + first;
            const double *lower = values[table.factor[m]];
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                values[m][l] = lower[l] * x[l];
                sums[m][l] += values[m][l];
              }
          }
      }
    for (unsigned int m = 0; m < table.n; ++m)
      {
        result[m] = 0.;
        for (unsigned int l = 0; l < n_lanes; ++l)
          result[m] += sums[m][l];
      }
  }

  /** weight_i = spline_i * polynomial(offset_i). */
  template <int D>
  void evaluate(const double *coefficients)
  {
    constexpr auto &table = monomials<dim, D>;
    for (unsigned int first = 0; first < n_padded(); first += n_lanes)
      {
        double values[table.n][n_lanes], sum[n_lanes];
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            values[0][l] = spline[first + l];
            sum[l]       = coefficients[0] * values[0][l];
          }
        for (unsigned int m = 1; m < table.n; ++m)
          {
            const double *x     = offset[table.coordinate[m]].data() + first;
            const double *lower = values[table.factor[m]];
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                values[m][l] = lower[l] * x[l];
                sum[l] += coefficients[m] * values[m][l];
              }
          }
        for (unsigned int l = 0; l < n_lanes; ++l)
          weight[first + l] = sum[l];
      }
  }
};

template <int dim>
MovingLeastSquares<dim>::MovingLeastSquares(const std::vector<Point<dim>>   &positions,
                                            const std::vector<unsigned int> &body,
                                            const std::vector<double>       &point_spacing,
                                            const MovingLeastSquaresOptions &options)
    : options(options)
    , search(positions, body,
             [&] {
               double sum = 0.;
               for (const double s : point_spacing)
                 sum += s;
               return sum > 0. ? 1.5 * sum / point_spacing.size() : 1.;
             }())
    , spacing(positions.size())
{
  AssertDimension(positions.size(), point_spacing.size());
  AssertIndexRange(options.degree, 3);
  Assert(options.support > 0., ExcMessage("The support must be positive."));
  for (std::size_t i = 0; i < spacing.size(); ++i)
    spacing[i] = point_spacing[search.sorted()[i]];
}

/** Collects the neighbours within `radius` and returns their weighted mean spacing. */
template <int dim>
double
MovingLeastSquares<dim>::gather(const unsigned int body, const Point<dim> &x, const double radius,
                                Neighbours &neighbours) const
{
  const double inverse_radius = 1. / radius;
  unsigned int n              = 0;
  search.for_each_range(body, x, radius, [&](const unsigned int first, const unsigned int last) {
    neighbours.reserve(n + last - first + n_lanes);
    for (unsigned int i = first; i < last; ++i)
      {
        // Written always, kept by advancing n: no branch to mispredict.
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double offset     = (search.coordinate(d)[i] - x[d]) * inverse_radius;
            neighbours.offset[d][n] = offset;
            square += offset * offset;
          }
        neighbours.spline[n] = square;
        neighbours.place[n]  = i;
        n += square < 1.;
      }
  });
  neighbours.n = n;
  neighbours.reserve(n + n_lanes);
  double sum_weights = 0., sum_spacings = 0.;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double square = 2.25 * neighbours.spline[i];
      const double rest   = 1.5 - std::sqrt(square);
      double       spline = square <= 0.25 ? 0.75 - square : 0.5 * rest * rest;
      if (options.interpolates)
        spline /= square + singularity;
      neighbours.spline[i] = spline;
      sum_weights += spline;
      sum_spacings += spline * spacing[neighbours.place[i]];
    }
  for (; n < neighbours.n_padded(); ++n)
    {
      neighbours.spline[n] = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        neighbours.offset[d][n] = 0.;
    }
  return sum_weights > 0. ? sum_spacings / sum_weights : 0.;
}

template <int dim>
template <int degree>
bool
MovingLeastSquares<dim>::try_degree(const Targets<dim> &targets, const std::size_t t,
                                    Neighbours &neighbours, MovingLeastSquaresReport &report) const
{
  constexpr unsigned int n         = n_monomials(dim, degree);
  constexpr unsigned int n_moments = n_monomials(dim, 2 * degree);
  constexpr double       smallest  = degree == 0 ? 0. : degree == 1 ? 1e-3 : 1e-5;
  constexpr auto        &table     = monomials<dim, 2 * degree>;

  double radius = options.support * targets.cell_size[t];
  for (unsigned int attempt = 0; attempt <= 6; ++attempt, radius *= 1.25)
    {
      const auto search_within
        = [&] { return gather(targets.body[t], targets.position[t], radius, neighbours); };
      const double local = options.support * search_within();
      if (local > radius)
        {
          radius = local;
          search_within();
        }
      if (neighbours.n < n)
        continue;

      double moments[n_moments], matrix[n][n];
      neighbours.template moments<2 * degree>(neighbours.spline, moments);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix[i][j] = moments[table.product[i][j]];
      ScaledCholesky<n> cholesky;
      const double      eigenvalue = cholesky.factorise(matrix);
      if (!(eigenvalue > smallest))
        continue;

      double residual[n] = {1.}, coefficients[n] = {};
      cholesky.add_solution(residual, coefficients);
      neighbours.template evaluate<degree>(coefficients);
      if (eigenvalue < 0.01)
        {
          neighbours.template moments<degree>(neighbours.weight, residual);
          for (unsigned int i = 0; i < n; ++i)
            residual[i] = (i == 0) - residual[i];
          cholesky.add_solution(residual, coefficients);
          neighbours.template evaluate<degree>(coefficients);
        }
      report.widened += attempt > 0 && degree == options.degree;
      return true;
    }
  return false;
}

/** Finds the weights of target t, by the highest degree that the points around it allow. */
template <int dim>
void
MovingLeastSquares<dim>::solve(const Targets<dim> &targets, const std::size_t t,
                               Neighbours &neighbours, MovingLeastSquaresReport &report) const
{
  if (options.degree >= 2 && try_degree<2>(targets, t, neighbours, report))
    return;
  if (options.degree >= 1)
    {
      report.lowered += options.degree > 1;
      if (try_degree<1>(targets, t, neighbours, report))
        return;
    }
  report.lowered += options.degree == 1;
  report.constant += options.degree > 0;
  if (try_degree<0>(targets, t, neighbours, report))
    return;
  neighbours.n = 0;
  if (const auto nearest = search.nearest(targets.body[t], targets.position[t]))
    {
      neighbours.n = 1;
      neighbours.reserve(n_lanes);
      neighbours.weight[0] = 1.;
      neighbours.place[0]  = *nearest;
    }
}

template <int dim>
PointWeights
MovingLeastSquares<dim>::weights(const Targets<dim> &targets) const
{
  AssertDimension(targets.position.size(), targets.body.size());
  AssertDimension(targets.position.size(), targets.cell_size.size());
  PointWeights result;
  result.report.n_targets = targets.position.size();
  result.begin.reserve(targets.position.size() + 1);
  Neighbours neighbours;
  neighbours.reserve(256);
  for (std::size_t t = 0; t < targets.position.size(); ++t)
    {
      solve(targets, t, neighbours, result.report);
      double amplification = 0.;
      for (unsigned int i = 0; i < neighbours.n; ++i)
        {
          result.points.push_back(search.sorted()[neighbours.place[i]]);
          result.weights.push_back(neighbours.weight[i]);
          amplification += std::abs(neighbours.weight[i]);
        }
      result.begin.push_back(result.points.size());
      result.report.without_points += neighbours.n == 0;
      result.report.largest_amplification
        = std::max(result.report.largest_amplification, amplification);
    }
  return result;
}

std::vector<double>
PointWeights::values(const std::vector<double> &field, const unsigned int n) const
{
  std::vector<double> result(n * n_targets(), 0.);
  for (std::size_t t = 0; t < n_targets(); ++t)
    for (std::size_t i = begin[t]; i < begin[t + 1]; ++i)
      for (unsigned int c = 0; c < n; ++c)
        result[n * t + c] += weights[i] * field[std::size_t(n) * points[i] + c];
  return result;
}

template <int dim>
std::vector<Tensor<2, dim>>
interpolated_gradients(const PointWeights &weights, const std::vector<Tensor<2, dim>> &of_points)
{
  constexpr double largest_ratio = 4.;
  auto             result        = weights.values(of_points);
  for (std::size_t t = 0; t < result.size(); ++t)
    {
      const std::size_t begin = weights.begin[t], end = weights.begin[t + 1];
      if (begin == end)
        continue;
      double volume_ratio = 0.;
      for (std::size_t i = begin; i < end; ++i)
        volume_ratio += weights.weights[i] * determinant(of_points[weights.points[i]]);
      const double ratio = volume_ratio / determinant(result[t]);
      if (volume_ratio > 0. && ratio > 0. && ratio <= largest_ratio)
        result[t] *= std::pow(ratio, 1. / dim);
      else
        {
          const auto first = weights.weights.begin();
          result[t]
            = of_points[weights.points[std::max_element(first + begin, first + end) - first]];
        }
    }
  return result;
}

template std::vector<Tensor<2, 2>> interpolated_gradients(const PointWeights &,
                                                          const std::vector<Tensor<2, 2>> &);
template std::vector<Tensor<2, 3>> interpolated_gradients(const PointWeights &,
                                                          const std::vector<Tensor<2, 3>> &);
template class MovingLeastSquares<2>;
template class MovingLeastSquares<3>;
} // namespace scree
