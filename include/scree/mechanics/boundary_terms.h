#pragma once

#include <scree/mechanics/boundary_regions.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/resultant.h>

#include <vector>

namespace scree
{
/**
 * All boundary conditions that are integrals over a region: tractions, pressures, springs,
 * displacements by Nitsche or penalty, mean supports (theory.md section 7).
 *
 * On a fixed geometry all of them are linear in u. On a moving one u is the increment since the
 * start of the step, conditions act on u_n + u; tractions are forces per reference area, pressures
 * follow the surface, -p J_D F_D^{-T} n, and Nitsche's condition takes the stress vector P(F_D) n;
 * its adjoint term has the elastic moduli at zero strain.
 */
template <int dim>
class BoundaryTerms
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * @param bulk       of these bodies: stresses see its projected volume changes
   * @param start_time of the step, on a moving geometry
   * @throws UserError if a region selects nothing
   */
  BoundaryTerms(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies,
                const Bulk<dim> &bulk, const double start_time = 0.);

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

  /** Adds what is not linear on a moving geometry, at the ghosted increment u and time `time`. */
  void add_internal_forces(const Vector &u, const double time, Vector &forces) const;

  /** Adds its derivative. */
  void add_tangent(const Vector &u, const double time,
                   dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** Nodes that couple through multiplier rows, as unknowns. */
  std::vector<std::vector<DofIndex>> multiplier_couplings() const;

  /** Whether the matrix stays symmetric and positive definite. */
  bool is_symmetric() const;
  bool has_multipliers() const;

  /**
   * Traction of the condition on the body at point `q` of a region for ghosted u: the load; -k u of
   * springs; sigma n - beta (u - ubar) on prescribed components. Mean supports: zero.
   */
  dealii::Tensor<1, dim> traction(const BoundaryRegion<dim> &region, const unsigned int q,
                                  const Vector &u, const double time) const;

  /** Displacement since the beginning, u_n + u, at point `q` of a region; u ghosted. */
  dealii::Tensor<1, dim> displacement_at(const BoundaryRegion<dim> &region, const unsigned int q,
                                         const Vector &u) const;

  /** Resultant of each region, over all processes; `u` ghosted. */
  std::vector<Resultant<dim>> resultants(const Vector &u, const double time) const;

  /** Energy stored in springs, Nitsche and penalty terms over all processes. */
  double energy(const Vector &u, const double time) const;

  /**
   * beta = factor k^2 (2 mu + lambda)/h of penalty at a point; of Nitsche with rho (2 mu +
   * min(lambda, 4 mu)), rho the secant ratio of plastic flow, at least 0.1. The rest of 2 mu +
   * lambda acts on the moments of the normal displacement over the cell, as its pressure does: held
   * point by point, a curved surface would lock what keeps its volume.
   */
  double beta(const BoundaryRegion<dim> &region, const unsigned int q) const;

private:
  // Moments of the normal displacement, boundary_moments.cc.
  struct NormalMoments
  {
    unsigned int     region, begin, end; //!< points of one cell
    double           stiffness;
    VolumeModes<dim> modes;
  };
  /**
   * Nitsche's method does not hold cells that flow (plastic strain beyond the elastic) on the outer
   * edge of a region: the kink at its edge is not in a cell's polynomial, so that each cell is held
   * as a whole, and the region would be wider by half a cell on average.
   */
  void release_edges(const LevelSetNodes<dim> &level_set_nodes);
  /** Of Nitsche's moduli in a cell that flows. */
  double flow_ratio(const unsigned int active_cell) const;
  /** Share of beta that acts at points. */
  double pointwise_share(const BoundaryRegion<dim> &region, const unsigned int q) const;
  /**
   * Where the material flows, Nitsche's method holds the motion in the step: of the difference
   * u_n - ubar_n at its start the secant ratio is left. It is small beside the plastic strain times
   * h, but beta times it is not small beside the yield stress.
   */
  void forgive_flow(const double start_time);
  void find_moments();
  /** Coefficients of moment m by the unknowns of the cell. */
  std::vector<double> moment_row(const NormalMoments &moments, const unsigned int m) const;
  /** int psi_m n.(ubar - u_n) over the prescribed components. */
  double prescribed_moment(const NormalMoments &moments, const unsigned int m,
                           const double time) const;
  void   add_moments_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;
  void   add_moment_loads(Vector &loads, const double time) const;
  /** What the moments add to the traction at a point. */
  dealii::Tensor<1, dim> moment_traction(const BoundaryRegion<dim> &region, const unsigned int q,
                                         const Vector &u, const double time) const;

  /** Whether a displacement is prescribed by Nitsche's method. */
  bool is_nitsche(const BoundaryRegion<dim> &region) const;
  /** Whether the condition has a term that is not linear. */
  bool is_nonlinear(const BoundaryRegion<dim> &region) const;
  /** The law's answer to the increment u at a point, F_D and unit gradients; boundary_increment.cc.
   */
  struct PointIncrement;
  PointIncrement increment_at(const unsigned int region, const unsigned int q, const Vector &u,
                              const bool with_tangent) const;
  /** P n. */
  dealii::Tensor<1, dim> stress_vector(const BoundaryRegion<dim> &region, const unsigned int q,
                                       const Vector &u) const;
  /** The part of a pressure that follows the surface, J_D F_D^{-T} n. */
  dealii::Tensor<1, dim> turned_normal(const BoundaryRegion<dim> &region, const unsigned int q,
                                       const Vector &u) const;
  void                   find_starts();

  /** sigma(N_a e_i) n for all unknowns of the cell at a point. */
  void stress_vectors(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                      ShapeValues<dim> &shape, std::vector<dealii::Tensor<1, dim>> &vectors) const;
  /** Row `m` of a mean support: coefficients of the cell's unknowns at a point. */
  void   mean_row(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                  const unsigned int m, std::vector<double> &row) const;
  double multiplier_scale(const BoundaryRegion<dim> &region) const;
  /** Adds the force and moment of the multipliers of a mean support on the process that has them.
   */
  void add_multiplier_resultant(const BoundaryRegion<dim> &region, const Vector &u,
                                Resultant<dim> &resultant) const;

  const Fields<dim>                       &fields;
  const std::vector<Body<dim>>            &bodies;
  std::vector<BoundaryRegion<dim>>         boundary_regions;
  const Bulk<dim>                         &bulk;
  const StepStart<dim>                    *start;
  std::vector<std::vector<IncrementStart>> starts; //!< of the points of nonlinear regions
  std::vector<NormalMoments>               normal_moments;
  std::vector<std::vector<int>>            moments_of_point; //!< [region][q], -1: none
};
} // namespace scree
