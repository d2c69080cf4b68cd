#include <scree/level_set/binary_field.h>
#include <scree/level_set/fast_marching.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace scree
{
using namespace dealii;

namespace
{
// The part of [0, 1] where the linear function with the end values a, b is negative.
double
negative_part(const double a, const double b)
{
  if (a < 0 && b < 0)
    return 1;
  if (a >= 0 && b >= 0)
    return 0;
  return a < 0 ? a / (a - b) : b / (b - a);
}

// The same in a cell, with values in the order x, y, z.
template <int dim>
double
negative_part(const std::array<double, (1 << dim)> &f)
{
  constexpr int n      = 8;
  double        result = 0;
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    for (int j = 0; j < n; ++j)
      {
        const double t   = (j + 0.5) / n;
        const auto   end = [&](const int first) { return (1 - t) * f[first] + t * f[first + 2]; };
        if constexpr (dim == 2)
          result += negative_part(end(0), end(1)) / n;
        else
          {
            const double s = (k + 0.5) / n;
            result += negative_part((1 - s) * end(0) + s * end(4), (1 - s) * end(1) + s * end(5))
                      / (n * n);
          }
      }
  return result;
}

// The level below which the volume is `volume`, between the extreme values.
template <int dim>
double
level_of_volume(const Lattice<dim> &lattice, const double volume)
{
  const auto [lowest, highest]
    = std::minmax_element(lattice.values().begin(), lattice.values().end());
  const auto     excess = [&](const double level) { return volume_below(lattice, level) - volume; };
  std::uintmax_t n_trials = 60;
  const auto     bounds   = boost::math::tools::toms748_solve(
          excess, *lowest, *highest, excess(*lowest), excess(*highest),
          boost::math::tools::eps_tolerance<double>(46), n_trials);
  return 0.5 * (bounds.first + bounds.second);
}

// The volume of the voxels around negative nodes, clipped at the ends of the lattice.
template <int dim>
double
voxel_volume(const Lattice<dim> &lattice)
{
  double sum = 0;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (lattice.values()[i] < 0)
      {
        double     part = 1;
        const auto node = lattice.index(i);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const int position = node[d] - lattice.lower()[d];
            part *= position == 0 || position == lattice.n_nodes()[d] - 1 ? 0.5 : 1.;
          }
        sum += part;
      }
  return sum * std::pow(lattice.spacing(), dim);
}

// Applies (1/4, 1/2, 1/4) n_passes times along the axis with this stride, line by line; ends count
// twice.
void
smooth(std::vector<double> &values, const std::size_t stride, const std::size_t n_nodes,
       const unsigned int n_passes)
{
  std::vector<double> line(n_nodes + 2), before(n_nodes + 2); // from 1, with the ends again
  for (std::size_t first = 0; first < values.size(); ++first)
    {
      if (first / stride % n_nodes != 0)
        continue;
      for (std::size_t i = 0; i < n_nodes; ++i)
        line[i + 1] = values[first + i * stride];
      for (unsigned int pass = 0; pass < n_passes; ++pass)
        {
          line.swap(before);
          before.front() = before[1];
          before.back()  = before[n_nodes];
          for (std::size_t i = 1; i <= n_nodes; ++i)
            line[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
        }
      for (std::size_t i = 0; i < n_nodes; ++i)
        values[first + i * stride] = line[i + 1];
    }
}
} // namespace

template <int dim>
double
volume_below(const Lattice<dim> &lattice, const double level)
{
  std::array<std::size_t, 1 << dim> corner{};
  std::array<std::size_t, dim>      stride;
  const std::array<int, dim>       &n    = lattice.n_nodes();
  std::size_t                       step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      for (unsigned int c = 0; c < corner.size(); ++c)
        corner[c] += (c >> d & 1) * step;
      step *= n[d];
    }
  double sum = 0;
  for (int k = 0; k < (dim == 3 ? n[dim - 1] - 1 : 1); ++k)
    for (int j = 0; j < n[1] - 1; ++j)
      for (int i = 0; i < n[0] - 1; ++i)
        {
          const double *first
            = lattice.values().data() + i + j * stride[1] + (dim == 3 ? k * stride[dim - 1] : 0);
          std::array<double, 1 << dim> f;
          unsigned int                 n_negative = 0;
          for (unsigned int c = 0; c < f.size(); ++c)
            {
              f[c] = first[corner[c]] - level;
              n_negative += f[c] < 0;
            }
          sum += n_negative == 0 ? 0 : n_negative == f.size() ? 1 : negative_part<dim>(f);
        }
  return sum * std::pow(lattice.spacing(), dim);
}

template <int dim>
void
distance_from_labels(Lattice<dim> &lattice, const unsigned int n_passes, const bool is_unbiased)
{
  AssertThrow(has_contour(lattice), ExcMessage("The labels are all of one sign."));
  const double volume = voxel_volume(lattice);
  for (double &value : lattice.values())
    value = value < 0 ? -1 : 0;
  const auto smooth_all = [&]() {
    std::size_t stride = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        smooth(lattice.values(), stride, lattice.n_nodes()[d], n_passes);
        stride *= lattice.n_nodes()[d];
      }
  };
  smooth_all();
  if (is_unbiased)
    {
      const std::vector<double> once = lattice.values();
      smooth_all();
      for (std::size_t i = 0; i < once.size(); ++i)
        lattice.values()[i] = 2. * once[i] - lattice.values()[i];
    }
  const auto shift = [&]() {
    const double level = level_of_volume(lattice, volume);
    for (double &value : lattice.values())
      value -= level;
  };
  shift();
  compute_distances(lattice);
  shift();
}

#define INSTANTIATE(dim)                                      \
  template double volume_below(const Lattice<dim> &, double); \
  template void   distance_from_labels(Lattice<dim> &, unsigned int, bool);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
