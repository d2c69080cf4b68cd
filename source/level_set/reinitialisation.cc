#include <scree/level_set/closest_point.h>
#include <scree/level_set/contour_distance.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/reinitialisation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
// Joins the bits of every node with those of its neighbours along one axis.
void
dilate(std::vector<unsigned char> &bits, const std::size_t stride, const std::size_t n_nodes)
{
  const std::vector<unsigned char> before = bits;
  const std::size_t                block  = stride * n_nodes;
  for (std::size_t start = 0; start < bits.size(); start += block)
    for (std::size_t i = start; i < start + block - stride; ++i)
      {
        bits[i] |= before[i + stride];
        bits[i + stride] |= before[i];
      }
}

constexpr signed char full_weight = 6;
constexpr int         kink_reach  = 2; // nodes
constexpr int         band_width  = 2; // nodes beyond those of cut cells
constexpr double      near_reach  = 4; // spacings; up to there values may stay when others do not

// Raises the weights to those of the neighbours along one axis less 1.
void
spread(std::vector<signed char> &weight, const std::size_t stride, const std::size_t n_nodes)
{
  const std::size_t block = stride * n_nodes;
  const auto        raise = [&](const std::size_t i, const std::size_t j) {
    weight[i] = std::max(weight[i], static_cast<signed char>(weight[j] - 1));
  };
  for (std::size_t start = 0; start < weight.size(); start += block)
    {
      for (std::size_t i = start + stride; i < start + block; ++i)
        raise(i, i - stride);
      for (std::size_t i = start + block - stride; i-- > start;)
        raise(i, i + stride);
    }
}

template <int dim>
class Reinitialisation
{
public:
  Reinitialisation(Lattice<dim> &lattice, const ReinitialisationOptions &options);

  ReinitialisationCount run();

private:
  using Index = typename Lattice<dim>::Index;

  // Writes what slopes deviate into `count`, and the weights of the rebuilt values: 1 up to 2
  // steps from nodes beyond the tolerance, falling to 0 over 6 more. The band has one weight.
  void measure_slopes();

  void rebuild_band();

  void rebuild_rest();

  // Nodes of the band near kinks, whose factors are unknown (0), take those of the others.
  void spread_factors(std::vector<double> &factors) const;

  double contour_motion(const std::vector<double> &new_values) const;

  Lattice<dim>                  &lattice;
  const ReinitialisationOptions &options;
  std::array<std::size_t, dim>   stride;
  std::vector<unsigned char>     in_band;
  std::vector<signed char>       weight; // times 6
  std::vector<std::size_t>       band;
  ContourDistance<dim>           contour_distance;
  ReinitialisationCount          count{0, 0, 0, 0, 0};
};

template <int dim>
Reinitialisation<dim>::Reinitialisation(Lattice<dim>                  &lattice,
                                        const ReinitialisationOptions &options)
    : lattice(lattice)
    , options(options)
    , contour_distance(lattice)
{
  // Where both signs are within n + 1 nodes there is a cut cell within n.
  const std::vector<double> &values = lattice.values();
  in_band.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    in_band[i] = values[i] < 0 ? 1 : 2;
  std::size_t step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      for (unsigned int pass = 0; pass < band_width + 1; ++pass)
        dilate(in_band, step, lattice.n_nodes()[d]);
      step *= lattice.n_nodes()[d];
    }
  for (std::size_t i = 0; i < values.size(); ++i)
    {
      in_band[i] = in_band[i] == 3;
      if (in_band[i])
        band.push_back(i);
    }
}

template <int dim>
void
Reinitialisation<dim>::measure_slopes()
{
  const double *values = lattice.values().data();
  const Index  &n      = lattice.n_nodes();
  weight.assign(lattice.values().size(), 0);
  for (int k = dim == 3; k < (dim == 3 ? n[dim - 1] - 1 : 1); ++k)
    for (int j = 1; j < n[1] - 1; ++j)
      for (int i = 1; i < n[0] - 1; ++i)
        {
          const std::size_t at     = i + j * stride[1] + (dim == 3 ? k * stride[dim - 1] : 0);
          double            square = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double difference = values[at + stride[d]] - values[at - stride[d]];
              square += difference * difference;
            }
          const double deviation = std::abs(std::sqrt(square) / (2 * lattice.spacing()) - 1);
          double      &largest   = in_band[at] ? count.deviation_near : count.deviation_far;
          if (deviation > options.tolerance)
            {
              if (contour_distance.kink_near(lattice.index(at), kink_reach))
                continue;
              weight[at] = full_weight + 2;
            }
          largest = std::max(largest, deviation);
        }
  if (count.deviation_near > options.tolerance)
    for (const std::size_t i : band)
      weight[i] = full_weight + 2;
  for (unsigned int d = 0; d < dim; ++d)
    spread(weight, stride[d], n[d]);
}

