#include <scree/contact/surface_fit.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

template <int dim>
SurfaceTangents<dim>
surface_tangents(const Tensor<1, dim> &normal)
{
  SurfaceTangents<dim> result;
  if constexpr (dim == 2)
    {
      result[0][0] = normal[1];
      result[0][1] = -normal[0];
    }
  else
    {
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) < std::abs(normal[smallest]))
          smallest = d;
      result[0] = -normal[smallest] * normal;
      result[0][smallest] += 1.;
      result[0] /= result[0].norm();
      result[1] = cross_product_3d(normal, result[0]);
    }
  return result;
}

template <int dim>
Tensor<1, dim>
surface_normal(const SurfaceTangents<dim> &tangents)
{
  if constexpr (dim == 2)
    return Tensor<1, 2>({-tangents[0][1], tangents[0][0]});
  else
    return cross_product_3d(tangents[0], tangents[1]);
}

template <int dim>
LinearFit<dim>::LinearFit(const std::vector<SurfaceNeighbour<dim>> &neighbours, const double length)
{
  for (const auto &neighbour : neighbours)
    mean += neighbour.weight * neighbour.place;
  SymmetricTensor<2, dim - 1> C;
  for (const auto &neighbour : neighbours)
    {
      const Tensor<1, dim - 1> arm = neighbour.place - mean;
      for (unsigned int k = 0; k < dim - 1; ++k)
        for (unsigned int l = 0; l <= k; ++l)
          C[k][l] += neighbour.weight * arm[k] * arm[l];
    }
  constexpr double smallest_ratio = 1e-4; // about that of the eigenvalues
  is_linear                       = trace(C) > 1e-18 * length * length
              && determinant(C) > smallest_ratio * std::pow(trace(C), dim - 1);
  if (is_linear)
    inverse = invert(C);
}

template <int dim>
InterpolatingFit<dim>::InterpolatingFit(const std::vector<SurfaceNeighbour<dim>> &neighbours,
                                        const double                              length)
    : length(length)
{
  // Polynomials about the nearest point: its large weight meets the constant only.
  const auto nearest
    = std::min_element(neighbours.begin(), neighbours.end(),
                       [](const auto &p, const auto &q) { return p.square < q.square; });
  origin = nearest->place;
  Tensor<1, dim - 1> mean;
  Matrix             moments{};
  for (const auto &neighbour : neighbours)
    {
      const Terms terms = monomials(neighbour.place);
      for (unsigned int i = 0; i < n_terms; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          moments[i][j] += neighbour.weight * terms[i] * terms[j];
      mean += neighbour.weight * neighbour.place;
    }
  is_outside = std::all_of(neighbours.begin(), neighbours.end(),
                           [&](const auto &n) { return n.place * mean > 0.; });
  // Outside of its neighbours a polynomial of degree 2 means nothing.
  solve(moments, is_outside ? n_linear : n_terms);
}

template <int dim>
void
InterpolatingFit<dim>::solve(const Matrix &moments, const unsigned int largest_size)
{
  constexpr double smallest_pivot = 1e-5;
  Matrix           L{};
  Terms            scale;
  unsigned int     size = 0; // of the largest complete degree
  for (unsigned int i = 0; i < largest_size; ++i)
    {
      scale[i]     = moments[i][i] > 0. ? 1. / std::sqrt(moments[i][i]) : 0.;
      double pivot = moments[i][i] * scale[i] * scale[i];
      for (unsigned int j = 0; j < i; ++j)
        {
          double sum = moments[i][j] * scale[i] * scale[j];
          for (unsigned int k = 0; k < j; ++k)
            sum -= L[i][k] * L[j][k];
          L[i][j] = sum / L[j][j];
          pivot -= L[i][j] * L[i][j];
        }
      if (!(pivot > smallest_pivot))
        break;
      L[i][i] = std::sqrt(pivot);
      if (i + 1 == 1 || i + 1 == n_linear || i + 1 == n_terms)
        size = i + 1;
    }
  Terms       y{};
  const Terms right_side = monomials(Tensor<1, dim - 1>());
  for (unsigned int i = 0; i < size; ++i)
    {
      y[i] = right_side[i] * scale[i];
      for (unsigned int k = 0; k < i; ++k)
        y[i] -= L[i][k] * y[k];
      y[i] /= L[i][i];
    }
  coefficients.fill(0.);
  for (unsigned int i = size; i-- > 0;)
    {
      for (unsigned int k = i + 1; k < size; ++k)
        y[i] -= L[k][i] * y[k];
      y[i] /= L[i][i];
      coefficients[i] = y[i] * scale[i];
    }
}

#define SCREE_INSTANTIATE(dim)                                                     \
  template SurfaceTangents<dim> surface_tangents<dim>(const Tensor<1, dim> &);     \
  template Tensor<1, dim>       surface_normal<dim>(const SurfaceTangents<dim> &); \
  template class LinearFit<dim>;                                                   \
  template class InterpolatingFit<dim>;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
