#include <scree/mechanics/linear_nitsche.h>
#include <scree/mechanics/strong_supports.h>
#include <scree/mechanics/total_kinematics.h>

namespace scree
{
template <int dim>
TotalKinematics<dim>::TotalKinematics(const DisplacementSpace<dim> &space,
                                      const CutQuadrature<dim>     &quadrature,
                                      const std::vector<Body<dim>> &bodies,
                                      const SmallCutTreatment<dim> &small_cuts)
    : Kinematics<dim>(0.)
    , space(space)
    , linear_bulk(space, quadrature, bodies, small_cuts)
    , zero(space.owned(), space.grid.communicator())
{
}

template <int dim>
const Bulk<dim> &
TotalKinematics<dim>::bulk() const
{
  return linear_bulk;
}

template <int dim>
std::unique_ptr<BoundaryTerm<dim>>
TotalKinematics<dim>::prescribed_displacements(const BoundarySetting<dim>      &setting,
                                               const std::vector<unsigned int> &own_regions) const
{
  return std::make_unique<LinearNitsche<dim>>(setting, own_regions);
}

template <int dim>
bool
TotalKinematics<dim>::follows_surface(const BoundaryCondition<dim> &) const
{
  return false;
}

template <int dim>
const Shape<dim> *
TotalKinematics<dim>::exact_shape(const Body<dim> &body) const
{
  return body.shape.get();
}

template <int dim>
double
TotalKinematics<dim>::prescribed(const BoundaryCondition<dim> &condition,
                                 const PrescribedUnknown<dim> &unknown, const double time) const
{
  return condition.value(unknown.value, unknown.reference_position, time);
}

template <int dim>
bool
TotalKinematics<dim>::rotations_are_finite() const
{
  return false;
}

template <int dim>
const typename TotalKinematics<dim>::Vector &
TotalKinematics<dim>::start_displacement() const
{
  return zero;
}

template <int dim>
PointEvaluator<dim>
TotalKinematics<dim>::start_displacement_field() const
{
  return PointEvaluator<dim>(space);
}

template <int dim>
dealii::Point<dim>
TotalKinematics<dim>::reference_position(const PointInCell<dim> &point) const
{
  return space.position(point.active_cell, point.unit_point);
}

template <int dim>
SurfaceHistory<dim>
TotalKinematics<dim>::surface_history(const PointInCell<dim> &,
                                      const dealii::Tensor<1, dim> &) const
{
  return {};
}

template <int dim>
bool
TotalKinematics<dim>::moves_bodies() const
{
  return false;
}

template <int dim>
double
TotalKinematics<dim>::position_scale() const
{
  return 0.;
}

template <int dim>
bool
TotalKinematics<dim>::balances_moments(const Body<dim> &) const
{
  return true;
}

template <int dim>
double
TotalKinematics<dim>::arm_error(const double) const
{
  return 0.;
}

template <int dim>
MassPoints<dim>
TotalKinematics<dim>::mass_points() const
{
  return linear_bulk.mass_points();
}

template <int dim>
typename TotalKinematics<dim>::Vector
TotalKinematics<dim>::extrapolated(const State<dim> &state, const double time) const
{
  Vector result = state.displacement;
  result.add(time - state.time, state.predictor.rates.velocity);
  return result;
}

template <int dim>
MaterialPoints<dim>
TotalKinematics<dim>::moved(const MaterialPoints<dim> &points, const PointEvaluator<dim> &) const
{
  return points;
}

template <int dim>
MovingLeastSquaresReport
TotalKinematics<dim>::transfer_report() const
{
  return {};
}

template class TotalKinematics<2>;
template class TotalKinematics<3>;
} // namespace scree
