#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <vector>

namespace scree
{
/**
 * Points of many bodies sorted into the bins of a uniform grid, one grid per body: finds the points
 * of a body within a radius without visiting those of others and without allocating. The points
 * are copied in the order of the bins, so that a row of bins is one range of memory.
 */
template <int dim>
class PointSearch
{
public:
  /**
   * Sorts the points (O(n), counting sort). `bin_size` [L] should be about half the radius that
   * will be asked for; it is enlarged for a body whose bins would outnumber its points by four.
   */
  PointSearch(const std::vector<dealii::Point<dim>> &positions,
              const std::vector<unsigned int> &body, const double bin_size);

  /** Calls f(index, squared distance) for every point of `body` nearer than `radius` to x. */
  template <typename F>
  void for_each_within(const unsigned int body, const dealii::Point<dim> &x, const double radius,
                       const F &f) const;

  /** The nearest point of `body`, the first of equally near ones; none if the body has no points.
   */
  std::optional<unsigned int> nearest(const unsigned int body, const dealii::Point<dim> &x) const;

  /**
   * Calls f(first, last) for ranges of places in the sorted order that together hold every point
   * of `body` nearer than `radius` to x, and some more.
   */
  template <typename F>
  void for_each_range(const unsigned int body, const dealii::Point<dim> &x, const double radius,
                      const F &f) const;

  /** Number of the point at each place. */
  const std::vector<unsigned int> &sorted() const
  {
    return point_at;
  }

  /** Coordinate d of the point at each place [L]. */
  const std::vector<double> &coordinate(const unsigned int d) const
  {
    return coordinates[d];
  }

private:
  /** The bins of a body: n[0] * n[1] * ... from `first_bin` on, x fastest. */
  struct Bins
  {
    std::array<double, dim> lower;
    std::array<double, dim> upper;
    std::array<int, dim>    n{};
    double                  inverse_size = 0.;
    std::size_t             first_bin    = 0;
    bool                    empty        = true;

    int number(const double x, const unsigned int d) const
    {
      const double place = (x - lower[d]) * inverse_size;
      // In this order what is no number has a place, too.
      return place > 0. ? (place < n[d] ? static_cast<int>(place) : n[d] - 1) : 0;
    }

    /** Chooses n for bins of `size`, larger ones if they would outnumber the points by four: the
     * number of bins. */
    std::size_t divide(double size, const std::size_t n_points);
  };

  std::size_t bin_of(const Bins &bins, const dealii::Point<dim> &x) const;

  std::vector<Bins>                    body_bins;
  std::vector<unsigned int>            begin; //!< place of the first point of each bin
  std::vector<unsigned int>            point_at;
  std::array<std::vector<double>, dim> coordinates;
};

template <int dim>
template <typename F>
void
PointSearch<dim>::for_each_range(const unsigned int body, const dealii::Point<dim> &x,
                                 const double radius, const F &f) const
{
  if (body >= body_bins.size() || body_bins[body].empty)
    return;
  const Bins          &bins = body_bins[body];
  std::array<int, dim> first, last;
  for (unsigned int d = 0; d < dim; ++d)
    {
      if (x[d] + radius < bins.lower[d] || x[d] - radius > bins.upper[d])
        return;
      first[d] = bins.number(x[d] - radius, d);
      last[d]  = bins.number(x[d] + radius, d);
    }
  const int z_first = dim == 3 ? first[dim - 1] : 0, z_last = dim == 3 ? last[dim - 1] : 0;
  for (int z = z_first; z <= z_last; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      {
        const std::size_t row
          = bins.first_bin + (static_cast<std::size_t>(z) * bins.n[1] + y) * bins.n[0];
        f(begin[row + first[0]], begin[row + last[0] + 1]);
      }
}

template <int dim>
template <typename F>
void
PointSearch<dim>::for_each_within(const unsigned int body, const dealii::Point<dim> &x,
                                  const double radius, const F &f) const
{
  for_each_range(body, x, radius, [&](const unsigned int first, const unsigned int last) {
    for (unsigned int i = first; i < last; ++i)
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += (coordinates[d][i] - x[d]) * (coordinates[d][i] - x[d]);
        if (square < radius * radius)
          f(point_at[i], square);
      }
  });
}
} // namespace scree
