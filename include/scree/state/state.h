#pragma once

#include <scree/contact/contact_points.h>
#include <scree/points/material_points.h>

namespace scree
{
/**
 * What lives between load steps, besides the level sets and poses of the bodies: displacements with
 * the multipliers, the contact history, the time, and on a moving geometry the material points. It
 * changes when a step is accepted and not before.
 */
template <int dim>
struct State
{
  dealii::TrilinosWrappers::MPI::Vector displacement; //!< owned unknowns [L]
  ContactHistory<dim>                   contact;
  double                                time = 0.;
  MaterialPoints<dim>                   points; //!< of a moving geometry
};

/** Zeros for all unknowns of this process. */
template <int dim>
dealii::TrilinosWrappers::MPI::Vector zero_displacement(const Fields<dim> &fields);
} // namespace scree
