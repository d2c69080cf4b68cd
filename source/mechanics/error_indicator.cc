#include <scree/mechanics/error_indicator.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace scree
{
using namespace dealii;

namespace
{
/** Of the higher terms of a fit, relative to the number of points: keeps thin patches solvable. */
constexpr double regularisation = 1e-8;

/** Number of polynomials of degree k in dim variables; 10 at most. */
template <int dim>
unsigned int
n_monomials(const unsigned int k)
{
  return k == 1 ? dim + 1 : (dim + 1) * (dim + 2) / 2;
}

/** 1, y_i, y_i y_j (i <= j). */
template <int dim>
std::array<double, 10>
monomials(const Tensor<1, dim> &y, const unsigned int k)
{
  std::array<double, 10> values = {{1.}};
  for (unsigned int d = 0; d < dim; ++d)
    values[1 + d] = y[d];
  unsigned int m = dim + 1;
  if (k > 1)
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        values[m++] = y[i] * y[j];
  return values;
}

/** Strain recovery of all bodies on the cells of this process. */
template <int dim>
class Recovery
{
public:
  using Strain = SymmetricTensor<2, dim>;

  Recovery(const DisplacementSpace<dim> &space, const Bulk<dim> &bulk, const PointEvaluator<dim> &u)
      : space(space)
      , k(space.basis.degree)
  {
    find_patches();
    fit(bulk, u);
  }

  /** e* at a point of an owned active cell. */
  Strain strain(const unsigned int active_cell, const Point<dim> &unit_point) const
  {
    const Point<dim> point = space.position(active_cell, unit_point);
    Strain           sum;
    double           sum_of_weights = 0.;
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        const Patch &patch  = patches[patch_of_node.at(vertex_node(active_cell, v))];
        double       weight = patch.trust;
        for (unsigned int d = 0; d < dim; ++d)
          weight *= (v >> d) & 1u ? unit_point[d] : 1. - unit_point[d];
        const auto values = monomials<dim>((point - patch.centre) / patch.size, k);
        for (unsigned int m = 0; m < n_monomials<dim>(k); ++m)
          sum += weight * values[m] * patch.coefficients[m];
        sum_of_weights += weight;
      }
    return sum / sum_of_weights;
  }

private:
  static constexpr unsigned int n_vertices = 1u << dim;

  /** The cells of a body around a vertex and the polynomial fitted there. */
  struct Patch
  {
    Point<dim>                centre;
    double                    size  = 0.; //!< of its largest cell
    double                    trust = 0.; //!< 1 with 2^dim cells, small with fewer
    std::vector<unsigned int> cells;
    std::vector<Strain>       coefficients;
  };

  DofIndex vertex_node(const unsigned int active_cell, const unsigned int vertex) const
  {
    return space.nodes(active_cell)[space.basis.vertex(vertex)];
  }

  void find_patches()
  {
    for (unsigned int a = 0; a < space.cells().size(); ++a)
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const DofIndex node  = vertex_node(a, v);
          const auto     found = patch_of_node.find(node);
          if (a >= space.n_owned_cells() && found == patch_of_node.end())
            continue; // no owned cell needs it
          const unsigned int index = found == patch_of_node.end() ? patches.size() : found->second;
          if (index == patches.size())
            {
              patch_of_node[node] = index;
              patches.emplace_back();
              Point<dim> corner;
              for (unsigned int d = 0; d < dim; ++d)
                corner[d] = (v >> d) & 1u;
              patches.back().centre = space.position(a, corner);
            }
          const double size   = space.cell_size(a);
          patches[index].size = std::max(patches[index].size, size);
          patches[index].cells.push_back(a);
        }
  }

  void fit(const Bulk<dim> &bulk, const PointEvaluator<dim> &u)
  {
    const QGauss<dim>   gauss(k);
    const unsigned int  n_points = gauss.size(), n = n_monomials<dim>(k);
    std::vector<Strain> strains;
    for (unsigned int a = 0; a < space.cells().size(); ++a)
      for (const Point<dim> &point : gauss.get_points())
        strains.push_back(bulk.sample(a, point, u).strain);

    FullMatrix<double>  matrix(n, n);
    std::vector<Strain> right_side(n);
    for (Patch &patch : patches)
      {
        matrix = 0.;
        right_side.assign(n, Strain());
        for (const unsigned int a : patch.cells)
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const auto values = monomials<dim>(
                (space.position(a, gauss.point(q)) - patch.centre) / patch.size, k);
              for (unsigned int i = 0; i < n; ++i)
                {
                  right_side[i] += values[i] * strains[a * n_points + q];
                  for (unsigned int j = 0; j < n; ++j)
                    matrix(i, j) += values[i] * values[j];
                }
            }
        for (unsigned int i = 1; i < n; ++i)
          matrix(i, i) += regularisation * matrix(0, 0);
        matrix.gauss_jordan();
        patch.coefficients.assign(n, Strain());
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            patch.coefficients[i] += matrix(i, j) * right_side[j];
        patch.trust = std::pow(std::min(1., double(patch.cells.size()) / n_vertices), 4);
      }
  }

  const DisplacementSpace<dim>              &space;
  const unsigned int                         k;
  std::unordered_map<DofIndex, unsigned int> patch_of_node;
  std::vector<Patch>                         patches;
};
} // namespace

template <int dim>
std::vector<double>
recovery_errors(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                const std::vector<Body<dim>> &bodies, const Bulk<dim> &bulk,
                const TrilinosWrappers::MPI::Vector &ghosted)
{
  const PointEvaluator<dim> u(space, ghosted);
  const Recovery<dim>       recovery(space, bulk, u);
  std::vector<double>       errors(space.grid.n_owned_cells(), 0.);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      double            sum  = 0.;
      const auto        add  = [&](const Point<dim> &point, const double weight) {
        const auto difference = recovery.strain(a, point) - bulk.sample(a, point, u).strain;
        sum += weight * (bodies[cell.body].material->stress(difference) * difference);
      };
      if (cell.is_cut)
        for (unsigned int q = quadrature.bulk.begin[a]; q < quadrature.bulk.begin[a + 1]; ++q)
          add(quadrature.bulk.points[q], quadrature.bulk.weights[q]);
      else
        for (unsigned int q = 0; q < quadrature.whole_cell.points.size(); ++q)
          add(quadrature.whole_cell.points[q],
              quadrature.whole_cell.weights[q]
                * std::pow(space.grid.cells()[cell.grid_cell].size, dim));
      errors[cell.grid_cell] += sum;
    }
  return errors;
}

std::vector<bool>
largest_share(const std::vector<double> &values, const double share, const MPI_Comm communicator)
{
  std::vector<double> all;
  for (const auto &of_rank : Utilities::MPI::all_gather(communicator, values))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  std::sort(all.begin(), all.end(), std::greater<>());
  const double wanted = share * std::accumulate(all.begin(), all.end(), 0.);
  double       sum = 0., limit = std::numeric_limits<double>::max();
  for (auto value = all.begin(); value != all.end() && sum < wanted; ++value)
    {
      sum += *value;
      limit = (1. - 1e-6) * *value;
    }
  std::vector<bool> marked(values.size());
  for (unsigned int i = 0; i < values.size(); ++i)
    marked[i] = values[i] > 0. && values[i] >= limit;
  return marked;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template std::vector<double> recovery_errors(                                                 \
    const DisplacementSpace<dim> &, const CutQuadrature<dim> &, const std::vector<Body<dim>> &, \
    const Bulk<dim> &, const TrilinosWrappers::MPI::Vector &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
