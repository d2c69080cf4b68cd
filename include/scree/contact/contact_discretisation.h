#pragma once

#include <scree/contact/initial_gap.h>
#include <scree/contact/jump_operator.h>

#include <vector>

namespace scree
{
/**
 * What laws, enforcement and mechanics know of the discretisation of contact: points with gap,
 * normal and area, and the operator that gives their jumps. Tractions go from step to step by the
 * places of the points (contact_memory.h). level_set_surface() makes one, grid_node_contact()
 * another.
 */
template <int dim>
struct ContactDiscretisation
{
  std::vector<ContactPoint<dim>> points; //!< of this process; those of a pair one after the other
  JumpOperator<dim>              jump_operator; //!< of these points
};

/**
 * The discretisation of contact at given points: B takes displacements at their feet, laws take off
 * or glue their gaps. Points whose feet a deformable body does not reach are left out, and so are
 * hanging nodes. Collective.
 *
 * @param points those of a pair one after the other
 * @param start_displacement u_n of the deformable bodies at the owned unknowns; null: zero
 * @param secant_ratios of plastic flow at the first unknown of each owned node; null: one
 * @param start_gaps of pairs that are adjusted as a whole: found here if they are not known yet;
 * null: this is the start of the run
 */
template <int dim>
ContactDiscretisation<dim> discretise_contact(
  const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
  const std::vector<ContactPair> &pairs, std::vector<ContactPoint<dim>> &&points,
  InitialGaps<dim> &initial_gaps, const dealii::TrilinosWrappers::MPI::Vector *start_displacement,
  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios, StartGaps *start_gaps);
} // namespace scree
