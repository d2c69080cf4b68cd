#pragma once

#include <scree/mechanics/boundary_term.h>

#include <vector>

namespace scree
{
/**
 * Displacements prescribed by Nitsche's method or by a penalty (theory.md section 7). On a moving
 * geometry Nitsche's condition takes the stress vector P(F_D) n; its adjoint term has the elastic
 * moduli at zero strain.
 */
template <int dim>
class PrescribedDisplacements : public BoundaryTerm<dim>
{
public:
  using typename BoundaryTerm<dim>::Vector;
  using typename BoundaryTerm<dim>::Matrix;

  PrescribedDisplacements(const BoundarySetting<dim>      &setting,
                          const std::vector<unsigned int> &own_regions);

  void add_to_matrix(Matrix &matrix) const override;

  void add_loads(Vector &loads, const double time, const bool dead_loads,
                 const bool prescribed) const override;

  void add_internal_forces(const Vector &u, const double time, Vector &forces) const override;

  void add_tangent(const Vector &u, const double time, Matrix &matrix) const override;

  bool is_symmetric() const override;

  /** sigma n - beta (u - ubar) on the prescribed components, and that of the moments. */
  std::vector<dealii::Tensor<1, dim>> tractions(const unsigned int region, const Vector &u,
                                                const double time) const override;

  double energy(const Vector &u, const double time) const override;

private:
  /**
   * beta = factor k^2 (2 mu + lambda)/h of penalty at a point; of Nitsche with rho (2 mu +
   * min(lambda, 4 mu)), rho the secant ratio of plastic flow, at least 0.1. The rest of 2 mu +
   * lambda acts on the moments of the normal displacement over the cell, as its pressure does: held
   * point by point, a curved surface would lock what keeps its volume.
   */
  double beta(const BoundaryRegion<dim> &region, const unsigned int q) const;

  // Moments of the normal displacement, prescribed_displacements_moments.cc.
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
  void release_edges();
  /** Of Nitsche's moduli in a cell that flows. */
  double flow_ratio(const unsigned int active_cell) const;
  /** Share of beta that acts at points. */
  double pointwise_share(const BoundaryRegion<dim> &region, const unsigned int q) const;
  /**
   * Where the material flows, Nitsche's method holds the motion in the step: of the difference
   * u_n - ubar_n at its start the secant ratio is left. It is small beside the plastic strain times
   * h, but beta times it is not small beside the yield stress.
   */
  void forgive_flow();
  void find_moments();
  /** Coefficients of moment m by the unknowns of the cell. */
  std::vector<double> moment_row(const NormalMoments &moments, const unsigned int m) const;
  /** int psi_m n.(ubar - u_n) over the prescribed components. */
  double prescribed_moment(const NormalMoments &moments, const unsigned int m,
                           const double time) const;
  void   add_moments_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;
  void   add_moment_loads(Vector &loads, const double time) const;
  /** What the moments add to the traction at a point. */
  dealii::Tensor<1, dim> moment_traction(const unsigned int region, const unsigned int q,
                                         const Vector &u, const double time) const;

  /** Whether Nitsche's method prescribes it. */
  bool is_nitsche(const BoundaryRegion<dim> &region) const;
  /** Sign of the adjoint term times flow_ratio() in the cell of a point. */
  double adjoint_factor(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point) const;
  /** The law's answer to the increment u at a point, F_D and unit gradients;
   * prescribed_displacements_increment.cc. */
  struct PointIncrement;
  PointIncrement increment_at(const unsigned int region, const unsigned int q, const Vector &u,
                              const bool with_tangent) const;
  /** sigma n at a point, on a moving geometry P n. */
  dealii::Tensor<1, dim> stress_vector(const unsigned int region, const unsigned int q,
                                       const Vector &u) const;
  void                   find_starts();

  /** sigma(N_a e_i) n for all unknowns of the cell at a point. */
  void stress_vectors(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                      ShapeValues<dim> &shape, std::vector<dealii::Tensor<1, dim>> &vectors) const;

  using BoundaryTerm<dim>::fields;
  using BoundaryTerm<dim>::own_regions;
  using BoundaryTerm<dim>::setting;
  const std::vector<Body<dim>>            &bodies;
  const Bulk<dim>                         &bulk;
  const StepStart<dim>                    *start;
  std::vector<std::vector<IncrementStart>> starts; //!< [region][q], of Nitsche's method
  std::vector<NormalMoments>               normal_moments;
  std::vector<std::vector<int>>            moments_of_point; //!< [region][q], -1: none
};
} // namespace scree
