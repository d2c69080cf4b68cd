#pragma once

#include <scree/mechanics/mass.h>

#include <map>

namespace scree
{
/** The velocities of deformable and rigid bodies of a run with inertia. */
template <int dim>
class VelocityField
{
public:
  /**
   * Collective.
   *
   * @param u          displacement, where rigid bodies have the poses that turn
   * @param velocities of the rates
   */
  VelocityField(const Mass<dim> &mass, const dealii::TrilinosWrappers::MPI::Vector &u,
                const dealii::TrilinosWrappers::MPI::Vector &velocities);

  /** In a deformable body [L/time]. */
  dealii::Tensor<1, dim> value(const PointInCell<dim> &point) const
  {
    return field.value(point);
  }

  /** v + w x (x - c) of a rigid body at x [L/time]; zero without mass. */
  dealii::Tensor<1, dim> value(const unsigned int body, const dealii::Point<dim> &x) const;

private:
  struct RigidMotion
  {
    dealii::Point<dim> centre; //!< the reference point now
    RigidRates<dim>    rates;
  };
  PointEvaluator<dim>                 field;
  std::map<unsigned int, RigidMotion> rigid; //!< by number of the body
};
} // namespace scree
