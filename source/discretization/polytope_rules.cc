#include <scree/discretization/polytope_rules.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
using dealii::Point;
using dealii::Tensor;

/** Appends the points of a rule of the unit simplex of `rule_dim` on one with these vertices. */
template <int dim, int rule_dim>
void
append_mapped(const dealii::Quadrature<rule_dim> &rule, const std::vector<Point<dim>> &vertices,
              const double jacobian, CellPoints<dim> &result)
{
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      Point<dim> x = vertices[0];
      for (unsigned int d = 0; d < rule_dim; ++d)
        x += rule.point(q)[d] * (vertices[d + 1] - vertices[0]);
      result.points.push_back(x);
      result.weights.push_back(rule.weight(q) * jacobian);
    }
}

/** Length of the edge of a segment, twice the area of a triangle. */
template <int dim>
double
facet_jacobian(const std::vector<Point<dim>> &vertices)
{
  if constexpr (dim == 2)
    return vertices[0].distance(vertices[1]);
  else
    return cross_product_3d(vertices[1] - vertices[0], vertices[2] - vertices[0]).norm();
}

/** Appends a Gauss rule on a facet of a 3D cell that is a rectangle; else nothing. */
template <int dim>
bool
append_on_rectangle([[maybe_unused]] const Facet<dim> &facet, [[maybe_unused]] const unsigned int n,
                    [[maybe_unused]] const double area, [[maybe_unused]] CellPoints<dim> &result)
{
  if constexpr (dim == 3)
    {
      const auto &v = facet.vertices;
      if (v.size() != 4)
        return false;
      const Tensor<1, dim> s = v[1] - v[0], t = v[3] - v[0];
      if ((v[0] + s + t).distance(v[2]) > 1e-14 || std::abs(s * t) > 1e-14)
        return false;
      const dealii::QGauss<2> gauss(n);
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          result.points.push_back(v[0] + gauss.point(q)[0] * s + gauss.point(q)[1] * t);
          result.weights.push_back(gauss.weight(q) * s.norm() * t.norm() * area);
        }
      return true;
    }
  return false;
}

/** Rules are expensive to make. */
template <int rule_dim>
const dealii::Quadrature<rule_dim> &
simplex_rule(const unsigned int n)
{
  static const std::vector<dealii::Quadrature<rule_dim>> rules = []() {
    std::vector<dealii::Quadrature<rule_dim>> result(1);
    for (unsigned int i = 1; i <= 4; ++i)
      if constexpr (rule_dim == 1)
        result.push_back(dealii::QGauss<1>(i));
      else
        result.push_back(dealii::QWitherdenVincentSimplex<rule_dim>(i));
    return result;
  }();
  return rules.at(n);
}
} // namespace

template <int dim>
void
append_rule(const Polytope<dim> &part, const unsigned int n, const double cell_size,
            CellPoints<dim> &result)
{
  const double volume = std::pow(cell_size, dim);
  if (const auto box = part.as_box())
    {
      const dealii::QGauss<dim> gauss(n);
      const Tensor<1, dim>      edges    = box->second - box->first;
      double                    jacobian = volume;
      for (unsigned int d = 0; d < dim; ++d)
        jacobian *= edges[d];
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          Point<dim> x = box->first;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += gauss.point(q)[d] * edges[d];
          result.points.push_back(x);
          result.weights.push_back(gauss.weight(q) * jacobian);
        }
      return;
    }
  const auto &rule = simplex_rule<dim>(n);
  for (const auto &simplex : part.simplices())
    {
      Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = simplex[d + 1] - simplex[0];
      append_mapped<dim, dim>(rule, simplex, std::abs(determinant(edges)) * volume, result);
    }
}

template <int dim>
void
append_rule(const Facet<dim> &facet, const Tensor<1, dim> &normal, const unsigned int n,
            const double cell_size, CellPoints<dim> &result)
{
  const unsigned int n_facet = dim == 2 ? n : std::max(n, std::min(4u, (3 * n - 1) / 2));
  if (append_on_rectangle(facet, n_facet, std::pow(cell_size, dim - 1), result))
    {
      result.normals.resize(result.points.size(), normal);
      return;
    }
  const auto &rule = simplex_rule<dim - 1>(n_facet);
  for (const auto &simplex : simplices_of(facet))
    {
      const double jacobian = facet_jacobian<dim>(simplex) * std::pow(cell_size, dim - 1);
      if (jacobian > 0.)
        append_mapped<dim, dim - 1>(rule, simplex, jacobian, result);
    }
  result.normals.resize(result.points.size(), normal);
}

#define SCREE_INSTANTIATE(dim)                                                       \
  template void append_rule(const Polytope<dim> &, const unsigned int, const double, \
                            CellPoints<dim> &);                                      \
  template void append_rule(const Facet<dim> &, const dealii::Tensor<1, dim> &,      \
                            const unsigned int, const double, CellPoints<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
