#pragma once

namespace scree
{
/** Energies at a state and the work between states [force L]. */
struct Energies
{
  double strain        = 0.; //!< stored by the laws
  double ghost_penalty = 0.; //!< stored in the ghost penalty
  double boundary      = 0.; //!< stored in springs, Nitsche and penalty terms
  double contact       = 0.; //!< stored in the contact penalties
  double kinetic       = 0.; //!< of the bodies' motion
  double dissipation   = 0.; //!< by friction, since the start
  double plastic       = 0.; //!< plastic dissipation, since the start
  double external_work = 0.; //!< by the trapezoidal rule, since the start, and kinetic energy there
  double transfer      = 0.; //!< gained where the geometry moved between steps, since the start

  /** What a step's start and end can be compared in. */
  double stored() const
  {
    return strain + ghost_penalty + boundary + contact + kinetic;
  }

  /** external work and transfer minus all that was stored or dissipated */
  double balance_error() const
  {
    return external_work + transfer - stored() - dissipation - plastic;
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &strain &ghost_penalty &boundary &contact &kinetic &dissipation &plastic &external_work
      &transfer;
  }
};
} // namespace scree
