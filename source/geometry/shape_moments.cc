#include <scree/geometry/shape_moments.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
namespace
{
/** Part of the unit cell, of edge 1 around the origin, with mean + slope . x < 0. */
template <int dim>
double
part_behind_plane(const double mean, dealii::Tensor<1, dim> slope)
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += std::abs(slope[d]);
  if (sum == 0.)
    return mean < 0. ? 1. : 0.;
  // n . x < alpha in [0, 1]^dim: the sum over the corners of (-1)^k <alpha - n . corner>^dim over
  // dim! n_1 ... n_dim.
  constexpr double smallest = 1e-4;
  double           product = 1., scale = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    {
      slope[d] = std::max(std::abs(slope[d]) / sum, smallest);
      product *= slope[d] * (d + 1.);
      scale += slope[d];
    }
  const double alpha  = 0.5 * scale - mean / sum;
  double       result = 0.;
  for (unsigned int corner = 0; corner < (1u << dim); ++corner)
    {
      double distance = alpha, sign = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        if ((corner >> d) & 1u)
          {
            distance -= slope[d];
            sign = -sign;
          }
      result += sign * std::pow(std::max(distance, 0.), dim);
    }
  return std::min(1., std::max(0., result / product));
}

/** Sums of volume, x and x x^T, about an origin near the shape. */
template <int dim>
struct Sums
{
  dealii::Point<dim>              origin;
  double                          volume = 0.;
  dealii::Tensor<1, dim>          first  = {};
  dealii::SymmetricTensor<2, dim> second = {};

  /** A part of a cube. */
  void add(const dealii::Point<dim> &centre, const double size, const double part)
  {
    const double                 v = part * std::pow(size, dim);
    const dealii::Tensor<1, dim> x = centre - origin;
    volume += v;
    first += v * x;
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int j = i; j < dim; ++j)
          second[i][j] += v * x[i] * x[j];
        second[i][i] += v * size * size / 12.;
      }
  }
};

/**
 * Adds what of a cube is inside: what a plane through the values at its corners cuts off, of its
 * halves where these are not linear, as at edges.
 */
template <int dim>
void
add_crossed_cell(const Shape<dim> &shape, const dealii::Point<dim> &centre, const double size,
                 const unsigned int n_halvings, const unsigned int n_more_at_edges, Sums<dim> &sums)
{
  constexpr unsigned int n_corners    = 1u << dim;
  constexpr double       nearly_plane = 0.02; // of the size
  const auto             corner_of    = [](const unsigned int c, const double distance) {
    dealii::Tensor<1, dim> arm;
    for (unsigned int d = 0; d < dim; ++d)
      arm[d] = ((c >> d) & 1u) != 0 ? distance : -distance;
    return arm;
  };
  std::array<double, n_corners> values;
  double                        mean = 0., largest = 0.;
  dealii::Tensor<1, dim>        slope; // over the size
  for (unsigned int c = 0; c < n_corners; ++c)
    {
      values[c] = shape.signed_distance(centre + corner_of(c, 0.5 * size));
      mean += values[c] / n_corners;
      slope += 2. / n_corners * values[c] * corner_of(c, 1.);
    }
  for (unsigned int c = 0; c < n_corners; ++c)
    largest = std::max(largest, std::abs(values[c] - mean - slope * corner_of(c, 0.5)));
  const bool is_bent = n_more_at_edges > 0 && largest > nearly_plane * slope.norm();
  if (n_halvings == 0 && !is_bent)
    {
      sums.add(centre, size, part_behind_plane<dim>(mean, slope));
      return;
    }
  for (unsigned int c = 0; c < n_corners; ++c)
    add_crossed_cell(shape, centre + corner_of(c, 0.25 * size), 0.5 * size,
                     n_halvings > 0 ? n_halvings - 1 : 0,
                     n_halvings > 0 ? n_more_at_edges : n_more_at_edges - 1, sums);
}
} // namespace

template <int dim>
ShapeMoments<dim>
moments_of(const Shape<dim> &shape, const Lattice<dim> &lattice)
{
  constexpr unsigned int n_corners = 1u << dim, n_halvings = 2, n_more_at_edges = 3;
  Sums<dim>              sums{lattice.box().center()};
  const auto            &lower   = lattice.lower();
  const auto            &n_nodes = lattice.n_nodes();
  std::size_t            n_cells = 1;
  for (unsigned int d = 0; d < dim; ++d)
    n_cells *= n_nodes[d] - 1;
  for (std::size_t cell = 0; cell < n_cells; ++cell)
    {
      typename Lattice<dim>::Index index;
      std::size_t                  rest = cell;
      for (unsigned int d = 0; d < dim; ++d)
        {
          index[d] = lower[d] + static_cast<int>(rest % (n_nodes[d] - 1));
          rest /= n_nodes[d] - 1;
        }
      unsigned int n_inside = 0;
      for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          auto node = index;
          for (unsigned int d = 0; d < dim; ++d)
            node[d] += static_cast<int>((corner >> d) & 1u);
          n_inside += lattice(node) < 0. ? 1 : 0;
        }
      const double       size   = lattice.spacing();
      dealii::Point<dim> centre = lattice.node(index);
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] += 0.5 * size;
      if (n_inside == n_corners)
        sums.add(centre, size, 1.);
      else if (n_inside > 0)
        add_crossed_cell(shape, centre, size, n_halvings, n_more_at_edges, sums);
    }
  ShapeMoments<dim> result;
  result.volume = sums.volume;
  if (sums.volume == 0.)
    return result;
  const dealii::Tensor<1, dim> mean = sums.first / sums.volume;
  result.centre                     = sums.origin + mean;
  result.second = sums.second - sums.volume * dealii::symmetrize(dealii::outer_product(mean, mean));
  return result;
}

template ShapeMoments<2> moments_of(const Shape<2> &, const Lattice<2> &);
template ShapeMoments<3> moments_of(const Shape<3> &, const Lattice<3> &);
} // namespace scree
