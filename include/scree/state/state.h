#pragma once

#include <scree/contact/contact_memory.h>
#include <scree/contact/initial_gap.h>
#include <scree/points/material_points.h>
#include <scree/state/driving_forces.h>
#include <scree/state/energies.h>
#include <scree/state/predictor.h>

namespace scree
{
/** What the end of a step on a moving geometry hands to the start of the next one. */
template <int dim>
struct StepEnd
{
  ContactMemory<dim>  contact;
  std::vector<double> multipliers;
  DrivingForces<dim>  driving;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &contact &multipliers &driving;
  }
};

/**
 * All that lives between load steps: where the bodies are, the displacement with the multipliers,
 * the contact history, energies, and on a moving geometry the material points. It changes when a
 * step is accepted and not before. A copy is what a rollback needs (with the equations made anew on
 * it), GatheredState what a checkpoint needs.
 */
template <int dim>
struct State
{
  double                 time        = 0.;
  bool                   has_started = false; //!< a step was accepted, or the geometry has moved
  std::vector<Body<dim>> bodies;
  dealii::TrilinosWrappers::MPI::Vector displacement; //!< owned unknowns [L]
  ContactHistory<dim>                   contact;
  std::vector<bool>   was_closed; //!< contact points of a fixed geometry, at the end of some step
  StartGaps           start_gaps; //!< found with the first contact points
  Energies            energies;   //!< of the last accepted step
  Predictor<dim>      predictor;
  MaterialPoints<dim> points;   //!< of a moving geometry
  StepEnd<dim>        step_end; //!< of the last step on a moving geometry
};

/** Zeros for all unknowns of this process. */
template <int dim>
dealii::TrilinosWrappers::MPI::Vector zero_displacement(const DisplacementSpace<dim> &space);
} // namespace scree
