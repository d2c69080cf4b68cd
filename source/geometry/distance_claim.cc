#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/geometry/distance_claim.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace scree
{
namespace
{
constexpr double smallest_slope = 0.9, largest_slope = 1.1;
constexpr double most_points = 4e6;

/** |grad phi| by central differences over a tenth of the spacing. */
template <int dim>
double
slope(const Shape<dim> &shape, const dealii::Point<dim> &x, const double spacing)
{
  double squares = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Tensor<1, dim> step;
      step[d] = 0.1 * spacing;
      const double difference
        = (shape.signed_distance(x + step) - shape.signed_distance(x - step)) / (2. * step[d]);
      squares += difference * difference;
    }
  return std::sqrt(squares);
}
} // namespace

template <int dim>
void
require_distance(const Shape<dim> &shape, const double spacing, const dealii::BoundingBox<dim> &box,
                 const std::string &where)
{
  double n_points = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    n_points *= box.side_length(d) / spacing + 1.;
  const double step = spacing * std::max(1., std::pow(n_points / most_points, 1. / dim));
  std::array<std::size_t, dim> n, stride;
  std::size_t                  total = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      n[d]      = static_cast<std::size_t>(box.side_length(d) / step) + 1;
      stride[d] = total;
      total *= n[d];
    }
  const auto index
    = [&](const std::size_t i, const unsigned int d) { return i / stride[d] % n[d]; };
  const auto place = [&](const std::size_t i) {
    // Off the lines of the grid, where shapes like to have their edges.
    dealii::Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = box.lower_bound(d) + (0.37 + index(i, d)) * step;
    return x;
  };
  std::vector<double> phi(total);
  for (std::size_t i = 0; i < total; ++i)
    phi[i] = shape.signed_distance(place(i));

  std::size_t        n_near = 0, n_right = 0;
  double             worst = 1.;
  dealii::Point<dim> worst_place;
  for (std::size_t i = 0; i < total; ++i)
    {
      bool is_near = false;
      for (unsigned int d = 0; d < dim; ++d)
        is_near |= index(i, d) + 1 < n[d] && (phi[i] < 0.) != (phi[i + stride[d]] < 0.);
      if (!is_near)
        continue;
      const double s = slope(shape, place(i), spacing);
      ++n_near;
      n_right += s >= smallest_slope && s <= largest_slope;
      if (s > 0. && std::abs(std::log(s)) > std::abs(std::log(worst)))
        {
          worst       = s;
          worst_place = place(i);
        }
    }
  require(n_right >= 0.8 * n_near, where + "/Expression",
          "the expression is declared to be a distance, but is none: at " + short_place(worst_place)
            + ", near the surface, it changes by " + short_number(worst) + " per length, not by 1",
          "set Expression is distance = false, or divide the expression by its slope");
}

template void require_distance(const Shape<2> &, const double, const dealii::BoundingBox<2> &,
                               const std::string &);
template void require_distance(const Shape<3> &, const double, const dealii::BoundingBox<3> &,
                               const std::string &);
} // namespace scree
