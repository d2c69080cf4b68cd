#pragma once

#include <scree/contact/contact_points.h>

#include <vector>

namespace scree
{
/**
 * Owned grid cells around marked contact points of any process: those that hold the corners of a
 * cell centred at the point (collective).
 */
template <int dim>
std::vector<bool> cells_around(const std::vector<bool> &marked, const ContactPoints<dim> &contact,
                               const BackgroundGrid<dim> &grid);
} // namespace scree