template <int dim>
void
Reinitialisation<dim>::spread_factors(std::vector<double> &factors) const
{
  std::vector<std::size_t> open;
  for (const std::size_t i : band)
    if (factors[i] == 0)
      open.push_back(i);
  while (!open.empty())
    {
      std::vector<std::pair<std::size_t, double>> found;
      std::vector<std::size_t>                    still_open;
      for (const std::size_t i : open)
        {
          const Index  node = lattice.index(i);
          double       sum  = 0;
          unsigned int n    = 0;
          for (unsigned int d = 0; d < dim; ++d)
            for (const int side : {-1, 1})
              {
                Index neighbour = node;
                neighbour[d] += side;
                if (!lattice.contains(neighbour))
                  continue;
                const double factor = factors[lattice.offset(neighbour)];
                sum += factor;
                n += factor > 0;
              }
          if (n > 0)
            found.emplace_back(i, sum / n);
          else
            still_open.push_back(i);
        }
      if (found.empty())
        for (const std::size_t i : still_open)
          found.emplace_back(i, 1.);
      for (const auto &[i, factor] : found)
        factors[i] = factor;
      open.swap(still_open);
    }
}

template <int dim>
double
Reinitialisation<dim>::contour_motion(const std::vector<double> &new_values) const
{
  Lattice<dim> moved   = lattice;
  moved.values()       = new_values;
  double        result = 0;
  const double *values = lattice.values().data();
  for (const std::size_t i : band)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Index node = lattice.index(i);
        if (node[d] + 1 == lattice.lower()[d] + lattice.n_nodes()[d])
          continue;
        const double a = values[i], b = values[i + stride[d]];
        if ((a < 0) == (b < 0))
          continue;
        Point<dim> cut = lattice.node(node);
        cut[d] += a / (a - b) * lattice.spacing();
        const ClosestPoint<dim> foot = project(lattice, cut, options.degree);
        if (!foot.converged)
          continue;
        const auto [value, gradient] = moved.value_and_gradient(foot.point, options.degree);
        result                       = std::max(result, std::abs(value) / gradient.norm());
      }
  return result;
}

template <int dim>
void
Reinitialisation<dim>::rebuild_band()
{
  std::vector<double> values = lattice.values(), factors(values.size(), 0.);
  for (const std::size_t i : band)
    if (values[i] != 0 && !contour_distance.kink_near(lattice.index(i), kink_reach))
      {
        const double distance = contour_distance(i);
        if (std::isfinite(distance))
          factors[i] = distance / values[i];
      }
  spread_factors(factors);
  for (const std::size_t i : band)
    values[i] *= factors[i];
  count.n_changed_near = band.size();
  count.contour_motion = contour_motion(values);
  lattice.values().swap(values);
}

template <int dim>
void
Reinitialisation<dim>::rebuild_rest()
{
  const std::vector<double> before = lattice.values();
  march_distances(lattice, std::vector<char>(in_band.begin(), in_band.end()));
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!in_band[i])
      {
        double      &value  = lattice.values()[i];
        const double remote = std::abs(value) / (near_reach * lattice.spacing()) - 1;
        const double w      = std::clamp(std::max(remote, double(weight[i]) / full_weight), 0., 1.);
        value               = before[i] + (value - before[i]) * w;
        count.n_changed_far += w > 0;
      }
}

template <int dim>
ReinitialisationCount
Reinitialisation<dim>::run()
{
  measure_slopes();
  const bool near = count.deviation_near > options.tolerance;
  if (near)
    rebuild_band();
  if (near || count.deviation_far > options.tolerance)
    rebuild_rest();
  return count;
}
} // namespace

template <int dim>
ReinitialisationCount
reinitialise(Lattice<dim> &lattice, const ReinitialisationOptions &options)
{
  AssertThrow(has_contour(lattice),
              ExcMessage("The level set has no zero contour on its lattice."));
  return Reinitialisation<dim>(lattice, options).run();
}

#define INSTANTIATE(dim) \
  template ReinitialisationCount reinitialise(Lattice<dim> &, const ReinitialisationOptions &);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
