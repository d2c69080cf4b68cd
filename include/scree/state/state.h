#pragma once

#include <scree/contact/contact_points.h>

namespace scree
{
/**
 * What lives between load steps while the geometry stays fixed: total displacements with the
 * multipliers, the contact history, the time. A copy is all that a rollback needs.
 */
template <int dim>
struct State
{
  dealii::TrilinosWrappers::MPI::Vector displacement; //!< owned unknowns [L]
  ContactHistory<dim>                   contact;
  double                                time = 0.;
};

/** The unloaded state. */
template <int dim>
State<dim> initial_state(const Fields<dim> &fields, const ContactPoints<dim> &contact);
} // namespace scree
