#include <scree/points/point_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

template <int dim>
std::size_t
PointSearch<dim>::bin_of(const Bins &bins, const Point<dim> &x) const
{
  std::size_t bin = 0;
  for (int d = dim - 1; d >= 0; --d)
    bin = bin * bins.n[d] + bins.number(x[d], d);
  return bins.first_bin + bin;
}

template <int dim>
std::size_t
PointSearch<dim>::Bins::divide(double size, const std::size_t n_points)
{
  const auto count = [&](const double size) {
    double product = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      product *= std::floor((upper[d] - lower[d]) / size) + 1.;
    return product;
  };
  while (count(size) > 4. * n_points + 1.)
    size *= 1.25;
  std::size_t n_bins = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      n[d] = static_cast<int>((upper[d] - lower[d]) / size) + 1;
      n_bins *= n[d];
    }
  inverse_size = 1. / size;
  return n_bins;
}

template <int dim>
PointSearch<dim>::PointSearch(const std::vector<Point<dim>>   &positions,
                              const std::vector<unsigned int> &body, const double bin_size)
{
  AssertDimension(positions.size(), body.size());
  Assert(bin_size > 0., ExcMessage("Bins need a size."));
  const std::size_t n_points = positions.size();
  const auto        n_bodies = n_points == 0 ? 0u : *std::max_element(body.begin(), body.end()) + 1;

  body_bins.resize(n_bodies);
  std::vector<std::size_t> n_points_of(n_bodies, 0);
  for (Bins &bins : body_bins)
    {
      bins.lower.fill(std::numeric_limits<double>::max());
      bins.upper.fill(std::numeric_limits<double>::lowest());
    }
  for (std::size_t i = 0; i < n_points; ++i)
    {
      Bins &bins = body_bins[body[i]];
      ++n_points_of[body[i]];
      bins.empty = false;
      for (unsigned int d = 0; d < dim; ++d)
        {
          bins.lower[d] = std::min(bins.lower[d], positions[i][d]);
          bins.upper[d] = std::max(bins.upper[d], positions[i][d]);
        }
    }

  std::size_t n_bins = 0;
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      Bins &bins = body_bins[b];
      if (bins.empty)
        continue;
      bins.first_bin = n_bins;
      n_bins += bins.divide(bin_size, n_points_of[b]);
    }

  begin.assign(n_bins + 1, 0);
  std::vector<std::size_t> bin(n_points);
  for (std::size_t i = 0; i < n_points; ++i)
    {
      bin[i] = bin_of(body_bins[body[i]], positions[i]);
      ++begin[bin[i] + 1];
    }
  for (std::size_t k = 0; k < n_bins; ++k)
    begin[k + 1] += begin[k];

  point_at.resize(n_points);
  for (auto &c : coordinates)
    c.resize(n_points);
  std::vector<unsigned int> next(begin);
  for (std::size_t i = 0; i < n_points; ++i)
    {
      const unsigned int place = next[bin[i]]++;
      point_at[place]          = i;
      for (unsigned int d = 0; d < dim; ++d)
        coordinates[d][place] = positions[i][d];
    }
}

template <int dim>
std::optional<unsigned int>
PointSearch<dim>::nearest(const unsigned int body, const Point<dim> &x) const
{
  if (body >= body_bins.size() || body_bins[body].empty)
    return {};
  std::optional<unsigned int> result;
  double                      best   = std::numeric_limits<double>::max();
  double                      radius = 1. / body_bins[body].inverse_size;
  while (!result)
    {
      for_each_within(body, x, radius, [&](const unsigned int i, const double square) {
        if (square < best || (square == best && i < *result))
          {
            best   = square;
            result = i;
          }
      });
      radius *= 2.;
    }
  return result;
}

template class PointSearch<2>;
template class PointSearch<3>;
} // namespace scree
