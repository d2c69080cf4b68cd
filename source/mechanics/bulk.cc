#include <scree/base/exceptions.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/cut_cell_rule.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace scree
{
namespace
{
/** Cells that flow keep this part of the stiffness of small cuts, for the condition number. */
constexpr double smallest_ratio = 1e-3;

std::vector<bool>
positive(const std::vector<double> &shares)
{
  std::vector<bool> result;
  result.reserve(shares.size());
  for (const double share : shares)
    result.push_back(share > 0.);
  return result;
}
} // namespace

template <int dim>
Bulk<dim>::Bulk(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts,
                const std::vector<double> &projected_shares)
    : space(space)
    , quadrature(quadrature)
    , bodies(bodies)
    , projected_shares(projected_shares)
    , divergence(space, quadrature, positive(projected_shares))
    , secant_ratios(space.cells().size(), 1.)
    , small_cuts(small_cuts)
{
}

template <int dim>
CellRule<dim>
Bulk<dim>::rule(const unsigned int active_cell) const
{
  return cut_cell_rule(space, quadrature, active_cell);
}

template <int dim>
void
Bulk<dim>::add_to_matrix(Matrix &matrix) const
{
  small_cuts.add_to_matrix(cut_stiffness(), matrix);
}

template <int dim>
void
Bulk<dim>::add_internal_forces(const PointEvaluator<dim> &, Vector &) const
{
}

template <int dim>
void
Bulk<dim>::add_tangent(const PointEvaluator<dim> &, Matrix &) const
{
}

template <int dim>
std::vector<StressIntegral<dim>>
Bulk<dim>::stress_integrals(const PointEvaluator<dim> &u) const
{
  std::vector<StressIntegral<dim>> result(bodies.size());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim>  points = rule(a);
      StressIntegral<dim> &sum    = result[space.cells()[a].body];
      for (unsigned int q = 0; q < points.n_points; ++q)
        {
          const double          volume = points.weights[q] * points.weight_scale;
          const BulkSample<dim> value  = sample(a, points.points[q], u);
          sum.volume += volume;
          sum.moved_volume += volume * (1. + trace(value.strain));
          sum.stress += volume * value.stress;
        }
    }
  return result;
}

template <int dim>
void
Bulk<dim>::set_reference_volumes(const unsigned int active_cell, std::vector<double> &volumes) const
{
  const CellRule<dim> points = rule(active_cell);
  volumes.resize(points.n_points);
  for (unsigned int q = 0; q < points.n_points; ++q)
    volumes[q] = points.weights[q] * points.weight_scale;
}

template <int dim>
dealii::Tensor<1, dim>
Bulk<dim>::body_force(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                      const double time) const
{
  const auto                  &body     = bodies[space.cells()[active_cell].body];
  const auto                  &force    = body.body_force;
  const dealii::Point<dim>     position = space.position(active_cell, unit_point);
  const dealii::Tensor<1, dim> b        = force.vector(position, time);
  if (!std::isfinite(b.norm_square()))
    {
      std::ostringstream where;
      where << position << ", t = " << time;
      throw UserError(body.path + "/Body force",
                      "'" + force.text() + "' is no finite number at the point " + where.str(),
                      "check divisions, roots and logarithms");
    }
  return b;
}

template <int dim>
template <typename F>
void
Bulk<dim>::for_each_volume(const unsigned int active_cell, const F &f) const
{
  const CellRule<dim> points = rule(active_cell);
  std::vector<double> reference_volumes;
  set_reference_volumes(active_cell, reference_volumes);
  double volume = 0., reference_volume = 0.;
  for (unsigned int q = 0; q < points.n_points; ++q)
    {
      f(points.points[q], reference_volumes[q]);
      volume += points.weights[q] * points.weight_scale;
      reference_volume += reference_volumes[q];
    }
  const auto &surface = quadrature.surface;
  for (unsigned int q = surface.begin[active_cell];
       q < surface.begin[active_cell + 1] && volume > 0.; ++q)
    if (const double width = quadrature.strip_widths[q]; width != 0.)
      f(surface.points[q] + 0.5 * width / space.cell_size(active_cell) * surface.normals[q],
        width * surface.weights[q] * reference_volume / volume);
}

template <int dim>
template <typename Acts, typename F>
void
Bulk<dim>::add_volume_forces(const Acts &acts, const F &b, Vector &loads) const
{
  const unsigned int     n = space.basis.n_nodes;
  std::vector<double>    shape(n);
  dealii::Vector<double> cell_load(n * dim);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      if (!acts(bodies[space.cells()[a].body]))
        continue;
      cell_load = 0.;
      for_each_volume(a, [&](const dealii::Point<dim> &unit_point, const double volume) {
        const dealii::Tensor<1, dim> force = volume * b(a, unit_point);
        space.basis.evaluate_values(unit_point, shape.data());
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            cell_load(i * dim + d) += shape[i] * force[d];
      });
      space.hanging_constraints().distribute_local_to_global(
        cell_load, unknowns_of_nodes<dim>(space.nodes(a), n), loads);
    }
}

