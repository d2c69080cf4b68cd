#pragma once

#include <scree/mechanics/incremental_bulk.h>
#include <scree/mechanics/kinematics.h>
#include <scree/mechanics/step_start.h>

namespace scree
{
/**
 * u is the increment since the start of a step, u_n = x - X and the histories of the material come
 * from material points (StepStart, BulkQuadrature): any law in increments, pressures follow the
 * surface. The grid stays, so that the motion of box faces and vertices normal to it is none.
 */
template <int dim>
class IncrementalKinematics : public Kinematics<dim>
{
public:
  using typename Kinematics<dim>::Vector;

  /**
   * Collective.
   *
   * @param start  of the step: u_n
   * @param points where the laws are asked, with the histories
   */
  IncrementalKinematics(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                        const std::vector<Body<dim>>              &bodies,
                        const SmallCutTreatment<dim>              &small_cuts,
                        std::unique_ptr<const StepStart<dim>>      start,
                        std::unique_ptr<const BulkQuadrature<dim>> points, const double start_time);

  const Bulk<dim> &bulk() const override;

  std::unique_ptr<BoundaryTerm<dim>>
  prescribed_displacements(const BoundarySetting<dim>      &setting,
                           const std::vector<unsigned int> &own_regions) const override;

  bool follows_surface(const BoundaryCondition<dim> &condition) const override;

  const Shape<dim> *exact_shape(const Body<dim> &body) const override;

  /** What is prescribed now less what was at the start of the step. */
  double prescribed(const BoundaryCondition<dim> &condition, const PrescribedUnknown<dim> &unknown,
                    const double time) const override;

  bool rotations_are_finite() const override;

  const Vector &start_displacement() const override;

  PointEvaluator<dim> start_displacement_field() const override;

  dealii::Point<dim> reference_position(const PointInCell<dim> &point) const override;

  SurfaceHistory<dim> surface_history(const PointInCell<dim>       &point,
                                      const dealii::Tensor<1, dim> &normal) const override;

  bool moves_bodies() const override;

  double position_scale() const override;

  /** Only those of the present stress: others balance moments where the forces were at another
   * time. */
  bool balances_moments(const Body<dim> &body) const override;

  /** Points are where they were at the start of the step. */
  double arm_error(const double largest_displacement) const override;

  /** By the extended increments of the last step. */
  /** The material points. */
  MassPoints<dim> mass_points() const override;

  Vector extrapolated(const State<dim> &state, const double time) const override;

  MaterialPoints<dim> moved(const MaterialPoints<dim> &before,
                            const PointEvaluator<dim> &u) const override;

  MovingLeastSquaresReport transfer_report() const override;

private:
  const DisplacementSpace<dim>                    &space;
  const std::unique_ptr<const StepStart<dim>>      start;
  const std::unique_ptr<const BulkQuadrature<dim>> points;
  IncrementalBulk<dim>                             incremental_bulk;
};
} // namespace scree
