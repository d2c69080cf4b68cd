#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>

namespace scree
{
/** Largest number of nodes of a cell: degree 2. */
template <int dim>
constexpr unsigned int max_nodes_per_cell = dim == 2 ? 9 : 27;

/** Values and derivatives of all basis functions of a cell at one point, in unit coordinates. */
template <int dim>
struct ShapeValues
{
  std::array<double, max_nodes_per_cell<dim>>                          value;
  std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>>          gradient;
  std::array<dealii::SymmetricTensor<2, dim>, max_nodes_per_cell<dim>> hessian;
};

/**
 * Tensor-product Lagrange basis of degree 1 or 2 with equidistant nodes on the unit cell, nodes in
 * lexicographic order (x fastest): the FE_Q basis, evaluated without FEValues.
 */
template <int dim>
class LagrangeBasis
{
public:
  explicit LagrangeBasis(const unsigned int degree)
      : degree(degree)
      , n_1d(degree + 1)
      , n_nodes(dim == 2 ? n_1d * n_1d : n_1d * n_1d * n_1d)
  {
  }

  const unsigned int degree;
  const unsigned int n_1d;
  const unsigned int n_nodes; //!< nodes per cell

  /** Node `i` in unit coordinates. */
  dealii::Point<dim> node(const unsigned int i) const
  {
    dealii::Point<dim> point;
    unsigned int       rest = i;
    for (unsigned int d = 0; d < dim; ++d, rest /= n_1d)
      point[d] = double(rest % n_1d) / degree;
    return point;
  }

  /** The node at vertex `v` of the cell, in deal.II's order. */
  unsigned int vertex(const unsigned int v) const
  {
    unsigned int node = 0, stride = degree;
    for (unsigned int d = 0; d < dim; ++d, stride *= n_1d)
      node += ((v >> d) & 1u) * stride;
    return node;
  }

  /** Values of the factors in one direction, of which the functions are products. */
  std::array<double, 3> values_1d(const double x) const
  {
    double                f[3] = {}, unused[3];
    std::array<double, 3> result;
    evaluate_1d(x, f, unused, unused);
    std::copy(f, f + 3, result.begin());
    return result;
  }

  /** Values only. */
  void evaluate_values(const dealii::Point<dim> &point, double *values) const
  {
    double f[dim][3], unused[3];
    for (unsigned int d = 0; d < dim; ++d)
      evaluate_1d(point[d], f[d], unused, unused);
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        double       product = 1.;
        unsigned int rest    = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= n_1d)
          product *= f[d][rest % n_1d];
        values[i] = product;
      }
  }

  /** Values and gradients. */
  void evaluate_gradients(const dealii::Point<dim> &point, ShapeValues<dim> &shape) const
  {
    double f[2][dim][3], unused[3]; // derivative, direction, node
    for (unsigned int d = 0; d < dim; ++d)
      evaluate_1d(point[d], f[0][d], f[1][d], unused);
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        unsigned int index[dim], rest = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= n_1d)
          index[d] = rest % n_1d;
        const auto product = [&](const int derived) {
          double result = 1.;
          for (int d = 0; d < dim; ++d)
            result *= f[d == derived][d][index[d]];
          return result;
        };
        shape.value[i] = product(-1);
        for (int d = 0; d < dim; ++d)
          shape.gradient[i][d] = product(d);
      }
  }

  /** Values, gradients and second derivatives. */
  void evaluate(const dealii::Point<dim> &point, ShapeValues<dim> &shape) const
  {
    double f[3][dim][3]; // derivative, direction, node
    for (unsigned int d = 0; d < dim; ++d)
      evaluate_1d(point[d], f[0][d], f[1][d], f[2][d]);
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        unsigned int index[dim], rest = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= n_1d)
          index[d] = rest % n_1d;
        const auto product = [&](const int first, const int second) {
          double result = 1.;
          for (int d = 0; d < dim; ++d)
            result *= f[(d == first) + (d == second)][d][index[d]];
          return result;
        };
        shape.value[i] = product(-1, -1);
        for (int d = 0; d < dim; ++d)
          {
            shape.gradient[i][d] = product(d, -1);
            for (int e = 0; e <= d; ++e)
              shape.hessian[i][d][e] = product(d, e);
          }
      }
  }

private:
  void evaluate_1d(const double x, double *f, double *df, double *ddf) const
  {
    if (degree == 1)
      {
        f[0]   = 1. - x;
        f[1]   = x;
        df[0]  = -1.;
        df[1]  = 1.;
        ddf[0] = ddf[1] = 0.;
      }
    else
      {
        f[0]   = (1. - x) * (1. - 2. * x);
        f[1]   = 4. * x * (1. - x);
        f[2]   = x * (2. * x - 1.);
        df[0]  = 4. * x - 3.;
        df[1]  = 4. - 8. * x;
        df[2]  = 4. * x - 1.;
        ddf[0] = ddf[2] = 4.;
        ddf[1]          = -8.;
      }
  }
};
} // namespace scree
