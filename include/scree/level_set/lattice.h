#pragma once

#include <scree/level_set/tiles.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace scree
{
/**
 * Where the lattices of all bodies live: nodes at `origin + spacing * integer vector`. With the
 * corner of the background grid as origin and spacing h/k they contain the support points of
 * FE_Q(k) on every background cell.
 */
template <int dim>
struct LatticeFrame
{
  dealii::Point<dim>       origin;  // node (0, ..., 0)
  double                   spacing; // length
  dealii::BoundingBox<dim> box;     // the background box, which clips the lattices
};

/** Whether a lattice of `n_nodes`, at least `fewest` per direction, has so many in all. */
template <int dim>
bool is_number_of_nodes(std::size_t n, const std::array<int, dim> &n_nodes, const int fewest);

/** Value and derivatives of a level set at a point. */
template <int dim>
struct LevelSetExpansion
{
  double                          value;    // length, if the level set is a distance
  dealii::Tensor<1, dim>          gradient; // no dimension
  dealii::SymmetricTensor<2, dim> hessian;  // 1/length
};

/**
 * A uniform Cartesian lattice of nodal values with Lagrange interpolation. It is dense, or it
 * knows a function, asks it for the nodes that are needed and keeps those of tiles of 8^dim nodes
 * that are needed often: a big body, of which the grid resolves a part of the surface. Evaluation
 * gives the same numbers for both. Tiles come while a constant lattice is read: not in threads.
 *
 * Degrees 1 and 2 interpolate in cells of k x k spacings whose corners are multiples of k in the
 * global numbering of the frame: the FE_Q(k) interpolant on the finest background cells if
 * spacing = h/k. Degree 3 interpolates through the 4 nodes per direction centred on the spacing
 * that contains the point (continuous, gradient jumps of third order).
 *
 * Outside the box of the lattice every evaluation returns the value at the nearest point of the
 * box plus the distance to it, so that the level set stays positive far away.
 */
template <int dim>
class Lattice
{
public:
  /** A node, in the global numbering of the frame. */
  using Index = std::array<int, dim>;

  /**
   * Nodes `lower` ... `lower + n_nodes - 1`, values NaN. At least 4 nodes per direction; for
   * degree 2 both `lower` and `n_nodes - 1` should be even.
   */
  Lattice(const LatticeFrame<dim> &frame, const Index &lower, const Index &n_nodes);

  /** The same box in tiles, none of which is there yet: `function` gives the values of nodes. */
  Lattice(const LatticeFrame<dim> &frame, const Index &lower, const Index &n_nodes,
          const std::function<double(const dealii::Point<dim> &)> &function);

  bool is_tiled() const;

  const LatticeFrame<dim> &frame() const;

  double spacing() const;

  /** The first node and the number of nodes per direction. */
  const Index &lower() const;

  const Index &n_nodes() const;

  /** The box spanned by the nodes. */
  const dealii::BoundingBox<dim> &box() const;

  /** Position of a node, which need not belong to the lattice. */
  dealii::Point<dim> node(const Index &index) const;

  bool contains(const Index &index) const;

  /**
   * Position of a stored node in values(), and back. A tile may reach beyond the box: then the
   * index has no use but to be a position in space.
   */
  std::size_t offset(const Index &index) const;

  Index index(std::size_t offset) const;

  /** The value of a node, which is stored from now on. */
  double &operator()(const Index &index);

  /** The value of any node. */
  double operator()(const Index &index) const;

  /** The same for a search that passes by: no tile comes of it. */
  double passing_value(const Index &index) const;

  /** The stored values: all nodes, x fastest, or the tiles so far. */
  std::vector<double> &values();

  const std::vector<double> &values() const;

  /** Which nodes are stored if not all: nodes counted from lower(). */
  const Tiles<dim> &tiles() const;

  /** The value of the node at `x`, which must be a node of the frame (rounded to the nearest). */
  double nodal_value(const dealii::Point<dim> &x) const;

  /** The interpolant of degree 1, 2 or 3. */
  double value(const dealii::Point<dim> &x, unsigned int degree) const;

  std::pair<double, dealii::Tensor<1, dim>> value_and_gradient(const dealii::Point<dim> &x,
                                                               unsigned int degree) const;

  LevelSetExpansion<dim> expansion(const dealii::Point<dim> &x, unsigned int degree) const;

private:
  /** Stores the tile of an absent node. Returns the position of the node. */
  std::size_t store(const Index &index) const;

  /** The value of an absent node. */
  double asked_value(const Index &index) const;

  LatticeFrame<dim>           lattice_frame;
  Index                       lower_node;
  Index                       node_count;
  dealii::BoundingBox<dim>    node_box;
  mutable std::vector<double> node_values;
  mutable Tiles<dim>          node_tiles; // empty if dense

  std::function<double(const dealii::Point<dim> &)> function; // empty if dense
};

template <int dim>
inline bool
Lattice<dim>::contains(const Index &index) const
{
  for (unsigned int d = 0; d < dim; ++d)
    if (index[d] < lower_node[d] || index[d] >= lower_node[d] + node_count[d])
      return false;
  return true;
}

template <int dim>
inline std::size_t
Lattice<dim>::offset(const Index &index) const
{
  Assert(contains(index), dealii::ExcMessage("The node is outside the lattice."));
  if (is_tiled())
    {
      Index node = index;
      for (unsigned int d = 0; d < dim; ++d)
        node[d] -= lower_node[d];
      return node_tiles.position(node);
    }
  std::size_t result = index[dim - 1] - lower_node[dim - 1];
  for (int d = dim - 2; d >= 0; --d)
    result = result * node_count[d] + (index[d] - lower_node[d]);
  return result;
}

template <int dim>
inline bool
Lattice<dim>::is_tiled() const
{
  return !node_tiles.empty();
}

template <int dim>
inline double &
Lattice<dim>::operator()(const Index &index)
{
  const std::size_t position = offset(index);
  return node_values[position == Tiles<dim>::absent ? store(index) : position];
}

template <int dim>
inline double
Lattice<dim>::operator()(const Index &index) const
{
  const std::size_t position = offset(index);
  return position == Tiles<dim>::absent ? asked_value(index) : node_values[position];
}
} // namespace scree
