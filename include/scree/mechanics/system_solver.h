#pragma once

#include <scree/base/timings.h>
#include <scree/mechanics/equilibrium.h>
#include <scree/solver/condensed_solver.h>
#include <scree/solver/linear_solver.h>

#include <memory>

namespace scree
{
/**
 * Solves the linear systems of an Equilibrium: condensed to the contact points where nothing else
 * changes the tangent and that pays, else the whole system.
 */
template <int dim>
class SystemSolver
{
public:
  using Vector = typename Equilibrium<dim>::Vector;

  /** @param n_contact_points of this process */
  SystemSolver(const LinearSolverParameters &parameters, const DisplacementSpace<dim> &space,
               Equilibrium<dim> &equilibrium, const std::size_t n_contact_points, Timings &timings);

  /**
   * Solves K du = r to |r - K du| <= tolerance |r| or better, K at the last residual()
   * (collective).
   *
   * @param may_condense whether contact alone changes K, and what holds bodies: no artificial mass
   *                     above the default one, no second attempt
   * @throws LinearSolverFailure if K is singular or an iteration does not converge
   */
  LinearSolveResult solve(const Vector &r, const double tolerance, const bool may_condense,
                          Vector &du);

  /** Solves A x = b, A with the unknowns of K. */
  LinearSolveResult solve(const typename Equilibrium<dim>::Matrix &A, const Vector &b,
                          const bool is_symmetric, const double tolerance, Vector &x);

private:
  LinearSolveResult solve_condensed(const Vector &r, Vector &du);

  Equilibrium<dim>                &equilibrium;
  Timings                         &timings;
  LinearSolver                     linear_solver;
  bool                             condenses; //!< few contact points, and nothing else changes K
  std::unique_ptr<CondensedSolver> condensed_solver; //!< made when first needed
};
} // namespace scree
