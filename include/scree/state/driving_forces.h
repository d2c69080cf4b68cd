#pragma once

#include <deal.II/base/point.h>

#include <vector>

namespace scree
{
/** The force of a quadrature point of a condition on a prescribed displacement. */
template <int dim>
struct DrivenPoint
{
  unsigned int           region;             //!< of BoundaryTerms::regions()
  dealii::Point<dim>     reference_position; //!< where the prescribed displacement is evaluated
  dealii::Tensor<1, dim> force;              //!< traction times area

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &region &reference_position &force;
  }
};

/** What drives bodies at the end of a step. Half of it times the motion of the next one is work. */
template <int dim>
struct DrivingForces
{
  std::vector<double>           of_rigid;  //!< component by component of the rigid bodies
  std::vector<DrivenPoint<dim>> of_points; //!< of this process

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &of_rigid &of_points;
  }
};
} // namespace scree
