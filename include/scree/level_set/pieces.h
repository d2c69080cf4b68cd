#pragma once

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
} // namespace scree
