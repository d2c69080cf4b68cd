#include <scree/level_set/map_velocity.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
template <int dim>
using Vector = std::array<double, dim>;

// Cubic Lagrange weights for the nodes 0, ..., 3, linear extrapolation beyond them.
std::array<double, 4>
weights_at(const double t)
{
  if (t < 0)
    return {{1 - t, t, 0, 0}};
  if (t > 3)
    return {{0, 0, 3 - t, t - 2}};
  const double a = t, b = t - 1, c = t - 2, d = t - 3;
  return {{-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6}};
}

template <int dim>
struct Field
{
  const std::array<int, dim>                 &n_nodes;
  const std::array<std::vector<double>, dim> &values;
  std::array<std::size_t, dim>                stride;

  // All components at `x`, in spacings from the first node.
  Vector<dim> operator()(const Vector<dim> &x) const;

  // (I + tau grad du)^{-1} at a node, by central differences, one-sided at the ends.
  std::array<Vector<dim>, dim> inverse_jacobian(const std::array<int, dim> &node,
                                                double                      tau_over_h) const;
};

template <int dim>
Vector<dim>
Field<dim>::operator()(const Vector<dim> &x) const
{
  std::array<std::array<double, 4>, dim> w;
  std::size_t                            first = 0;
  for (int d = 0; d < dim; ++d)
    {
      const double last = n_nodes[d] - 4;
      const double base = std::clamp(std::floor(x[d]) - 1, 0., last);
      w[d]              = weights_at(x[d] - base);
      first += static_cast<std::size_t>(base) * stride[d];
    }
  Vector<dim> result{};
  for (int k = 0; k < (dim == 3 ? 4 : 1); ++k)
    for (int j = 0; j < 4; ++j)
      {
        const double      wjk = w[1][j] * (dim == 3 ? w[dim - 1][k] : 1.);
        const std::size_t row = first + j * stride[1] + (dim == 3 ? k * stride[dim - 1] : 0);
        for (int c = 0; c < dim; ++c)
          {
            const double *f = values[c].data() + row;
            result[c] += wjk * (w[0][0] * f[0] + w[0][1] * f[1] + w[0][2] * f[2] + w[0][3] * f[3]);
          }
      }
  return result;
}

template <int dim>
std::array<Vector<dim>, dim>
Field<dim>::inverse_jacobian(const std::array<int, dim> &node, const double tau_over_h) const
{
  std::size_t at = 0;
  for (int d = 0; d < dim; ++d)
    at += node[d] * stride[d];
  std::array<Vector<dim>, dim> J, inverse;
  for (int d = 0; d < dim; ++d)
    {
      const std::size_t below = node[d] > 0 ? stride[d] : 0,
                        above = node[d] + 1 < n_nodes[d] ? stride[d] : 0;
      const double scale      = tau_over_h / (below != 0 && above != 0 ? 2 : 1);
      for (int c = 0; c < dim; ++c)
        J[c][d] = (c == d ? 1. : 0.) + scale * (values[c][at + above] - values[c][at - below]);
    }
  if constexpr (dim == 2)
    {
      inverse[0][0] = J[1][1];
      inverse[0][1] = -J[0][1];
      inverse[1][0] = -J[1][0];
      inverse[1][1] = J[0][0];
    }
  else
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
          inverse[i][j] = J[a][c] * J[b][d] - J[a][d] * J[b][c];
        }
  double determinant = 0;
  for (int d = 0; d < dim; ++d)
    determinant += J[0][d] * inverse[d][0];
  for (auto &line : inverse)
    for (double &entry : line)
      entry /= determinant;
  return inverse;
}

// Solves w = du(x - tau w) at a node; true if converged.
template <int dim>
bool
solve_at(const Field<dim> &du, const std::array<int, dim> &node, const double tau_over_h,
         const double tolerance, Vector<dim> &w)
{
  const auto inverse = du.inverse_jacobian(node, tau_over_h);
  for (unsigned int iteration = 0; iteration < 30; ++iteration)
    {
      Vector<dim> X;
      for (int d = 0; d < dim; ++d)
        X[d] = node[d] - tau_over_h * w[d];
      const Vector<dim> target = du(X);
      double            norm   = 0;
      for (int d = 0; d < dim; ++d)
        norm = std::max(norm, std::abs(w[d] - target[d]));
      if (norm < tolerance)
        return true;
      Vector<dim> next = w;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          next[i] -= inverse[i][j] * (w[j] - target[j]);
      if (!std::all_of(next.begin(), next.end(), [](const double c) { return std::isfinite(c); }))
        return false;
      w = next;
    }
  return false;
}
} // namespace

template <int dim>
std::size_t
map_velocity(const std::array<int, dim> &n_nodes, const double spacing,
             const std::array<std::vector<double>, dim> &du, const double tau,
             std::array<std::vector<double>, dim> &velocity)
{
  Field<dim> field{n_nodes, du, {}};
  field.stride[0] = 1;
  for (int d = 1; d < dim; ++d)
    field.stride[d] = field.stride[d - 1] * n_nodes[d - 1];

  std::size_t          n_unconverged = 0;
  std::array<int, dim> node{};
  for (std::size_t at = 0; at < du[0].size(); ++at)
    {
      Vector<dim> w;
      for (int d = 0; d < dim; ++d)
        w[d] = velocity[d][at];
      if (!solve_at<dim>(field, node, tau / spacing, 1e-10 * spacing, w))
        ++n_unconverged;
      for (int d = 0; d < dim; ++d)
        velocity[d][at] = w[d];
      for (int d = 0; d < dim && ++node[d] == n_nodes[d]; ++d)
        node[d] = 0;
    }
  return n_unconverged;
}

template std::size_t map_velocity<2>(const std::array<int, 2> &, double,
                                     const std::array<std::vector<double>, 2> &, double,
                                     std::array<std::vector<double>, 2> &);
template std::size_t map_velocity<3>(const std::array<int, 3> &, double,
                                     const std::array<std::vector<double>, 3> &, double,
                                     std::array<std::vector<double>, 3> &);
} // namespace scree
