#pragma once

#include <scree/mechanics/body_stress.h>
#include <scree/mechanics/resultant.h>
#include <scree/output/contact_output.h>
#include <scree/output/mean_motion.h>

#include <array>
#include <vector>

namespace scree
{
/** Where a body is, what contact does to it, and its mean stress. */
template <int dim>
struct GrainState
{
  MeanMotion<dim> motion;
  dealii::Point<dim>
                 centroid; //!< in the equations: fixed geometry: at the start; moving: at the end
  Resultant<dim> contact;  //!< moment about the centroid
  unsigned int   n_contacts = 0;  //!< closed ones
  double         volume     = 0.; //!< at the end of the step; rigid without density: NaN [L^dim]
  dealii::SymmetricTensor<2, dim>
    stress_integral;                            //!< int sigma by the field; rigid: zero [force L]
  dealii::SymmetricTensor<2, dim> stress;       //!< mean of the field; rigid: NaN [force/area]
  dealii::SymmetricTensor<2, dim> force_stress; //!< 1/V sym sum f (x - centroid)^T
};

/**
 * The states of all bodies after a step. Forces on deformable bodies are those of contact and of
 * BodyStress; on rigid ones those of contact alone, about the reference point, where all others are
 * taken to act.
 */
template <int dim>
std::vector<GrainState<dim>>
grain_states(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
             const std::vector<ContactSummary<dim>> &summaries,
             const std::vector<MeanMotion<dim>>     &motions,
             const std::vector<BodyStress<dim>> &stresses, const bool geometry_is_moving);

/**
 * From the centroid of a body of a pair to that of the other one, with the place of their contact
 * instead of the centroid of a rigid body that meets a deformable one, a wall [L].
 */
template <int dim>
dealii::Tensor<1, dim> branch_vector(const std::vector<Body<dim>> &bodies, const ContactPair &pair,
                                     const ContactSummary<dim>          &summary,
                                     const std::vector<GrainState<dim>> &grains);

/** Moments of a contact on its bodies a and b about their centroids, of the forces at their sides.
 */
template <int dim>
std::array<dealii::Tensor<1, 3>, 2> contact_moments(const ContactPair                  &pair,
                                                    const ContactSummary<dim>          &summary,
                                                    const std::vector<GrainState<dim>> &grains);
} // namespace scree
