#pragma once

#include <scree/level_set/advection.h>
#include <scree/level_set/lattice.h>

#include <vector>

namespace scree
{
/** The connected pieces of {phi < 0}. */
struct Pieces
{
  unsigned int              n = 0;
  std::vector<unsigned int> of_node; // 1 to n in the order of the values, 0 where phi >= 0
};

/** The pieces of a dense lattice; nodes are joined along the axes. */
template <int dim>
Pieces negative_pieces(const Lattice<dim> &lattice);

/**
 * Removes the pieces of a moved body that nothing of the old one went to: phi becomes half a
 * spacing there.
 * @param old   level set before the motion, on the same nodes
 * @param known nodes in the body's cells
 * @param du    what moved the nodes that are known [L]
 * @return      their number
 */
template <int dim>
unsigned int remove_islands(Lattice<dim> &lattice, const std::vector<double> &old,
                            const std::vector<char> &known, const NodalVectors<dim> &du);
} // namespace scree
