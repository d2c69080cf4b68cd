#include <scree/discretization/own_nodes.h>
#include <scree/mechanics/system_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
namespace
{
template <int dim>
std::size_t
unknowns_of_largest_body(const DisplacementSpace<dim> &space)
{
  std::vector<double> n_unknowns(space.n_bodies(), 0.);
  for_each_own_node(space, [&](const unsigned int a, const unsigned int, const DofIndex) {
    n_unknowns[space.cells()[a].body] += dim;
  });
  dealii::Utilities::MPI::sum(n_unknowns, space.grid.communicator(), n_unknowns);
  return *std::max_element(n_unknowns.begin(), n_unknowns.end());
}
} // namespace

template <int dim>
SystemSolver<dim>::SystemSolver(const LinearSolverParameters &parameters,
                                const DisplacementSpace<dim> &space, Equilibrium<dim> &equilibrium,
                                const std::size_t n_contact_points, Timings &timings)
    : equilibrium(equilibrium)
    , timings(timings)
    , linear_solver(parameters, dim, space.basis.degree)
{
  linear_solver.set_largest_body(unknowns_of_largest_body(space));
  const auto n_all_points
    = dealii::Utilities::MPI::sum(n_contact_points, space.grid.communicator());
  condenses = equilibrium.is_linear_elsewhere()
              && linear_solver.condenses(space.n_dofs(), dim * n_all_points)
              && !equilibrium.has_free_rigid_bodies();
  linear_solver.set_near_null_space(equilibrium.rigid_motions());
  linear_solver.set_border(space.n_trailing());
}

template <int dim>
LinearSolveResult
SystemSolver<dim>::solve(const Vector &r, const double tolerance, const bool may_condense,
                         Vector &du)
{
  // A condensed system holds for one factor of the mass.
  if (may_condense && condenses && !equilibrium.has_inertia()
      && !equilibrium.body_holds().are_any())
    try
      {
        return solve_condensed(r, du);
      }
    catch (const LinearSolverFailure &)
      {
        // The full system tells what is wrong, if anything is.
      }
  const auto *matrix = [&]() {
    const Timings::Scope scope(timings, "tangent");
    return &equilibrium.tangent();
  }();
  return solve(*matrix, r, equilibrium.is_symmetric(), tolerance, du);
}

template <int dim>
LinearSolveResult
SystemSolver<dim>::solve(const typename Equilibrium<dim>::Matrix &A, const Vector &b,
                         const bool is_symmetric, const double tolerance, Vector &x)
{
  const Timings::Scope scope(timings, "linear solver");
  return linear_solver.solve(A, x, b, is_symmetric, tolerance);
}

template <int dim>
LinearSolveResult
SystemSolver<dim>::solve_condensed(const Vector &r, Vector &du)
{
  const Timings::Scope scope(timings, "linear solver");
  if (!condensed_solver)
    {
      const auto system = equilibrium.condensation(false);
      condensed_solver
        = std::make_unique<CondensedSolver>(system.glued, system.jumps, system.symmetric);
    }
  else if (condensed_solver->is_worth_updating())
    condensed_solver->update(equilibrium.condensation(true).glued);
  return condensed_solver->solve(equilibrium.tangent_changes(), dim, du, r);
}

template class SystemSolver<2>;
template class SystemSolver<3>;
} // namespace scree
