#pragma once

#include <scree/contact/contact_points.h>

#include <utility>
#include <vector>

namespace scree
{
/**
 * Checks that contact stays where contact points are. Collective.
 *
 * @param reach largest gap at the start for which bodies have contact points everywhere [L]
 * @throws UserError if points near its end carry pressure
 */
template <int dim>
void require_contact_within_reach(const ContactPoints<dim> &contact, const double reach,
                                  const MPI_Comm communicator);

/**
 * Pairs that may have met although they have no contact points: their boxes, widened by the largest
 * displacement of each body, intersect, and both displacements exceed the reach of contact together
 * (collective).
 *
 * @param reach  largest initial gap of contact points [L]
 * @param motion largest |u| of each body [L]
 */
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
pairs_that_may_have_met(const std::vector<Body<dim>> &bodies, const ContactPoints<dim> &contact,
                        const ContactParameters &parameters, const double reach,
                        const std::vector<double> &motion, const MPI_Comm communicator);

/**
 * Bodies that coincide or lie inside one another have no surface between them.
 *
 * @throws UserError if the deepest point of the overlap of a pair lies as deep as nine tenths of
 * the deepest point of one of the bodies
 */
template <int dim>
void require_distinct(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs);

/**
 * Pairs whose contact is closed at some, but at less than 3^(dim - 1) points in the last
 * evaluation: too few for the shape of a pressure. Collective.
 */
template <int dim>
std::vector<unsigned int> under_resolved_pairs(const ContactPoints<dim> &contact,
                                               const MPI_Comm            communicator);
} // namespace scree
