#pragma once

#include <scree/mechanics/boundary_term.h>

#include <vector>

namespace scree
{
/**
 * All boundary conditions that are integrals over a region: the sum of a BoundaryTerm for each way
 * in which conditions enter the equations (theory.md section 7). They act on the displacement
 * u_n + u since the start of the run.
 */
template <int dim>
class BoundaryTerms
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * @param kinematics of these bodies: stresses are those of its bulk
   * @throws UserError if a region selects nothing
   */
  BoundaryTerms(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies,
                const Kinematics<dim> &kinematics);

  BoundaryTerms(const BoundaryTerms &)            = delete; // terms refer to the regions
  BoundaryTerms &operator=(const BoundaryTerms &) = delete;

  /** Number of multipliers that the mean supports of the bodies need. */
  static unsigned int n_multipliers(const std::vector<Body<dim>> &bodies);

  const std::vector<BoundaryRegion<dim>> &regions() const
  {
    return boundary_regions;
  }

  /** Adds the matrix of what is linear: springs, Nitsche, penalty and multiplier rows. */
  void add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /**
   * Adds the right-hand side at time `time`: of dead loads (tractions, pressures) if `dead_loads`,
   * of prescribed displacements if `prescribed`.
   */
  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const;

  /** Adds what is not linear, at u and time `time`. */
  void add_internal_forces(const PointEvaluator<dim> &u, const double time, Vector &forces) const;

  /** Adds its derivative. */
  void add_tangent(const PointEvaluator<dim> &u, const double time,
                   dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** Nodes that couple through multiplier rows, as unknowns. */
  std::vector<std::vector<DofIndex>> multiplier_couplings() const;

  /** Whether the matrix has all of it. */
  bool is_linear() const;

  /** Whether the matrix stays symmetric and positive definite. */
  bool is_symmetric() const;
  bool has_multipliers() const;

  /**
   * Tractions of the condition on the body at the points of regions()[region] for u: the
   * load; -k u of springs; sigma n - beta (u - ubar) on prescribed components. Mean supports: zero.
   */
  std::vector<dealii::Tensor<1, dim>>
  tractions(const unsigned int region, const PointEvaluator<dim> &u, const double time) const;

  /** Displacement since the beginning, u_n + u, at point `q` of a region. */
  dealii::Tensor<1, dim> displacement_at(const BoundaryRegion<dim> &region, const unsigned int q,
                                         const PointEvaluator<dim> &u) const;

  /** Resultant of each region, over all processes. */
  std::vector<Resultant<dim>> resultants(const PointEvaluator<dim> &u, const double time) const;

  /** Energy stored in springs, Nitsche and penalty terms over all processes. */
  double energy(const PointEvaluator<dim> &u, const double time) const;

private:
  const DisplacementSpace<dim>                   &space;
  const std::vector<Body<dim>>                   &bodies;
  std::vector<BoundaryRegion<dim>>                boundary_regions;
  std::vector<std::unique_ptr<BoundaryTerm<dim>>> terms;
  std::vector<const BoundaryTerm<dim> *>          term_of_region;
};
} // namespace scree