template <int dim>
void
Bulk<dim>::add_body_forces(Vector &loads, const double time) const
{
  add_volume_forces(
    [](const Body<dim> &body) { return body.body_force.text() != (dim == 2 ? "0; 0" : "0; 0; 0"); },
    [&](const unsigned int a, const dealii::Point<dim> &unit_point) {
      return body_force(a, unit_point, time);
    },
    loads);
}

template <int dim>
void
Bulk<dim>::add_weight(Vector &loads, const double time) const
{
  std::vector<dealii::Tensor<1, dim>> weights;
  for (const auto &body : bodies)
    weights.push_back(body.weight(time));
  add_volume_forces(
    [&](const Body<dim> &body) { return weights[&body - bodies.data()].norm() > 0.; },
    [&](const unsigned int a, const dealii::Point<dim> &) {
      return weights[space.cells()[a].body];
    },
    loads);
}

template <int dim>
MassPoints<dim>
Bulk<dim>::mass_points() const
{
  MassPoints<dim> result;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for_each_volume(a, [&](const dealii::Point<dim> &unit_point, const double volume) {
      result.places.push_back({a, unit_point});
      result.positions.push_back(space.position(a, unit_point));
      result.masses.push_back(volume * bodies[space.cells()[a].body].density);
    });
  return result;
}

template <int dim>
std::vector<std::vector<DofIndex>>
Bulk<dim>::couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    result.emplace_back(space.nodes(a), space.nodes(a) + space.basis.n_nodes);
  for (const auto &nodes : small_cuts.couplings())
    result.push_back(nodes);
  return result;
}

template <int dim>
CutStiffness
Bulk<dim>::cut_stiffness() const
{
  CutStiffness result;
  for (const auto &body : bodies)
    {
      const double mu     = body.is_rigid() ? 0. : body.material->shear_modulus();
      const double lambda = body.is_rigid() ? 0. : body.material->lame_lambda();
      result.of_bodies.push_back(2. * mu + std::min(lambda, IsotropicModuli::largest_ratio * mu));
    }
  for (const double secant : secant_ratios)
    result.ratios.push_back(std::max(smallest_ratio, secant * secant));
  return result;
}

template <int dim>
void
Bulk<dim>::add_start_forces(const PointEvaluator<dim> &start, Vector &forces) const
{
  small_cuts.add_start_forces(cut_stiffness(), start, forces);
}

template <int dim>
double
Bulk<dim>::energy_of_small_cuts(const PointEvaluator<dim> &start,
                                const PointEvaluator<dim> &u) const
{
  return dealii::Utilities::MPI::sum(small_cuts.energy(cut_stiffness(), start, u),
                                     space.grid.communicator());
}

template <int dim>
std::vector<double>
Bulk<dim>::volumes() const
{
  std::vector<double> volume(bodies.size(), 0.);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const CellRule<dim> points = Bulk<dim>::rule(a);
      for (unsigned int q = 0; q < points.n_points; ++q)
        volume[space.cells()[a].body] += points.weights[q] * points.weight_scale;
    }
  dealii::Utilities::MPI::sum(volume, space.grid.communicator(), volume);
  return volume;
}

template <int dim>
void
Bulk<dim>::add_lumped_volumes(Vector &volumes, const std::vector<double> &factor_of_body) const
{
  const unsigned int     n = space.basis.n_nodes;
  dealii::Vector<double> lumped(n * dim);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const double factor = factor_of_body[space.cells()[a].body];
      if (factor == 0.)
        continue;
      // Equal shares: those of the basis functions are not all positive for degree 2.
      const CellRule<dim> points = rule(a);
      double              volume = 0.;
      for (unsigned int q = 0; q < points.n_points; ++q)
        volume += points.weights[q] * points.weight_scale;
      lumped = factor * volume / n;
      space.hanging_constraints().distribute_local_to_global(
        lumped, unknowns_of_nodes<dim>(space.nodes(a), n), volumes);
    }
}

template <int dim>
double
Bulk<dim>::projected_lambda(const unsigned int body) const
{
  const auto &material = *bodies[body].material;
  return std::min(std::max(0., material.lame_lambda()),
                  projected_shares[body]
                    * (material.lame_lambda() + 2. * material.shear_modulus() / dim));
}

template <int dim>
typename Bulk<dim>::Vector
Bulk<dim>::nodal_secant_ratios() const
{
  Vector smallest(space.owned(), space.grid.communicator());
  for (const DofIndex i : space.owned())
    smallest(i) = 1.;
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      if (const DofIndex node = space.nodes(a)[i]; space.owned().is_element(node))
        smallest(node) = std::min<double>(smallest(node), secant_ratios[a]);
  smallest.compress(dealii::VectorOperation::insert);
  return smallest;
}

template class Bulk<2>;
template class Bulk<3>;
} // namespace scree
