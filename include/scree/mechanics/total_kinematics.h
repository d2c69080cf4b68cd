#pragma once

#include <scree/mechanics/kinematics.h>
#include <scree/mechanics/linear_bulk.h>

namespace scree
{
/**
 * u is the displacement since the start of the run, the geometry is that of the start: linear
 * elasticity at small strain. All but contact and rigid bodies is linear in u.
 */
template <int dim>
class TotalKinematics : public Kinematics<dim>
{
public:
  using typename Kinematics<dim>::Vector;

  TotalKinematics(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                  const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts);

  const Bulk<dim> &bulk() const override;

  std::unique_ptr<BoundaryTerm<dim>>
  prescribed_displacements(const BoundarySetting<dim>      &setting,
                           const std::vector<unsigned int> &own_regions) const override;

  /** False: pressures are dead loads. */
  bool follows_surface(const BoundaryCondition<dim> &condition) const override;

  const Shape<dim> *exact_shape(const Body<dim> &body) const override;

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

  bool balances_moments(const Body<dim> &body) const override;

  double arm_error(const double largest_displacement) const override;

  /** At the points of the cut quadrature, and of the strip between the cut and the boundary. */
  MassPoints<dim> mass_points() const override;

  Vector extrapolated(const State<dim> &state, const double time) const override;

  /** There are none; points that are given stay. */
  MaterialPoints<dim> moved(const MaterialPoints<dim> &points,
                            const PointEvaluator<dim> &u) const override;

  MovingLeastSquaresReport transfer_report() const override;

private:
  const DisplacementSpace<dim> &space;
  LinearBulk<dim>               linear_bulk;
  Vector                        zero;
};
} // namespace scree
