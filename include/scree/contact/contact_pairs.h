#pragma once

#include <scree/contact/contact_parameters.h>
#include <scree/contact/contact_surface.h>

#include <vector>

namespace scree
{
/**
 * The pairs of bodies whose boxes are at most `reach` [L] apart, with the laws between them. No
 * law: bodies that pass through each other, and two rigid ones of which none can respond.
 *
 * @param responds of each body, whether it can respond at another time even if not now; empty: no
 */
template <int dim>
std::vector<ContactPair> pairs_within(const double reach, const std::vector<Body<dim>> &bodies,
                                      const ContactParameters &contact,
                                      const std::vector<bool> &responds = {});

/** Whether there are laws between more than `n` pairs of bodies, wherever these are. */
template <int dim>
bool has_more_pairs_than(const unsigned int n, const std::vector<Body<dim>> &bodies,
                         const ContactParameters &contact, const std::vector<bool> &responds = {});
} // namespace scree
