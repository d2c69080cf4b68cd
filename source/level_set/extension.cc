#include <scree/level_set/extension.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim, std::size_t n_components>
class Extension
{
public:
  using Values = std::array<std::vector<double>, n_components>;

  Extension(const Lattice<dim> &phi, const std::vector<char> &known,
            const ExtensionOptions &options, Values &v);

  ExtensionCount run();

private:
  using Gradient = std::array<double, n_components>; // differences along one axis over one spacing

  // A one-sided difference towards nodes with values: v_i is weighted with `weight`.
  struct Difference
  {
    double         weight;
    unsigned int   axis;
    std::ptrdiff_t step;
    bool           second_order;
  };

  struct Stencil
  {
    std::array<Difference, 2 * dim> differences;
    unsigned int                    n = 0;
  };

  bool exists(const std::array<int, dim> &position, unsigned int axis, int steps) const;

  std::array<int, dim> position(std::size_t node) const;

  // The unknown nodes of the band by |phi|.
  std::vector<std::uint32_t> order(double band) const;

  // The differences towards nodes with smaller |phi|.
  Stencil stencil(std::size_t node) const;

  // First-order differences towards all neighbours with values, with equal weights.
  Stencil neighbours_with_values(std::size_t node) const;

  // The differences of v along an axis at a known node, those of its known neighbours where it
  // sticks out.
  Gradient gradient_of_known(std::size_t node, unsigned int axis) const;

  // The gradient at a known node: of a fit if that is wanted and possible, else of differences.
  std::array<Gradient, dim> gradient_of_known(std::size_t node) const;

  // The gradient of the affine fit around a known node; false if the nodes do not determine it.
  bool fitted_gradient(std::size_t node, std::array<Gradient, dim> &result) const;

  // The differences at this node only; false if no neighbour there is known.
  bool difference_of_known(std::size_t node, unsigned int axis, Gradient &result) const;

  // Numbers the gradients of the nodes to extend to and of the known ones that their stencils
  // reach, and sets the latter.
  void set_gradients_of_known();

  void set(std::size_t node, const Stencil &stencil);

  const Lattice<dim>             &phi;
  const bool                      linear;
  const int                       fit;
  Values                         &v;
  std::vector<char>               has_value;
  std::array<std::ptrdiff_t, dim> stride;
  std::vector<std::uint32_t>      nodes;        // to extend to, in their order
  std::vector<std::uint32_t>      gradients_at; // node -> its first gradient, if linear
  std::vector<Gradient>           gradients;    // dim per node that needs them
};

template <int dim, std::size_t n_components>
Extension<dim, n_components>::Extension(const Lattice<dim> &phi, const std::vector<char> &known,
                                        const ExtensionOptions &options, Values &v)
    : phi(phi)
    , linear(options.extrapolation == Extrapolation::linear)
    , fit(options.fit)
    , v(v)
    , has_value(known)
{
  AssertDimension(known.size(), phi.values().size());
  for (std::size_t c = 0; c < n_components; ++c)
    AssertDimension(v[c].size(), phi.values().size());
  AssertThrow(std::any_of(known.begin(), known.end(), [](const char k) { return k != 0; }),
              ExcMessage("No node has values that could be extended."));
  std::ptrdiff_t step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      step *= phi.n_nodes()[d];
    }
  nodes = order(options.band * phi.spacing());
  if (linear)
    set_gradients_of_known();
}

template <int dim, std::size_t n_components>
inline bool
Extension<dim, n_components>::exists(const std::array<int, dim> &position, const unsigned int axis,
                                     const int steps) const
{
  const int p = position[axis] + steps;
  return p >= 0 && p < phi.n_nodes()[axis];
}

template <int dim, std::size_t n_components>
inline std::array<int, dim>
Extension<dim, n_components>::position(const std::size_t node) const
{
  std::array<int, dim> result;
  std::uint32_t        rest = node;
  for (unsigned int d = 0; d < dim; ++d)
    {
      result[d] = rest % static_cast<std::uint32_t>(phi.n_nodes()[d]);
      rest /= phi.n_nodes()[d];
    }
  return result;
}

