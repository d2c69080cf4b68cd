#pragma once

#include <scree/contact/contact_points.h>

namespace scree
{
/** What the tractions of the last evaluation store. Collective. */
template <int dim>
double stored_energy(const ContactPoints<dim> &contact, const MPI_Comm communicator);

/**
 * What the tangential tractions of `history` store less those of the last evaluation, which a law
 * may have cut. Collective.
 */
template <int dim>
double cut_energy(const ContactPoints<dim> &contact, const ContactHistory<dim> &history,
                  const MPI_Comm communicator);

/**
 * The work of the tangential tractions on the slip in the step from `history` to the last
 * evaluation (theory.md section 11):
 *
 *     -(share tau_n + (1 - share) tau) . d_s,   d_s = P ([[u]] - [[u]]_n) - elastic slide.
 *
 * Where an old traction would drive the slip this is negative; the traction has turned before. If
 * the sum is negative, points with a negative part count with tau alone. Collective.
 *
 * @param share 1/2 by the trapezoidal rule; 0 where the tractions tau act throughout the step
 */
template <int dim>
double dissipation(const ContactPoints<dim> &contact, const ContactHistory<dim> &history,
                   const double share, const MPI_Comm communicator);
} // namespace scree
