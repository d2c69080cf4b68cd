#include <scree/contact/contact_normal.h>
#include <scree/contact/contact_surface.h>
#include <scree/contact/exact_distance.h>
#include <scree/contact/kinked_surface.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
namespace
{
/** grad (phi_a - phi_b) at the nodes of a cell, by cubic interpolation. */
template <int dim>
std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>>
nodal_gradients(const LagrangeBasis<dim> &basis, const GridCell<dim> &cell, const Lattice<dim> &a,
                const Lattice<dim> &b)
{
  std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>> result;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    {
      const dealii::Point<dim> x = cell.lower + cell.size * dealii::Tensor<1, dim>(basis.node(i));
      result[i] = a.value_and_gradient(x, 3).second - b.value_and_gradient(x, 3).second;
    }
  return result;
}
} // namespace

template <int dim>
std::vector<ContactPoint<dim>>
contact_surface(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                const double shift, const ExactDistances<dim> &distances, const bool nodal_normals)
{
  const LagrangeBasis<dim>                   &basis = fields.basis;
  const BackgroundGrid<dim>                  &grid  = fields.grid;
  CutCellRules<dim>                           rules(basis);
  KinkedSurface<dim>                          kinked(distances, bodies, basis);
  std::vector<ContactPoint<dim>>              surface_points;
  std::array<double, max_nodes_per_cell<dim>> phi_a, phi_b, psi, scaled, shape;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const Lattice<dim> &a = bodies[pairs[p].a].level_set;
      const Lattice<dim> &b = bodies[pairs[p].b].level_set;
      for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
        {
          const GridCell<dim> &cell   = grid.cells()[c];
          dealii::Point<dim>   centre = cell.lower;
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] += 0.5 * cell.size;
          const double reach = 0.5 * std::sqrt(double(dim)) * cell.size;
          const double at_a = a.value(centre, 1), at_b = b.value(centre, 1);
          if (std::max(at_a, at_b) > shift + 2. * reach || std::abs(at_a - at_b) > 4. * reach)
            continue;
          if (kinked.concerns(pairs[p], cell))
            {
              const auto points = kinked.points(p, pairs[p], cell, 2. * shift);
              surface_points.insert(surface_points.end(), points.begin(), points.end());
              continue;
            }
          level_set_nodes.cell_values(c, a, phi_a.data());
          level_set_nodes.cell_values(c, b, phi_b.data());
          unsigned int n_negative = 0;
          for (unsigned int i = 0; i < basis.n_nodes; ++i)
            psi[i] = phi_a[i] - phi_b[i];
          level_set_nodes.nudged(psi.data(), cell.size, scaled.data());
          for (unsigned int i = 0; i < basis.n_nodes; ++i)
            n_negative += scaled[i] < 0.;
          if (n_negative == 0 || n_negative == basis.n_nodes)
            continue;
          const double          negligible = 1e-8 * std::pow(cell.size, dim - 1);
          const CellPoints<dim> surface    = rules.rules(scaled.data(), cell.size).surface;
          std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>> gradients;
          if (nodal_normals)
            gradients = nodal_gradients<dim>(basis, cell, a, b);
          for (unsigned int q = 0; q < surface.points.size(); ++q)
            {
              basis.evaluate_values(surface.points[q], shape.data());
              double gap = 0.;
              for (unsigned int i = 0; i < basis.n_nodes; ++i)
                gap += shape[i] * (phi_a[i] + phi_b[i]);
              // A contour through a vertex leaves points of no length in the cells that touch it.
              if (gap > 2. * shift || surface.weights[q] < negligible)
                continue;
              const dealii::Point<dim> x
                = cell.lower + cell.size * dealii::Tensor<1, dim>(surface.points[q]);
              dealii::Tensor<1, dim> normal;
              if (nodal_normals)
                {
                  for (unsigned int i = 0; i < basis.n_nodes; ++i)
                    normal += shape[i] * gradients[i];
                  normal /= normal.norm();
                }
              else
                normal = contact_normal(distances, bodies, pairs[p].a, pairs[p].b, x, cell.size,
                                        surface.normals[q]);
              surface_points.push_back(
                {p, x, normal, surface.weights[q], gap, cell.size, normal, gap});
            }
        }
    }
  return surface_points;
}

#define SCREE_INSTANTIATE(dim)                                                       \
  template std::vector<ContactPoint<dim>> contact_surface(                           \
    const Fields<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &, \
    const std::vector<ContactPair> &, const double, const ExactDistances<dim> &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
