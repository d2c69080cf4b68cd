#include <scree/level_set/lattice.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
// The Lagrange polynomials on the nodes 0, ..., n - 1 and their derivatives at one coordinate.
template <int n>
struct LagrangeWeights
{
  double value[n], first[n], second[n];
};

template <int n>
LagrangeWeights<n>
lagrange_weights(const double t)
{
  if constexpr (n == 2)
    return {{1 - t, t}, {-1, 1}, {0, 0}};
  else if constexpr (n == 3)
    return {{0.5 * (t - 1) * (t - 2), t * (2 - t), 0.5 * t * (t - 1)},
            {t - 1.5, 2 - 2 * t, t - 0.5},
            {1, -2, 1}};
  else
    {
      const double a = t, b = t - 1, c = t - 2, d = t - 3;
      return {{-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6},
              {-(b * c + b * d + c * d) / 6, (a * c + a * d + c * d) / 2,
               -(a * b + a * d + b * d) / 2, (a * b + a * c + b * c) / 6},
              {2 - t, 3 * t - 5, 4 - 3 * t, t - 1}};
    }
}

// Where a point lies: the nearest point of the box, and the interpolation cell with its weights.
template <int dim, int n>
struct Cell
{
  Cell(const Lattice<dim> &lattice, const Point<dim> &x);

  Cell(const Cell &) = delete; // `values` may point into it

  const double      *values; // at the first node
  std::size_t        stride[dim];
  LagrangeWeights<n> weights[dim];
  Tensor<1, dim>     outside; // from the nearest point of the box to x

private:
  void take_from_tiles(const Lattice<dim> &lattice, const std::array<int, dim> &first);

  std::array<double, dim == 2 ? n * n : n * n * n> gathered; // from several tiles
};

template <int dim, int n>
Cell<dim, n>::Cell(const Lattice<dim> &lattice, const Point<dim> &x)
{
  const double         spacing = lattice.spacing();
  std::array<int, dim> first;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int    lower = lattice.lower()[d], last = lower + lattice.n_nodes()[d] - 1;
      const double s       = (x[d] - lattice.frame().origin[d]) / spacing;
      const double clamped = std::clamp(s, double(lower), double(last));
      outside[d]           = (s - clamped) * spacing;
      int base             = static_cast<int>(std::floor(clamped));
      if constexpr (n == 3)
        base -= base & 1;
      if constexpr (n == 4)
        base -= 1;
      base       = std::clamp(base, lower, last - (n - 1));
      weights[d] = lagrange_weights<n>(clamped - base);
      first[d]   = base - lower;
    }
  if (lattice.is_tiled())
    {
      take_from_tiles(lattice, first);
      return;
    }
  std::size_t position = 0, step = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = step;
      position += step * first[d];
      step *= lattice.n_nodes()[d];
    }
  values = lattice.values().data() + position;
}

template <int dim, int n>
void
Cell<dim, n>::take_from_tiles(const Lattice<dim> &lattice, const std::array<int, dim> &first)
{
  using Storage              = Tiles<dim>;
  const Storage    &tiles    = lattice.tiles();
  const std::size_t position = tiles.position(first);
  bool              in_one   = position != Storage::absent;
  for (unsigned int d = 0; d < dim; ++d)
    in_one &= first[d] % Storage::edge + n <= Storage::edge;
  std::size_t step = 1;
  for (unsigned int d = 0; d < dim; ++d, step *= in_one ? Storage::edge : n)
    stride[d] = step;
  if (in_one)
    {
      values = lattice.values().data() + position;
      return;
    }
  values                    = gathered.data();
  std::array<int, dim> node = lattice.lower();
  for (unsigned int d = 0; d < dim; ++d)
    node[d] += first[d];
  const std::array<int, dim> start = node;
  for (double &value : gathered)
    {
      value = lattice(node);
      for (unsigned int d = 0; d < dim && ++node[d] == start[d] + n && d + 1 < dim; ++d)
        node[d] = start[d];
    }
}

template <int dim, int n>
double
interpolate(const Lattice<dim> &lattice, const Point<dim> &x)
{
  const Cell<dim, n> cell(lattice, x);
  double             sum = 0;
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    {
      double plane = 0;
      for (int j = 0; j < n; ++j)
        {
          const double *row = cell.values + j * cell.stride[1];
          if constexpr (dim == 3)
            row += k * cell.stride[2];
          double line = 0;
          for (int i = 0; i < n; ++i)
            line += cell.weights[0].value[i] * row[i];
          plane += cell.weights[1].value[j] * line;
        }
      sum += (dim == 3 ? cell.weights[dim - 1].value[k] : 1.) * plane;
    }
  return sum + cell.outside.norm();
}

