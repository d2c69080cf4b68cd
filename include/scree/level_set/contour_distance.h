#pragma once

#include <scree/level_set/lattice.h>

namespace scree
{
/** The nodes with a cut edge and their neighbours along the axes, by their offset, in order. */
template <int dim>
std::vector<std::size_t> nodes_at_cut_edges(const Lattice<dim> &lattice);

/**
 * The distances of nodes next to the zero contour of any level-set function: to the closest point
 * of the cubic interpolant; where the function has a kink (a second difference above 0.3 of the
 * first differences nearby) to that of the multilinear interpolant; where no closest point is found
 * the estimate from the cut edges, `d = (sum_i 1/d_i^2)^{-1/2}` with the distance d_i to the cut
 * along axis i.
 */
template <int dim>
class ContourDistance
{
public:
  using Index = typename Lattice<dim>::Index;

  /** Keeps a reference to the lattice, whose values must not change meanwhile. */
  explicit ContourDistance(const Lattice<dim> &lattice);

  /** The signed distance (length) of the node at `offset`; infinite if no contour is found. */
  double operator()(std::size_t offset);

  /** Whether a node within `reach` nodes along every axis is a kink. */
  bool kink_near(const Index &node, int reach);

private:
  struct CutEdges;

  bool exists(const Index &node, unsigned int axis, int step) const;

  bool is_kink(std::size_t offset) const;

  CutEdges cut_edges(const Index &node, std::size_t offset) const;

  // Where the interpolant of `degree` vanishes between a and b.
  dealii::Point<dim> cut_of_edge(unsigned int degree, const dealii::Point<dim> &a,
                                 const dealii::Point<dim> &b) const;

  // Distance to the closest point found from `start`, infinity if there is none nearby.
  double distance_to_foot(const dealii::Point<dim> &x, unsigned int degree,
                          const dealii::Point<dim> &start) const;

  double unsigned_distance(std::size_t offset);

  const Lattice<dim>             &lattice;
  std::array<std::ptrdiff_t, dim> stride;
  std::vector<char>               kinks; // 0 unknown, 1 smooth, 2 kink
};
} // namespace scree
