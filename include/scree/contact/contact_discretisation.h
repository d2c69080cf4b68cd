#pragma once

#include <scree/contact/jump_operator.h>

#include <vector>

namespace scree
{
/**
 * What laws, enforcement and mechanics know of the discretisation of contact: points with gap,
 * normal and area, and the operator that gives their jumps. Tractions go from step to step by the
 * places of the points (contact_memory.h). level_set_surface() makes one.
 */
template <int dim>
struct ContactDiscretisation
{
  std::vector<ContactPoint<dim>> points; //!< of this process; those of a pair one after the other
  JumpOperator<dim>              jump_operator; //!< of these points
};
} // namespace scree
