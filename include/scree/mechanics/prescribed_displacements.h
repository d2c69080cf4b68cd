#pragma once

#include <scree/mechanics/answered_increment.h>
#include <scree/mechanics/boundary_term.h>

#include <limits>
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

  void add_internal_forces(const PointEvaluator<dim> &u, const double time,
                           Vector &forces) const override;

  void add_tangent(const PointEvaluator<dim> &u, const double time, Matrix &matrix) const override;

  bool is_symmetric() const override;

  /** sigma n - beta (u - ubar) on the prescribed components, and that of the moments. */
  std::vector<dealii::Tensor<1, dim>> tractions(const unsigned int         region,
                                                const PointEvaluator<dim> &u,
                                                const double               time) const override;

  double energy(const PointEvaluator<dim> &u, const double time) const override;

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
    /** Coefficients of each moment by the unknowns of the cell. */
    std::vector<std::vector<double>> rows;
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
  /** NormalMoments::rows of moment m. */
  std::vector<double> moment_row(const NormalMoments &moments, const unsigned int m) const;
  /** int psi_m n.(ubar - u_n) over the prescribed components. */
  double prescribed_moment(const NormalMoments &moments, const unsigned int m,
                           const double time) const;
  void   add_moments_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const;
  void   add_moment_loads(Vector &loads, const double time) const;
  /** What the moments add to the traction at a point. */
  dealii::Tensor<1, dim> moment_traction(const unsigned int region, const unsigned int q,
                                         const PointEvaluator<dim> &u, const double time) const;

  /** Whether Nitsche's method prescribes it. */
  bool is_nitsche(const BoundaryRegion<dim> &region) const;
  /** Sign of the adjoint term times flow_ratio() in the cell of a point. */
  double adjoint_factor(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point) const;
  /** What is prescribed for component k of the condition at a point, at time `time` [L]. */
  double prescribed_value(const unsigned int region, const unsigned int q, const unsigned int k,
                          const double time) const;

  // Nitsche's method on a moving geometry, prescribed_displacements_increment.cc.
  /** The law's answer at a point. */
  struct PointAnswer
  {
    dealii::Tensor<2, dim> piola;
    dealii::Tensor<4, dim> tangent; //!< dP/dF_D at fixed volume of the cell
    /** Of a projected volume change: dP by the values of the modes, but for psi_m. */
    dealii::Tensor<2, dim> by_volume;
  };
  /** Those to an increment u at all points: once for forces, tractions and tangent. */
  struct Answers : AnsweredIncrement<dim>
  {
    std::vector<std::vector<PointAnswer>> of_points; //!< [region][q]
  };
  /** Those to u, asked for if the last ones were others. */
  const Answers &answers(const PointEvaluator<dim> &u, const bool with_tangents) const;
  void           ask(const unsigned int region) const;
  using VolumeDerivatives = typename Bulk<dim>::VolumeDerivatives;
  /** Sets the derivative of the forces of a point; `volume` of its cell, null: not projected. */
  void set_point_tangent(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                         const PointAnswer &answer, const VolumeDerivatives *volume,
                         dealii::FullMatrix<double> &block) const;
  /** sigma n at a point of a fixed geometry. */
  dealii::Tensor<1, dim> linear_stress_vector(const BoundaryRegion<dim> &region,
                                              const BoundaryPoint<dim>  &point,
                                              const PointEvaluator<dim> &u) const;
  /** sigma n at the points of a region, on a moving geometry P n. */
  std::vector<dealii::Tensor<1, dim>> fluxes(const unsigned int         region,
                                             const PointEvaluator<dim> &u) const;
  void                                find_starts();

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
  mutable Answers                          last;             //!< to the last increment
  /** Formulas are evaluated once per time. */
  struct PrescribedValues
  {
    double                           time = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::vector<double>> of_points; //!< [region], component by component of each point
  };
  mutable PrescribedValues prescribed_values;
};
} // namespace scree
