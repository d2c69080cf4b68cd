#pragma once

#include <scree/contact/contact_memory.h>
#include <scree/points/material_points.h>
#include <scree/state/driving_forces.h>
#include <scree/state/energies.h>

namespace scree
{
/** What the end of a step on a moving geometry hands to the start of the next one. */
template <int dim>
struct StepEnd
{
  ContactMemory<dim>  contact;
  std::vector<double> multipliers;
  Energies            energies;
  DrivingForces<dim>  driving;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &contact &multipliers &energies &driving;
  }
};

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
  MaterialPoints<dim>                   points;   //!< of a moving geometry
  StepEnd<dim>                          step_end; //!< of the last step on a moving geometry
};

/** Zeros for all unknowns of this process. */
template <int dim>
dealii::TrilinosWrappers::MPI::Vector zero_displacement(const Fields<dim> &fields);
} // namespace scree
