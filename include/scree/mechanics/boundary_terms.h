#pragma once

#include <scree/mechanics/boundary_regions.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/resultant.h>

#include <vector>

namespace scree
{
/**
 * All boundary conditions that are integrals over a region: tractions, pressures, springs,
 * displacements by Nitsche or penalty, mean supports (method.md section 7). The regions are fixed
 * in the initial configuration; their points are found once.
 */
template <int dim>
class BoundaryTerms
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** @throws UserError if a region selects nothing */
  BoundaryTerms(const Fields<dim> &fields, const LevelSetNodes<dim> &level_set_nodes,
                const CutQuadrature<dim> &quadrature, const std::vector<Body<dim>> &bodies);

  /** Number of multipliers that the mean supports of the bodies need. */
  static unsigned int n_multipliers(const std::vector<Body<dim>> &bodies);

  const std::vector<BoundaryRegion<dim>> &regions() const
  {
    return boundary_regions;
  }

  /** Adds the matrix of springs, Nitsche, penalty and multiplier rows. */
  void add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /**
   * Adds the right-hand side at time `time`: of dead loads (tractions, pressures) if `dead_loads`,
   * of prescribed displacements if `prescribed`.
   */
  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const;

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

  /** Resultant of each region, over all processes; `u` ghosted. */
  std::vector<Resultant<dim>> resultants(const Vector &u, const double time) const;

  /** Energy stored in springs, Nitsche and penalty terms over all processes. */
  double energy(const Vector &u, const double time) const;

  /** beta = factor k^2 (2 mu + lambda)/h of Nitsche and penalty at a point. */
  double beta(const BoundaryRegion<dim> &region, const unsigned int q) const;

private:
  /** sigma(N_a e_i) n for all unknowns of the cell at a point. */
  void stress_vectors(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                      ShapeValues<dim> &shape, std::vector<dealii::Tensor<1, dim>> &vectors) const;
  /** Row `m` of a mean support: coefficients of the cell's unknowns at a point. */
  void   mean_row(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                  const unsigned int m, std::vector<double> &row) const;
  double multiplier_scale(const BoundaryRegion<dim> &region) const;
  /** Squared distance of a point from the axis of the mean rotation: z through the centre. */
  double squared_arm(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point) const;
  /** Adds the force and moment of the multipliers of a mean support. */
  void add_multiplier_resultant(const BoundaryRegion<dim> &region, const Vector &u,
                                Resultant<dim> &resultant) const;

  const Fields<dim>               &fields;
  const std::vector<Body<dim>>    &bodies;
  std::vector<BoundaryRegion<dim>> boundary_regions;
};
} // namespace scree
