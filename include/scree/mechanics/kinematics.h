#pragma once

#include <scree/mechanics/mass_points.h>
#include <scree/points/material_points.h>
#include <scree/points/moving_least_squares.h>
#include <scree/state/state.h>

#include <memory>
#include <vector>

namespace scree
{
template <int dim>
struct BoundarySetting;
template <int dim>
class BoundaryTerm;
template <int dim>
class Bulk;
template <int dim>
struct PrescribedUnknown;

/** What a point of the surface of the equations did since the start of the run. */
template <int dim>
struct SurfaceHistory
{
  dealii::Tensor<1, dim> displacement;    //!< u_n [L]
  double                 area_ratio = 1.; //!< of reference area to area at the start of the step
};

/**
 * What the unknown u of deformable bodies means: the displacement since the start of the run is
 * u_n + u, the equations are integrals over the bodies displaced by u_n. Chosen once, where the
 * discrete problem is made; nothing else asks which one is in use. Rigid bodies keep their whole
 * motion as the unknown.
 *
 *     TotalKinematics         u_n = 0, small strain, linear
 *     IncrementalKinematics   u_n of the step, laws in increments of the deformation gradient
 */
template <int dim>
class Kinematics
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** @param start_time when u is zero [time] */
  explicit Kinematics(const double start_time);
  virtual ~Kinematics() = default;

  double start_time() const
  {
    return time_of_start;
  }

  // What enters the equations.

  virtual const Bulk<dim> &bulk() const = 0;

  /** Displacements prescribed by Nitsche's method, with the stresses of that bulk, or a penalty. */
  virtual std::unique_ptr<BoundaryTerm<dim>>
  prescribed_displacements(const BoundarySetting<dim>      &setting,
                           const std::vector<unsigned int> &own_regions) const = 0;

  /** Whether a condition's tractions depend on F_D = I + grad u, so that it is no dead load. */
  virtual bool follows_surface(const BoundaryCondition<dim> &condition) const = 0;

  /** The body's shape where that is its boundary, so that loads act there; else null. */
  virtual const Shape<dim> *exact_shape(const Body<dim> &body) const = 0;

  /**
   * The value of an unknown that a condition prescribes at `time` [L].
   *
   * @throws UserError for motions that are not possible
   */
  virtual double prescribed(const BoundaryCondition<dim> &condition,
                            const PrescribedUnknown<dim> &unknown, const double time) const = 0;

  /** Whether free bodies turn finitely, so that u is no linear function of their rotations. */
  virtual bool rotations_are_finite() const = 0;

  // Where bodies were and are.

  /** u_n at the owned unknowns [L]. */
  virtual const Vector &start_displacement() const = 0;

  /** The same at points [L]. */
  virtual PointEvaluator<dim> start_displacement_field() const = 0;

  /** X = x - u_n of a point of a body: formulas are functions of X. */
  virtual dealii::Point<dim> reference_position(const PointInCell<dim> &point) const = 0;

  /** @param normal out of the body */
  virtual SurfaceHistory<dim> surface_history(const PointInCell<dim>       &point,
                                              const dealii::Tensor<1, dim> &normal) const = 0;

  /** Whether bodies are drawn where u brings them and every step has its own equations. */
  virtual bool moves_bodies() const = 0;

  // What an increment leaves inexact.

  /** Size of the positions of which displacements are differences [L]; 0: they are none. */
  virtual double position_scale() const = 0;

  /** Whether the law of a body balances moments. */
  virtual bool balances_moments(const Body<dim> &body) const = 0;

  /** How far forces may act from where they are in balance, by a displacement of that size [L]. */
  virtual double arm_error(const double largest_displacement) const = 0;

  /** Where the mass of deformable bodies is. */
  virtual MassPoints<dim> mass_points() const = 0;

  // From step to step.

  /** u at `time` if it goes on as in the last step. */
  virtual Vector extrapolated(const State<dim> &state, const double time) const = 0;

  /** The material points after a step. */
  virtual MaterialPoints<dim> moved(const MaterialPoints<dim> &points,
                                    const PointEvaluator<dim> &u) const = 0;

  /** What bringing their histories to this step met, on this process. */
  virtual MovingLeastSquaresReport transfer_report() const = 0;

private:
  const double time_of_start;
};
} // namespace scree