template <int dim, std::size_t n_components>
std::vector<std::uint32_t>
Extension<dim, n_components>::order(const double band) const
{
  // Sorting keys and nodes together keeps the comparisons local.
  std::vector<std::pair<float, std::uint32_t>> keys;
  for (std::size_t i = 0; i < has_value.size(); ++i)
    if (!has_value[i] && std::abs(phi.values()[i]) <= band)
      keys.emplace_back(static_cast<float>(std::abs(phi.values()[i])), i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> result;
  result.reserve(keys.size());
  for (const auto &[distance, node] : keys)
    result.push_back(node);
  return result;
}

template <int dim, std::size_t n_components>
typename Extension<dim, n_components>::Stencil
Extension<dim, n_components>::stencil(const std::size_t node) const
{
  const auto    at     = position(node);
  const double *values = phi.values().data() + node;
  Stencil       result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::ptrdiff_t below = exists(at, d, -1) ? -stride[d] : 0,
                           above = exists(at, d, 1) ? stride[d] : 0;
      const double rise = (values[above] - values[below]) / (below != 0 && above != 0 ? 2 : 1);
      const bool   down = (rise > 0) == (values[0] >= 0);
      const std::ptrdiff_t step = down ? below : above;
      if (step == 0 || rise == 0 || !has_value[node + step])
        continue;
      // D v = (3 v - 4 v_1 + v_2) / 2 where that much is known
      const bool second_order = exists(at, d, down ? -2 : 2) && has_value[node + 2 * step];
      result.differences[result.n++]
        = {std::abs(rise) * (second_order ? 1.5 : 1.), d, step, second_order};
    }
  return result;
}

template <int dim, std::size_t n_components>
typename Extension<dim, n_components>::Stencil
Extension<dim, n_components>::neighbours_with_values(const std::size_t node) const
{
  const auto at = position(node);
  Stencil    result;
  for (unsigned int d = 0; d < dim; ++d)
    for (const int side : {-1, 1})
      if (exists(at, d, side) && has_value[node + side * stride[d]])
        result.differences[result.n++] = {1., d, side * stride[d], false};
  return result;
}

template <int dim, std::size_t n_components>
bool
Extension<dim, n_components>::difference_of_known(const std::size_t node, const unsigned int axis,
                                                  Gradient &result) const
{
  const auto at = position(node);
  const auto known
    = [&](const int k) { return exists(at, axis, k) && has_value[node + k * stride[axis]]; };
  if (!known(1) && !known(-1))
    return false;
  const int side = known(1) ? 1 : -1;
  for (std::size_t c = 0; c < n_components; ++c)
    {
      const auto value = [&](const int k) { return v[c][node + k * stride[axis]]; };
      result[c]        = known(1) && known(-1) ? 0.5 * (value(1) - value(-1))
                         : known(2 * side)
                           ? 0.5 * side * (4 * value(side) - value(2 * side) - 3 * value(0))
                           : side * (value(side) - value(0));
    }
  return true;
}

template <int dim, std::size_t n_components>
typename Extension<dim, n_components>::Gradient
Extension<dim, n_components>::gradient_of_known(const std::size_t  node,
                                                const unsigned int axis) const
{
  Gradient result{};
  if (difference_of_known(node, axis, result))
    return result;
  const Stencil around = neighbours_with_values(node);
  unsigned int  n      = 0;
  for (unsigned int i = 0; i < around.n; ++i)
    {
      Gradient neighbour;
      if (!difference_of_known(node + around.differences[i].step, axis, neighbour))
        continue;
      ++n;
      for (std::size_t c = 0; c < n_components; ++c)
        result[c] += (neighbour[c] - result[c]) / n;
    }
  return result;
}

template <int dim, std::size_t n_components>
std::array<typename Extension<dim, n_components>::Gradient, dim>
Extension<dim, n_components>::gradient_of_known(const std::size_t node) const
{
  std::array<Gradient, dim> result;
  if (fit > 0 && fitted_gradient(node, result))
    return result;
  for (unsigned int axis = 0; axis < dim; ++axis)
    result[axis] = gradient_of_known(node, axis);
  return result;
}

template <int dim, std::size_t n_components>
bool
Extension<dim, n_components>::fitted_gradient(const std::size_t          node,
                                              std::array<Gradient, dim> &result) const
{
  // moments of the known nodes around, in spacings: sums of 1, x, x x^T, v - v(node) and x (v - ..)
  double                                   n = 0;
  Tensor<1, dim>                           sum_x;
  Tensor<2, dim>                           moment;
  Gradient                                 sum_v{};
  std::array<Tensor<1, dim>, n_components> sum_xv{};
  const auto                               at = position(node);
  std::array<int, dim>                     shift;
  shift.fill(-fit);
  while (shift[dim - 1] <= fit)
    {
      std::ptrdiff_t to       = 0;
      bool           is_known = true;
      Tensor<1, dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        {
          to += shift[d] * stride[d];
          x[d] = shift[d];
          is_known &= exists(at, d, shift[d]);
        }
      if (is_known && has_value[node + to])
        {
          n += 1;
          sum_x += x;
          moment += outer_product(x, x);
          for (std::size_t c = 0; c < n_components; ++c)
            {
              const double difference = v[c][node + to] - v[c][node];
              sum_v[c] += difference;
              sum_xv[c] += difference * x;
            }
        }
      for (unsigned int d = 0; ++shift[d] > fit && d + 1 < dim; ++d)
        shift[d] = -fit;
    }
  moment -= outer_product(sum_x, sum_x) / n;
  if (determinant(moment) < 0.1) // the nodes lie in a plane
    return false;
  const Tensor<2, dim> inverse = invert(moment);
  for (std::size_t c = 0; c < n_components; ++c)
    {
      const Tensor<1, dim> gradient = inverse * (sum_xv[c] - sum_v[c] / n * sum_x);
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis][c] = gradient[axis];
    }
  return true;
}

