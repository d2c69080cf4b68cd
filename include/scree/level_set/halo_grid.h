#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scree
{
/**
 * A dense uniform grid whose arrays carry three more nodes beyond each end, the halo that the
 * stencils reach into; x fastest.
 */
template <int dim>
struct HaloGrid
{
  static constexpr int width = 3; // nodes of halo at each end

  std::array<int, dim> n_nodes; // without halo
  double               spacing; // length

  /** The step between neighbours in direction d, in an array with halo. */
  std::size_t stride(int d) const;

  /** The position of node (0, ..., 0) in an array with halo. */
  std::size_t first() const;

  /** The length of an array with halo. */
  std::size_t size() const;

  /** Copies nodal values (x fastest, no halo) into an array with halo and fills the halo. */
  void load(const std::vector<double> &values, double *with_halo) const;

  /** Continues the array linearly into its halo, direction by direction; not into the corners. */
  void extrapolate(double *with_halo) const;
};

/** Consecutive nodes of a row. */
struct NodeRun
{
  std::size_t node;      // position of the first one in arrays of all nodes, without halo
  std::size_t with_halo; // its position in arrays with halo
  std::size_t packed;    // its position in arrays of the nodes of the set alone
  int         n;         // number of nodes
};

/** The nodes of a dense grid that move: all of them or a band around the zero contour. */
template <int dim>
struct NodeSet
{
  HaloGrid<dim>        grid;
  std::vector<NodeRun> runs;         // in the order of the nodes
  std::size_t          n_nodes;      // of the set
  bool                 reaches_ends; // some stencil reaches into the halo

  /**
   * Copies the nodes of the set and those that their stencils reach into an array with halo, where
   * the other entries keep what they are.
   */
  void load(const std::vector<double> &values, double *with_halo) const;

  /** Copies the nodes of the set back; the other nodes keep their values. */
  void store(const double *with_halo, std::vector<double> &values) const;

  /** Picks the nodes of the set out of an array of all nodes. */
  void pack(const std::vector<double> &values, std::vector<double> &packed) const;
};

template <int dim>
NodeSet<dim> all_nodes(const HaloGrid<dim> &grid);

/**
 * The nodes with `|phi| <= half_width` (length, if phi is a distance), all nodes if it is infinite.
 * Runs consist of blocks of 8 nodes, unless their ends that are beyond are to be trimmed.
 */
template <int dim>
NodeSet<dim> nodes_near_contour(const HaloGrid<dim> &grid, const std::vector<double> &phi,
                                double half_width, bool whole_blocks = true);
} // namespace scree