/** Adds the distance to the nodes, along `outside`, to what is known at their edge. */
template <int dim>
void
add_distance(const Tensor<1, dim> &outside, LevelSetExpansion<dim> &result)
{
  const double distance = outside.norm();
  if (distance == 0.)
    return;
  result.value += distance;
  for (unsigned int d = 0; d < dim; ++d)
    if (outside[d] != 0)
      {
        result.gradient[d] = outside[d] / distance;
        for (unsigned int e = 0; e < dim; ++e)
          result.hessian[d][e] = 0;
      }
}

// The sums over the rows of a cell: the derivatives of order i in x, j in y (and k in z).
template <int dim, int n>
LevelSetExpansion<dim>
interpolate_expansion(const Lattice<dim> &lattice, const Point<dim> &x)
{
  const Cell<dim, n> cell(lattice, x);
  double f = 0, fx = 0, fy = 0, fz = 0, fxx = 0, fyy = 0, fzz = 0, fxy = 0, fxz = 0, fyz = 0;
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    {
      double p = 0, px = 0, py = 0, pxx = 0, pyy = 0, pxy = 0;
      for (int j = 0; j < n; ++j)
        {
          const double *row = cell.values + j * cell.stride[1];
          if constexpr (dim == 3)
            row += k * cell.stride[2];
          double l = 0, lx = 0, lxx = 0;
          for (int i = 0; i < n; ++i)
            {
              l += cell.weights[0].value[i] * row[i];
              lx += cell.weights[0].first[i] * row[i];
              lxx += cell.weights[0].second[i] * row[i];
            }
          const LagrangeWeights<n> &w = cell.weights[1];
          p += w.value[j] * l;
          px += w.value[j] * lx;
          pxx += w.value[j] * lxx;
          py += w.first[j] * l;
          pxy += w.first[j] * lx;
          pyy += w.second[j] * l;
        }
      const double w = dim == 3 ? cell.weights[dim - 1].value[k] : 1.;
      f += w * p;
      fx += w * px;
      fy += w * py;
      fxx += w * pxx;
      fxy += w * pxy;
      fyy += w * pyy;
      if constexpr (dim == 3)
        {
          const double w1 = cell.weights[2].first[k];
          fz += w1 * p;
          fxz += w1 * px;
          fyz += w1 * py;
          fzz += cell.weights[2].second[k] * p;
        }
    }

  const double           h = lattice.spacing();
  LevelSetExpansion<dim> result;
  result.value         = f;
  result.gradient[0]   = fx / h;
  result.gradient[1]   = fy / h;
  result.hessian[0][0] = fxx / (h * h);
  result.hessian[0][1] = fxy / (h * h);
  result.hessian[1][1] = fyy / (h * h);
  if constexpr (dim == 3)
    {
      result.gradient[2]   = fz / h;
      result.hessian[0][2] = fxz / (h * h);
      result.hessian[1][2] = fyz / (h * h);
      result.hessian[2][2] = fzz / (h * h);
    }
  add_distance(cell.outside, result);
  return result;
}
} // namespace

template <int dim>
bool
is_number_of_nodes(std::size_t n, const std::array<int, dim> &n_nodes, const int fewest)
{
  for (const int nodes : n_nodes)
    {
      if (nodes < fewest || n % nodes != 0)
        return false;
      n /= nodes;
    }
  return n == 1;
}

template <int dim>
Lattice<dim>::Lattice(const LatticeFrame<dim> &frame, const Index &lower, const Index &n_nodes)
    : lattice_frame(frame)
    , lower_node(lower)
    , node_count(n_nodes)
{
  Assert(frame.spacing > 0, ExcMessage("The spacing of a lattice must be positive."));
  std::size_t n_values = 1;
  Index       last;
  for (unsigned int d = 0; d < dim; ++d)
    {
      Assert(n_nodes[d] >= 4, ExcMessage("A lattice needs 4 nodes per direction."));
      n_values *= n_nodes[d];
      last[d] = lower[d] + n_nodes[d] - 1;
    }
  node_values.assign(n_values, std::numeric_limits<double>::quiet_NaN());
  node_box = BoundingBox<dim>(std::make_pair(node(lower), node(last)));
}

template <int dim>
Lattice<dim>::Lattice(const LatticeFrame<dim> &frame, const Index &lower, const Index &n_nodes,
                      const std::function<double(const Point<dim> &)> &function)
    : lattice_frame(frame)
    , lower_node(lower)
    , node_count(n_nodes)
    , node_tiles(n_nodes)
    , function(function)
{
  Index last;
  for (unsigned int d = 0; d < dim; ++d)
    {
      Assert(n_nodes[d] >= 4, ExcMessage("A lattice needs 4 nodes per direction."));
      last[d] = lower[d] + n_nodes[d] - 1;
    }
  node_box = BoundingBox<dim>(std::make_pair(node(lower), node(last)));
}

