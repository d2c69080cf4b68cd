#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/flowing_regions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace scree
{
template <int dim>
unsigned int
BoundaryTerms<dim>::n_multipliers(const std::vector<Body<dim>> &bodies)
{
  unsigned int n = 0;
  for (const auto &body : bodies)
    for (const auto &condition : body.conditions)
      n += condition.n_multipliers();
  return n;
}

template <int dim>
BoundaryTerms<dim>::BoundaryTerms(const DisplacementSpace<dim> &space,
                                  const LevelSetNodes<dim>     &level_set_nodes,
                                  const CutQuadrature<dim>     &quadrature,
                                  const std::vector<Body<dim>> &bodies,
                                  const Kinematics<dim>        &kinematics)
    : space(space)
    , bodies(bodies)
    , boundary_regions(
        find_boundary_regions(space, level_set_nodes, quadrature, bodies, kinematics))
{
  release_edges(space, level_set_nodes, bodies, kinematics, boundary_regions);
  forgive_flow(kinematics, boundary_regions);
  std::map<Imposition, std::vector<unsigned int>> regions_of_terms;
  for (unsigned int r = 0; r < boundary_regions.size(); ++r)
    regions_of_terms[boundary_regions[r].condition->kind().imposition].push_back(r);
  term_of_region.resize(boundary_regions.size());
  for (const auto &[imposition, own_regions] : regions_of_terms)
    {
      terms.push_back(make_boundary_term<dim>(
        imposition, {space, bodies, kinematics, boundary_regions}, own_regions));
      for (const unsigned int r : own_regions)
        term_of_region[r] = terms.back().get();
    }
}

template <int dim>
void
BoundaryTerms<dim>::add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  for (const auto &term : terms)
    term->add_to_matrix(matrix);
}

template <int dim>
void
BoundaryTerms<dim>::add_loads(Vector &loads, const double time, const bool dead_loads,
                              const bool prescribed) const
{
  for (const auto &term : terms)
    term->add_loads(loads, time, dead_loads, prescribed);
}

template <int dim>
void
BoundaryTerms<dim>::add_internal_forces(const PointEvaluator<dim> &u, const double time,
                                        Vector &forces) const
{
  for (const auto &term : terms)
    term->add_internal_forces(u, time, forces);
}

template <int dim>
void
BoundaryTerms<dim>::add_tangent(const PointEvaluator<dim> &u, const double time,
                                dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  for (const auto &term : terms)
    term->add_tangent(u, time, matrix);
}

template <int dim>
std::vector<std::vector<DofIndex>>
BoundaryTerms<dim>::multiplier_couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const auto &term : terms)
    for (const auto &unknowns : term->couplings())
      result.push_back(unknowns);
  return result;
}

template <int dim>
bool
BoundaryTerms<dim>::is_linear() const
{
  return std::all_of(terms.begin(), terms.end(),
                     [](const auto &term) { return term->is_linear(); });
}

template <int dim>
bool
BoundaryTerms<dim>::is_symmetric() const
{
  return std::all_of(terms.begin(), terms.end(),
                     [](const auto &term) { return term->is_symmetric(); });
}

template <int dim>
bool
BoundaryTerms<dim>::has_multipliers() const
{
  return n_multipliers(bodies) > 0;
}

template <int dim>
dealii::Tensor<1, dim>
BoundaryTerms<dim>::displacement_at(const BoundaryRegion<dim> &region, const unsigned int q,
                                    const PointEvaluator<dim> &u) const
{
  return region.points[q].start_displacement + u.value(region.points[q].in_cell());
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
BoundaryTerms<dim>::tractions(const unsigned int region, const PointEvaluator<dim> &u,
                              const double time) const
{
  return term_of_region[region]->tractions(region, u, time);
}

template <int dim>
std::vector<Resultant<dim>>
BoundaryTerms<dim>::resultants(const PointEvaluator<dim> &u, const double time) const
{
  std::vector<Resultant<dim>> result;
  for (unsigned int r = 0; r < boundary_regions.size(); ++r)
    {
      const auto     of_points = tractions(r, u, time);
      Resultant<dim> sum       = term_of_region[r]->resultant_of_multipliers(r, u);
      for (unsigned int q = 0; q < of_points.size(); ++q)
        {
          const auto                  &point = boundary_regions[r].points[q];
          const dealii::Tensor<1, dim> force = point.weight * of_points[q];
          sum.force += force;
          sum.moment += moment_of<dim>(point.position, force);
        }
      result.push_back(sum);
    }
  sum_over_processes(result, space.grid.communicator());
  return result;
}

template <int dim>
double
BoundaryTerms<dim>::energy(const PointEvaluator<dim> &u, const double time) const
{
  double sum = 0.;
  for (const auto &term : terms)
    sum += term->energy(u, time);
  return dealii::Utilities::MPI::sum(sum, space.grid.communicator());
}

template class BoundaryTerms<2>;
template class BoundaryTerms<3>;
} // namespace scree