template <int dim, std::size_t n_components>
void
Extension<dim, n_components>::set_gradients_of_known()
{
  constexpr std::uint32_t none = ~std::uint32_t(0);
  gradients_at.assign(has_value.size(), none);
  gradients.resize(dim * nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    gradients_at[nodes[i]] = dim * i;
  for (const std::uint32_t node : nodes)
    {
      const auto at = position(node);
      for (unsigned int d = 0; d < dim; ++d)
        for (const int k : {-2, -1, 1, 2})
          {
            const std::size_t reached = node + k * stride[d];
            if (!exists(at, d, k) || !has_value[reached] || gradients_at[reached] != none)
              continue;
            gradients_at[reached] = gradients.size();
            const auto G          = gradient_of_known(reached);
            gradients.insert(gradients.end(), G.begin(), G.end());
          }
    }
}

template <int dim, std::size_t n_components>
void
Extension<dim, n_components>::set(const std::size_t node, const Stencil &stencil)
{
  double sum = 0;
  for (unsigned int i = 0; i < stencil.n; ++i)
    sum += stencil.differences[i].weight;
  // v = sum_i w_i v_1 / sum_i w_i, or (4 v_1 - v_2)/3 for v_1
  const auto mean = [&](const auto &value) {
    double result = 0;
    for (unsigned int i = 0; i < stencil.n; ++i)
      {
        const Difference &d    = stencil.differences[i];
        const double      near = value(node + d.step);
        result += d.weight * (d.second_order ? (4 * near - value(node + 2 * d.step)) / 3 : near);
      }
    return result / sum;
  };
  for (std::size_t c = 0; c < n_components; ++c)
    v[c][node] = mean([&](const std::size_t i) { return v[c][i]; });
  has_value[node] = 1;
  if (!linear)
    return;
  Gradient *const own = gradients.data() + gradients_at[node];
  for (unsigned int d = 0; d < dim; ++d)
    for (std::size_t c = 0; c < n_components; ++c)
      own[d][c] = mean([&](const std::size_t i) { return gradients[gradients_at[i] + d][c]; });
  // v - G x instead of v: a neighbour one step away in the direction of axis d, side s, counts with
  // v_1 - s G_d, and (4 v_1 - v_2)/3 with -2/3 s G_d.
  for (unsigned int i = 0; i < stencil.n; ++i)
    {
      const Difference &d     = stencil.differences[i];
      const double      shift = (d.step > 0 ? -1 : 1) * (d.second_order ? 2. / 3. : 1.);
      for (std::size_t c = 0; c < n_components; ++c)
        v[c][node] += d.weight / sum * shift * own[d.axis][c];
    }
}

template <int dim, std::size_t n_components>
ExtensionCount
Extension<dim, n_components>::run()
{
  ExtensionCount             count{0, 0};
  std::vector<std::uint32_t> open;
  for (const std::uint32_t node : nodes)
    {
      const Stencil differences = stencil(node);
      if (differences.n > 0)
        set(node, differences);
      else
        open.push_back(node);
      ++count.n_extended;
    }
  count.n_upstream = open.size();
  while (!open.empty())
    {
      std::vector<std::uint32_t> still_open;
      for (const std::uint32_t node : open)
        {
          const Stencil differences = neighbours_with_values(node);
          if (differences.n > 0)
            set(node, differences);
          else
            still_open.push_back(node);
        }
      if (still_open.size() == open.size()) // apart from all known nodes
        break;
      open.swap(still_open);
    }
  count.n_extended -= open.size();
  return count;
}
} // namespace

template <int dim, std::size_t n_components>
ExtensionCount
extend(const Lattice<dim> &phi, const std::vector<char> &known, const ExtensionOptions &options,
       std::array<std::vector<double>, n_components> &v)
{
  return Extension<dim, n_components>(phi, known, options, v).run();
}

#define INSTANTIATE(dim, n)                                                       \
  template ExtensionCount extend(const Lattice<dim> &, const std::vector<char> &, \
                                 const ExtensionOptions &, std::array<std::vector<double>, n> &);

INSTANTIATE(2, 1)
INSTANTIATE(2, 2)
INSTANTIATE(3, 1)
INSTANTIATE(3, 3)
} // namespace scree