template <int dim>
std::size_t
Lattice<dim>::store(const Index &index) const
{
  Index at = index;
  for (unsigned int d = 0; d < dim; ++d)
    at[d] -= lower_node[d];
  const std::size_t first = node_tiles.store(at);
  for (std::size_t i = first; i < first + Tiles<dim>::n_nodes; ++i)
    {
      Index other = node_tiles.node(i);
      for (unsigned int d = 0; d < dim; ++d)
        other[d] += lower_node[d];
      node_values.push_back(function(node(other)));
    }
  return node_tiles.position(at);
}

template <int dim>
double
Lattice<dim>::asked_value(const Index &index) const
{
  Index at = index;
  for (unsigned int d = 0; d < dim; ++d)
    at[d] -= lower_node[d];
  return node_tiles.ask(at) ? node_values[store(index)] : function(node(index));
}

template <int dim>
double
Lattice<dim>::passing_value(const Index &index) const
{
  const std::size_t position = offset(index);
  return position == Tiles<dim>::absent ? function(node(index)) : node_values[position];
}

template <int dim>
const LatticeFrame<dim> &
Lattice<dim>::frame() const
{
  return lattice_frame;
}

template <int dim>
double
Lattice<dim>::spacing() const
{
  return lattice_frame.spacing;
}

template <int dim>
const typename Lattice<dim>::Index &
Lattice<dim>::lower() const
{
  return lower_node;
}

template <int dim>
const typename Lattice<dim>::Index &
Lattice<dim>::n_nodes() const
{
  return node_count;
}

template <int dim>
const BoundingBox<dim> &
Lattice<dim>::box() const
{
  return node_box;
}

template <int dim>
Point<dim>
Lattice<dim>::node(const Index &index) const
{
  Point<dim> result = lattice_frame.origin;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] += lattice_frame.spacing * index[d];
  return result;
}

template <int dim>
typename Lattice<dim>::Index
Lattice<dim>::index(std::size_t offset) const
{
  AssertIndexRange(offset, node_values.size());
  Index result;
  if (is_tiled())
    {
      result = node_tiles.node(offset);
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += lower_node[d];
      return result;
    }
  for (unsigned int d = 0; d < dim; ++d)
    {
      result[d] = lower_node[d] + static_cast<int>(offset % node_count[d]);
      offset /= node_count[d];
    }
  return result;
}

template <int dim>
std::vector<double> &
Lattice<dim>::values()
{
  return node_values;
}

template <int dim>
const std::vector<double> &
Lattice<dim>::values() const
{
  return node_values;
}

template <int dim>
const Tiles<dim> &
Lattice<dim>::tiles() const
{
  return node_tiles;
}

template <int dim>
double
Lattice<dim>::nodal_value(const Point<dim> &x) const
{
  Index          nearest;
  Tensor<1, dim> outside;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double s = (x[d] - lattice_frame.origin[d]) / lattice_frame.spacing;
      Assert(std::abs(s - std::round(s)) < 1e-6, ExcMessage("The point is not a lattice node."));
      const int node = static_cast<int>(std::lround(s));
      nearest[d]     = std::clamp(node, lower_node[d], lower_node[d] + node_count[d] - 1);
      outside[d]     = (node - nearest[d]) * lattice_frame.spacing;
    }
  return (*this)(nearest) + outside.norm();
}

template <int dim>
double
Lattice<dim>::value(const Point<dim> &x, const unsigned int degree) const
{
  switch (degree)
    {
    case 1:
      return interpolate<dim, 2>(*this, x);
    case 2:
      return interpolate<dim, 3>(*this, x);
    default:
      Assert(degree == 3, ExcMessage("Lattices interpolate with degree 1, 2 or 3."));
      return interpolate<dim, 4>(*this, x);
    }
}

template <int dim>
std::pair<double, Tensor<1, dim>>
Lattice<dim>::value_and_gradient(const Point<dim> &x, const unsigned int degree) const
{
  const LevelSetExpansion<dim> result = expansion(x, degree);
  return {result.value, result.gradient};
}

template <int dim>
LevelSetExpansion<dim>
Lattice<dim>::expansion(const Point<dim> &x, const unsigned int degree) const
{
  switch (degree)
    {
    case 1:
      return interpolate_expansion<dim, 2>(*this, x);
    case 2:
      return interpolate_expansion<dim, 3>(*this, x);
    default:
      Assert(degree == 3, ExcMessage("Lattices interpolate with degree 1, 2 or 3."));
      return interpolate_expansion<dim, 4>(*this, x);
    }
}

template bool is_number_of_nodes<2>(std::size_t, const std::array<int, 2> &, const int);
template bool is_number_of_nodes<3>(std::size_t, const std::array<int, 3> &, const int);
template class Lattice<2>;
template class Lattice<3>;
} // namespace scree
