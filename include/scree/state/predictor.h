#pragma once

#include <scree/bodies/body.h>

#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace scree
{
/** Velocity, acceleration and forces of the owned unknowns at the end of a step. */
struct Rates
{
  dealii::TrilinosWrappers::MPI::Vector velocity;     //!< [L/time]
  dealii::TrilinosWrappers::MPI::Vector acceleration; //!< [L/time^2]; of size 0: there is none
  dealii::TrilinosWrappers::MPI::Vector forces = {};  //!< r(u) but for inertia; of size 0: none
};

/** The motion at the end of the last step, from which the next one begins. */
template <int dim>
struct Predictor
{
  double step_size = 0.; //!< of the last step [time]; 0: there is none
  Rates  rates;          //!< on a fixed geometry, and of any with inertia
  /** On a moving geometry: of the deformable bodies, else empty. */
  std::vector<ExtendedIncrement<dim>>            of_bodies;
  std::vector<typename RigidPose<dim>::Unknowns> of_rigid; //!< the same of the rigid ones
  /** With inertia on a moving geometry: the rows of `rates` of rigid bodies. */
  std::vector<std::array<typename RigidPose<dim>::Unknowns, 3>> rates_of_rigid;

  bool is_empty() const
  {
    return step_size == 0.;
  }

  /**
   * On a moving geometry: the displacement of body number `b` at `x` [L] that the last increment
   * lets expect in a step of `next_step_size`, `du(x - du(x)) dt/dt_n`, for du belongs to where the
   * point was before.
   */
  dealii::Tensor<1, dim> expected_increment(const Body<dim> &body, const unsigned int b,
                                            const dealii::Point<dim> &x,
                                            const double              next_step_size) const;
};
} // namespace scree
