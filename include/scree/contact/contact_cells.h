#pragma once

#include <scree/contact/contact_points.h>

#include <vector>

namespace scree
{
/**
 * Owned grid cells around marked contact points of any process: those of a cube centred at the
 * point, of an edge of 2 reach cells of the point's size (collective).
 */
template <int dim>
std::vector<bool> cells_around(const std::vector<bool> &marked, const ContactPoints<dim> &contact,
                               const BackgroundGrid<dim> &grid, const double reach);
} // namespace scree
