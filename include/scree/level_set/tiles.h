#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace scree
{
/**
 * Nodal values of a big box that are stored in tiles of 8^dim nodes near the contour only, beside
 * every 8th node of the whole box. Nodes count from the first one of the box. The last tiles may
 * reach beyond the box.
 */
template <int dim>
class Tiles
{
public:
  using Node = std::array<int, dim>;

  static constexpr int         edge    = 8;                   // nodes of a tile per direction
  static constexpr std::size_t n_nodes = dim == 2 ? 64 : 512; // of a tile
  static constexpr std::size_t absent  = std::numeric_limits<std::size_t>::max();

  /** No tiles, for a box of no nodes. */
  Tiles() = default;

  /** No tile is stored yet; every 8th node of a box of `n_box_nodes` gets the value NaN. */
  explicit Tiles(const Node &n_box_nodes);

  bool empty() const;

  /** Number of tiles per direction, stored or not. */
  const Node &n_tiles() const;

  /** Number of coarse nodes, and the values there; x fastest. */
  Node n_coarse() const;

  std::vector<double> &coarse();

  const std::vector<double> &coarse() const;

  double coarse_at(const Node &coarse_node) const;

  /** Appends a tile to those that are stored. */
  void store(const Node &tile);

  /** The position of a node in the stored values, `absent` if its tile is not stored. */
  std::size_t position(const Node &node) const;

  /** The node at a position in the stored values. */
  Node node(std::size_t position) const;

  /** The value of a node whose tile is absent: multilinear in the coarse values. */
  double coarse_value(const Node &node) const;

private:
  Node                  tile_count{};
  std::vector<int>      stored;  // tile -> its number in the order of storage, or -1
  std::vector<unsigned> tile_of; // and back
  std::vector<double>   coarse_values;
};

template <int dim>
inline bool
Tiles<dim>::empty() const
{
  return stored.empty();
}

template <int dim>
inline double
Tiles<dim>::coarse_at(const Node &coarse_node) const
{
  std::size_t position = 0;
  for (int d = dim - 1; d >= 0; --d)
    position = position * (tile_count[d] + 1) + coarse_node[d];
  return coarse_values[position];
}

template <int dim>
inline std::size_t
Tiles<dim>::position(const Node &node) const
{
  std::size_t tile = 0, within = 0;
  for (int d = dim - 1; d >= 0; --d)
    {
      tile   = tile * tile_count[d] + node[d] / edge;
      within = within * edge + node[d] % edge;
    }
  const int number = stored[tile];
  return number < 0 ? absent : number * n_nodes + within;
}
} // namespace scree
